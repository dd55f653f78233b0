/// @file
/// The objects of a program that calls the interface: some slots of each kind, whose handles calls take and replace.
#pragma once

#include <algorithm>
#include <array>
#include <deque>
#include <memory>
#include <string>
#include <vector>

#include "graph.hpp"
#include "right.hpp"

namespace hg::fuzz {

/// Slots for handles of one kind. A handle that is overwritten while its object may not be destroyed is kept to the
/// end.
template <typename T, int (*Destroy)(T *), int (*Copy)(T, T *)>
class Slots {
 public:
  static constexpr int size = 6;
  T &at(int i) { return handles_[i % size]; }
  /// Moves a new handle in.
  void put(int i, T made) {
    remove(at(i));
    if (at(i) != nullptr) kept_.push_back(at(i));
    at(i) = made;
  }
  /// Destroys what is in a slot. An object that others still hold, and that is lent out, stays to be given back.
  int remove(T &slot) {
    T before = slot;
    const int code = Destroy(&slot);
    if (code == CEED_ERROR_SUCCESS && is_lent(before)) Copy(before, &kept_.emplace_back());
    if (code == CEED_ERROR_SUCCESS && slot != nullptr) throw Defect("Destroy left the handle");
    return code;
  }
  void lend(T object) { lent_.push_back(object); }
  /// One loan less; false where there is none.
  bool give_back(T object) {
    const auto found = std::find(lent_.begin(), lent_.end(), object);
    if (found == lent_.end()) return false;
    lent_.erase(found);
    return true;
  }
  bool is_lent(T object) const { return std::find(lent_.begin(), lent_.end(), object) != lent_.end(); }
  std::vector<T> &lent() { return lent_; }
  void destroy_all() {
    for (T &handle : handles_) end(handle);
    for (T &handle : kept_) end(handle);
  }

 private:
  static void end(T &handle) {
    if (Destroy(&handle) != CEED_ERROR_SUCCESS) throw Defect("an object could not be destroyed at the end");
  }
  std::array<T, size> handles_{};
  std::deque<T> kept_;
  std::vector<T> lent_;
};

class Objects {
 public:
  /// Opens the Ceeds that calls use.
  explicit Objects(test::Random &bytes);
  Objects(const Objects &) = delete;
  Objects &operator=(const Objects &) = delete;
  ~Objects();

  /// Puts the objects of a right operator in the slots.
  void take_in(const test::Instance &instance);
  /// Gives back all that is lent out and destroys everything. Throws Defect where that fails.
  void end();

  // What calls are given. Handles may be NULL or a sentinel.
  Ceed ceed();
  CeedVector vector();
  CeedElemRestriction restriction();
  CeedBasis basis();
  CeedQFunction qfunction();
  CeedQFunctionContext context();
  CeedOperator op();
  /// A number: mostly a small count, or a size of one of the objects; rarely one that is wrong everywhere.
  CeedInt count();
  /// As few as 0 and as many as 4: for what work grows with the third power of.
  CeedInt few();
  CeedSize length();
  CeedScalar scalar();
  const char *name();
  CeedEvalMode eval_mode();
  CeedTransposeMode t_mode();
  CeedMemType mem_type();
  CeedCopyMode copy_mode();
  CeedElemTopology topology();
  CeedRequest *request() { return CEED_REQUEST_IMMEDIATE; }
  bool flag() { return (bytes.next_byte() & 1) != 0; }
  int slot() { return bytes.next_byte() % 6; }
  FILE *stream() const { return stream_; }

  /// Scalars of no pattern, `size` of them, that live to the end.
  CeedScalar *scalars(std::size_t size);
  /// A vector of that length and of equal values, in no slot; NULL where there is none.
  CeedVector temporary(CeedSize length, CeedScalar value);
  /// An array that lives to the end.
  template <typename T>
  T *keep(const std::vector<T> &values) {
    auto block = std::make_unique<char[]>(std::max<std::size_t>(values.size() * sizeof(T), 1));
    T *array = reinterpret_cast<T *>(block.get());
    std::copy(values.begin(), values.end(), array);
    blocks_.push_back(std::move(block));
    return array;
  }

  /// Runs f(&handle) with an empty handle and puts what it makes in a slot.
  template <typename S, typename F>
  int create(S &slots, F &&f) {
    std::remove_reference_t<decltype(slots.at(0))> made = nullptr;
    const int code = f(&made);
    if (code != CEED_ERROR_SUCCESS && made != nullptr) throw Defect("a call that failed left a handle");
    if (code == CEED_ERROR_SUCCESS && made == nullptr) throw Defect("a call that succeeded left no handle");
    if (code == CEED_ERROR_SUCCESS) slots.put(slot(), made);
    return code;
  }

  test::Random &bytes;
  Slots<CeedVector, CeedVectorDestroy, CeedVectorReferenceCopy> vectors;  ///< lent: for writing
  std::vector<CeedVector> readers;                                        ///< vectors lent for reading, once for each
  std::vector<CeedVector> work_vectors;
  Slots<CeedElemRestriction, CeedElemRestrictionDestroy, CeedElemRestrictionReferenceCopy> restrictions;
  Slots<CeedBasis, CeedBasisDestroy, CeedBasisReferenceCopy> bases;
  Slots<CeedQFunction, CeedQFunctionDestroy, CeedQFunctionReferenceCopy> qfunctions;
  Slots<CeedQFunctionContext, CeedQFunctionContextDestroy, CeedQFunctionContextReferenceCopy> contexts;
  std::vector<CeedQFunctionContext> context_readers;
  Slots<CeedOperator, CeedOperatorDestroy, CeedOperatorReferenceCopy> operators;
  std::vector<CeedQFunction> plain;  ///< QFunctions that read no context: they may be given any
  bool took_nothing = false;         ///< a handle of this call was NULL or a sentinel, so no Ceed hears of its errors

 private:
  template <typename T>
  T noted(T handle, bool is_nothing) {
    took_nothing = took_nothing || is_nothing;
    return handle;
  }

  Ceed ceeds_[2] = {nullptr, nullptr};
  FILE *stream_;
  std::deque<std::unique_ptr<char[]>> blocks_;
  std::deque<test::Vector> temporaries_;
};

/// One function of the interface, with arguments from the bytes.
struct Call {
  const char *name;
  bool changes;  ///< a success may change what operators do
  int (*run)(Objects &);
};

std::span<const Call> ceed_calls();
std::span<const Call> vector_calls();
std::span<const Call> restriction_calls();
std::span<const Call> basis_calls();
std::span<const Call> qfunction_calls();
std::span<const Call> context_calls();
std::span<const Call> operator_calls();
std::span<const Call> assembly_calls();

}  // namespace hg::fuzz
