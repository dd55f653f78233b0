/// @file
/// Parallel HDF5 in the few shapes that the writers need. Every function is collective and makes the same HDF5 calls on
/// every rank whatever fails, so that a full disk seen by one rank cannot leave the others waiting; failures are kept
/// and agreed on once, by H5File::finish.
#pragma once

#include <hdf5.h>
#include <mpi.h>

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <utility>

namespace hg {

/// Owns an HDF5 identifier.
class H5Id {
 public:
  H5Id() = default;
  H5Id(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
  ~H5Id() { reset(); }
  H5Id(H5Id &&other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
  H5Id &operator=(H5Id &&other) noexcept {
    if (this != &other) {
      reset();
      id_ = std::exchange(other.id_, -1);
      close_ = other.close_;
    }
    return *this;
  }
  operator hid_t() const { return id_; }
  bool ok() const { return id_ >= 0; }
  /// Closes now; false if that failed (the last data may be written at a close).
  bool reset() {
    const bool good = id_ < 0 || close_(std::exchange(id_, -1)) >= 0;
    return good;
  }

 private:
  hid_t id_ = -1;
  herr_t (*close_)(hid_t) = nullptr;
};

/// Rows of a dataset that lie on this rank: `local` of `total`, from `first`.
struct H5Rows {
  hsize_t local = 0, first = 0, total = 0;
  static H5Rows of(MPI_Comm comm, hsize_t local);
};

/// One file, open on all ranks of a communicator. Failures are silent until finish() or status().
class H5File {
 public:
  enum class Mode { kCreate, kRead };
  H5File(MPI_Comm comm, const std::string &path, Mode mode);
  ~H5File();
  H5File(const H5File &) = delete;
  H5File &operator=(const H5File &) = delete;

  /// False once a call has failed on this rank.
  bool good() const { return error_.empty(); }
  /// What failed first on this rank; empty if nothing did.
  const std::string &error() const { return error_; }
  void note(const std::string &error) {
    if (error_.empty()) error_ = error;
  }

  void make_group(const std::string &path);
  /// A rows × width dataset (rows alone for width 0), each rank its own rows.
  void write(const std::string &name, hid_t type, const void *data, const H5Rows &rows, hsize_t width);
  void read(const std::string &name, hid_t type, void *data, const H5Rows &rows, hsize_t width);
  /// Rows of a dataset, or -1 (not noted as a failure).
  long long rows(const std::string &name) const;

  /// Attributes: the same value on every rank, on a group ("/" for the file).
  void write_attribute(const std::string &group, const std::string &name, std::int64_t value);
  void write_attribute(const std::string &group, const std::string &name, double value);
  void write_attribute(const std::string &group, const std::string &name, const std::string &value);
  bool read_attribute(const std::string &group, const std::string &name, std::int64_t &value) const;
  bool read_attribute(const std::string &group, const std::string &name, double &value) const;
  bool read_attribute(const std::string &group, const std::string &name, std::string &value) const;
  /// Every attribute of a group.
  std::map<std::string, double> read_doubles(const std::string &group) const;
  std::map<std::string, std::string> read_strings(const std::string &group) const;

  /// Flushes and closes on every rank, then throws hg::Error on all if any rank failed: "cannot <verb> <path>:
  /// <cause>".
  void finish(const char *verb);

 private:
  void check(bool ok, const std::string &what);
  void make_room_if_any_failed();
  template <class T>
  void write_attribute_of(const std::string &group, const std::string &name, hid_t type, const T *value);
  void transfer(const std::string &name, hid_t dataset, hid_t type, const H5Rows &rows, hsize_t width, const void *out,
                void *in);

  MPI_Comm comm_;
  std::string path_;
  Mode mode_;
  H5Id file_;
  std::string error_;
  H5E_auto2_t old_handler_ = nullptr;
  void *old_data_ = nullptr;
};

/// Agreement over ranks: throws hg::Error with the message of the lowest rank whose `error` is not empty, on every
/// rank.
void throw_together(MPI_Comm comm, const std::string &error);

/// For its lifetime a write beyond the limit on file sizes is an error to be reported, not a signal that ends the run.
class NoFileSizeSignal {
 public:
  NoFileSizeSignal();
  ~NoFileSizeSignal();

 private:
  void (*old_)(int);
};

/// Rank 0 writes `text` to `path` by way of a temporary file and a rename; throws hg::Error on every rank. Collective.
void write_text(MPI_Comm comm, const std::string &path, const std::string &text);

/// Asks the file system for room for the bytes of all ranks, before any is written, by making the file on rank 0 with
/// all its blocks: a disk that is too full is told at once and by its own message. Returns what failed, on rank 0. HDF5
/// then makes the file anew; whoever fills the disk in between is met by the errors of the writes.
std::string reserve(MPI_Comm comm, const std::string &path, std::uint64_t mine);

/// Rank 0: flushes a finished file to the disk and renames it; empty, or what failed. Others: empty at once.
std::string sync_and_rename(MPI_Comm comm, const std::string &from, const std::string &to);

/// " (… bytes free on that disk)" for messages; empty if unknown.
std::string free_space(const std::string &path);

}  // namespace hg
