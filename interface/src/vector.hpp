/// @file
/// The access protocol of vectors. Memory is the backend's.
#pragma once

#include <cstdint>

#include "ceed.hpp"

struct CeedVector_private final : CeedObject_private {
  ~CeedVector_private() override;
  void check_destroyable() const override;
  void view(FILE *stream) const override;
  Ceed owner() const override { return ceed.get(); }

  hg::Ref<Ceed_private> ceed;
  CeedSize length = 0;
  std::uint64_t state = 0;  ///< even: no writer; grows by 2 with every possible change
  std::uint64_t num_readers = 0;
  void *data = nullptr;  ///< of the backend

  bool has_writer() const { return state % 2 == 1; }
  const CeedVectorOps &ops() const { return ceed->ops.vector; }
};

namespace hg {

/// Handle -> vector with values; NULL and the sentinels CEED_VECTOR_ACTIVE and CEED_VECTOR_NONE are errors.
CeedVector_private &deref_vector(CeedVector vec, const char *what = "CeedVector", Where where = Where::current());
/// Throws (CEED_ERROR_ACCESS) unless the array may be written now.
void require_writable(const CeedVector_private &vec, Where where = Where::current());
/// Throws (CEED_ERROR_ACCESS) unless the array may be read now.
void require_readable(const CeedVector_private &vec, Where where = Where::current());
/// Throws (CEED_ERROR_INCOMPLETE) unless the vector holds values. A vector of length 0 always does.
void require_values(CeedVector_private &vec, const char *what, Where where = Where::current());

/// Read access to a host array for a scope.
class ReadArray {
 public:
  explicit ReadArray(CeedVector vec) : vec_(vec) { check(CeedVectorGetArrayRead(vec, CEED_MEM_HOST, &array_)); }
  ReadArray(const ReadArray &) = delete;
  ReadArray &operator=(const ReadArray &) = delete;
  ~ReadArray() { CeedVectorRestoreArrayRead(vec_, &array_); }
  const CeedScalar *data() const { return array_; }
  const CeedScalar &operator[](CeedSize i) const { return array_[i]; }

 private:
  CeedVector vec_;
  const CeedScalar *array_ = nullptr;
};

/// Read and write access (or write-only access, contents undefined) to a host array for a scope.
class WriteArray {
 public:
  enum Mode { read_write, write_only };
  explicit WriteArray(CeedVector vec, Mode mode = read_write) : vec_(vec) {
    check(mode == read_write ? CeedVectorGetArray(vec, CEED_MEM_HOST, &array_)
                             : CeedVectorGetArrayWrite(vec, CEED_MEM_HOST, &array_));
  }
  WriteArray(const WriteArray &) = delete;
  WriteArray &operator=(const WriteArray &) = delete;
  ~WriteArray() { CeedVectorRestoreArray(vec_, &array_); }
  CeedScalar *data() const { return array_; }
  CeedScalar &operator[](CeedSize i) const { return array_[i]; }

 private:
  CeedVector vec_;
  CeedScalar *array_ = nullptr;
};

}  // namespace hg
