/// @file
/// What one Ceed of this backend keeps, and the tables of its parent.
#pragma once

#include <ceed/plugin.h>

#include <cstdint>
#include <memory>
#include <mutex>
#include <unordered_map>
#include <vector>

#include "guarded_array.hpp"

namespace hg::memcheck {

/// Access to the array of a vector, and the last one before it.
struct VectorGuard {
  enum class Access { none, read, write_only, read_write };

  Access access = Access::none;
  bool is_backends = false;               ///< asked for by the parent, which may write a part of the array
  std::unique_ptr<GuardedArray> active;   ///< what is handed out now
  std::unique_ptr<GuardedArray> retired;  ///< what was handed out before
  const CeedScalar *read_from = nullptr;  ///< the array itself
  CeedScalar *write_to = nullptr;
};

/// Objects are known by their handles; each takes its entry with it when it goes.
struct State {
  std::mutex mutex;
  std::unordered_map<CeedVector, VectorGuard> vectors;
  std::unordered_map<CeedQFunctionContext, std::vector<unsigned char>> contexts;  ///< data as the readers got them
  std::unordered_map<CeedElemRestriction, std::uint64_t> restrictions;            ///< hash of the tables

  /// Made with the vector, so that none of its accesses need memory for it.
  VectorGuard &guard_of(CeedVector vec) {
    const std::lock_guard lock(mutex);
    return vectors.find(vec)->second;
  }
};

State &state_of(Ceed ceed);
/// The tables of the parent.
const CeedBackendOps &parent();

/// While one of these lives, this thread is in the parent.
class InParent {
 public:
  InParent() { depth++; }
  InParent(const InParent &) = delete;
  InParent &operator=(const InParent &) = delete;
  ~InParent() { depth--; }
  static bool is_now() { return depth > 0; }

 private:
  static thread_local int depth;
};

void fill_vector_ops(CeedVectorOps &ops);
void fill_restriction_ops(CeedElemRestrictionOps &ops);
void fill_basis_ops(CeedBasisOps &ops);
void fill_context_ops(CeedQFunctionContextOps &ops);
void fill_qfunction_ops(CeedQFunctionOps &ops);
void fill_operator_ops(CeedOperatorOps &ops);

/// Reports an error unless the tables of the restriction are as they were when it was made.
int check_restriction(CeedElemRestriction rstr);

}  // namespace hg::memcheck
