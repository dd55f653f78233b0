/// @file
/// What operators at quadrature points and at points of their own share: where a QFunction's fields lie, and which of
/// them are evaluated together.
#pragma once

#include <ceed/plugin.h>

#include <algorithm>
#include <new>
#include <vector>

#include "access.hpp"
#include "kernels.hpp"
#include "memory.hpp"

namespace hg::host {

/// Arrays in one piece of memory: all are added, then there is memory for them, filled with zeros.
class Arena {
 public:
  /// Room for `size` numbers; its index.
  int add(std::size_t size) {
    constexpr std::size_t line = CEED_ALIGN / sizeof(CeedScalar);
    starts_.push_back(length_);
    length_ += (size + line - 1) / line * line;
    return static_cast<int>(starts_.size()) - 1;
  }
  void allocate() {
    const std::size_t length = length_ + max_width;  // kernels read a pack beyond the last number
    memory_ = allocate_array(length);
    if (!memory_) throw std::bad_alloc();
    std::fill_n(memory_.get(), length, 0.0);
  }
  std::size_t num_bytes() const { return memory_ ? (length_ + max_width) * sizeof(CeedScalar) : 0; }
  /// NULL for index -1
  CeedScalar *operator[](int index) const { return index < 0 ? nullptr : memory_.get() + starts_[index]; }

 private:
  std::vector<std::size_t> starts_;
  std::size_t length_ = 0;
  Array memory_;
};

/// Fields of one side and space: evaluated, or integrated, together. Arrays are indices in an Arena, or -1.
struct Evaluation {
  CeedInt side, space;
  int interp = -1, derivative = -1;
  bool add = false;  ///< integrations: another one of this side has come before
  /// The array of the field's mode.
  int &array_of(const CeedProgramField &field) { return field.eval_mode == CEED_EVAL_INTERP ? interp : derivative; }
};

/// The evaluation of a field's side in its space, a new one where there is none. Without `share`, one that does not
/// have the field's mode yet.
inline Evaluation &evaluation_of(std::vector<Evaluation> &evaluations, const CeedProgramField &field, bool share) {
  bool is_first = true;
  for (Evaluation &e : evaluations) {
    if (e.side != field.side) continue;
    is_first = false;
    if (e.space == field.space && (share || e.array_of(field) < 0)) return e;
  }
  return evaluations.emplace_back(Evaluation{.side = field.side, .space = field.space, .add = !is_first});
}

/// An array that goes to or comes from a side as it is.
struct Copy {
  CeedInt side;
  int array;
};

/// A block that is scattered to a side, and room for it element by element.
struct Result {
  CeedInt side;
  int array, rows;
};

/// Calls scatter(first lane, end) for the lanes of a block: all at once for one sink; one by one for several, which may
/// share entries of a vector, so that elements are added in the same order whatever the width.
template <typename Scatter>
void for_lanes(std::size_t num_sinks, CeedInt num_elem, Scatter &&scatter) {
  const CeedInt step = num_sinks > 1 ? 1 : num_elem;
  for (CeedInt lane = 0; lane < num_elem; lane += step) scatter(lane, lane + step);
}

/// Calls visit(first element, number of elements) for blocks of at most W elements of [begin, end), which begin at
/// multiples of W.
template <typename Visit>
void for_blocks(CeedInt begin, CeedInt end, CeedInt W, Visit &&visit) {
  for (CeedSize first = begin; first < end;) {
    const CeedInt num_elem = static_cast<CeedInt>(std::min<CeedSize>(W - first % W, end - first));
    visit(static_cast<CeedInt>(first), num_elem);
    first += num_elem;
  }
}

}  // namespace hg::host
