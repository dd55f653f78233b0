#include "output/h5.hpp"

#include <fcntl.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <vector>

#include "options/error.hpp"

namespace hg {
namespace {

/// The innermost message on HDF5's error stack: nearest to the cause.
std::string h5_cause() {
  std::string text;
  H5Ewalk2(
      H5E_DEFAULT, H5E_WALK_UPWARD,
      [](unsigned, const H5E_error2_t *e, void *out) -> herr_t {
        auto &s = *static_cast<std::string *>(out);
        if (s.empty() && e->desc && *e->desc) s = e->desc;
        return 0;
      },
      &text);
  H5Eclear2(H5E_DEFAULT);
  return text;
}

std::string folder_of(const std::string &path) {
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  return folder.empty() ? std::string(".") : folder.string();
}

/// Independent transfers: each rank's rows are one contiguous piece of the file, so that nothing is gained by a
/// collective one, and a write that fails on one rank (a full disk) cannot leave the others waiting inside MPI-IO.
H5Id transfer_list() {
  H5Id list(H5Pcreate(H5P_DATASET_XFER), H5Pclose);
  H5Pset_dxpl_mpio(list, H5FD_MPIO_INDEPENDENT);
  return list;
}

}  // namespace

H5Rows H5Rows::of(MPI_Comm comm, hsize_t local) {
  H5Rows r;
  r.local = local;
  unsigned long long mine = local, first = 0, total = 0;
  MPI_Exscan(&mine, &first, 1, MPI_UNSIGNED_LONG_LONG, MPI_SUM, comm);
  MPI_Allreduce(&mine, &total, 1, MPI_UNSIGNED_LONG_LONG, MPI_SUM, comm);
  int rank;
  MPI_Comm_rank(comm, &rank);
  r.first = rank == 0 ? 0 : first;
  r.total = total;
  return r;
}

H5File::H5File(MPI_Comm comm, const std::string &path, Mode mode) : comm_(comm), path_(path), mode_(mode) {
  H5Eget_auto2(H5E_DEFAULT, &old_handler_, &old_data_);
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  const H5Id access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_fapl_mpio(access, comm, MPI_INFO_NULL);
  file_ = H5Id(mode == Mode::kCreate ? H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access)
                                     : H5Fopen(path.c_str(), H5F_ACC_RDONLY, access),
               H5Fclose);
  check(file_.ok(), mode == Mode::kCreate ? "creating the file" : "opening the file");
}

H5File::~H5File() {
  file_.reset();
  H5Eset_auto2(H5E_DEFAULT, old_handler_, old_data_);
}

void H5File::check(bool ok, const std::string &what) {
  if (ok) return;
  const std::string cause = h5_cause();
  note(what + " failed" + (cause.empty() ? "" : ": " + cause));
}

void H5File::make_group(const std::string &path) {
  const H5Id group(H5Gcreate2(file_, path.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose);
  check(group.ok(), "group " + path);
}

void H5File::transfer(const std::string &name, hid_t dataset, hid_t type, const H5Rows &rows, hsize_t width,
                      const void *out, void *in) {
  if (rows.local == 0) return;
  const int rank = width ? 2 : 1;
  const hsize_t local[2] = {rows.local, width}, first[2] = {rows.first, 0};
  const H5Id in_file(H5Dget_space(dataset), H5Sclose), in_memory(H5Screate_simple(rank, local, nullptr), H5Sclose);
  H5Sselect_hyperslab(in_file, H5S_SELECT_SET, first, nullptr, local, nullptr);
  const H5Id list = transfer_list();
  const herr_t code = out ? H5Dwrite(dataset, type, in_memory, in_file, list, out)
                          : H5Dread(dataset, type, in_memory, in_file, list, in);
  check(code >= 0, (out ? "writing " : "reading ") + name);
}

void H5File::write(const std::string &name, hid_t type, const void *data, const H5Rows &rows, hsize_t width) {
  const hsize_t dims[2] = {rows.total, width};
  const H5Id space(H5Screate_simple(width ? 2 : 1, dims, nullptr), H5Sclose);
  const H5Id properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  H5Pset_obj_track_times(properties, false);  // the same state gives the same file, byte by byte
  H5Id dataset(H5Dcreate2(file_, name.c_str(), type, space, H5P_DEFAULT, properties, H5P_DEFAULT), H5Dclose);
  check(dataset.ok(), "dataset " + name);
  if (!dataset.ok()) return;
  transfer(name, dataset, type, rows, width, data, nullptr);
  check(dataset.reset(), "closing " + name);
}

void H5File::read(const std::string &name, hid_t type, void *data, const H5Rows &rows, hsize_t width) {
  const H5Id dataset(H5Dopen2(file_, name.c_str(), H5P_DEFAULT), H5Dclose);
  check(dataset.ok(), "dataset " + name);
  if (!dataset.ok()) return;
  const H5Id space(H5Dget_space(dataset), H5Sclose);
  hsize_t dims[2] = {0, 0};
  const int rank = H5Sget_simple_extent_ndims(space);
  if (rank != (width ? 2 : 1) || H5Sget_simple_extent_dims(space, dims, nullptr) < 0 || dims[0] != rows.total ||
      dims[1] != width) {
    note("dataset " + name + " has the wrong shape");
    return;  // the same on every rank
  }
  transfer(name, dataset, type, rows, width, nullptr, data);
}

long long H5File::rows(const std::string &name) const {
  if (!file_.ok() || H5Lexists(file_, name.c_str(), H5P_DEFAULT) <= 0) return -1;
  const H5Id dataset(H5Dopen2(file_, name.c_str(), H5P_DEFAULT), H5Dclose);
  if (!dataset.ok()) return -1;
  const H5Id space(H5Dget_space(dataset), H5Sclose);
  hsize_t dims[8] = {0};
  if (H5Sget_simple_extent_ndims(space) < 1 || H5Sget_simple_extent_ndims(space) > 8) return -1;
  H5Sget_simple_extent_dims(space, dims, nullptr);
  return static_cast<long long>(dims[0]);
}

template <class T>
void H5File::write_attribute_of(const std::string &group, const std::string &name, hid_t type, const T *value) {
  const H5Id at(H5Gopen2(file_, group.c_str(), H5P_DEFAULT), H5Gclose), space(H5Screate(H5S_SCALAR), H5Sclose);
  const H5Id attribute(H5Acreate2(at, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  check(attribute.ok() && H5Awrite(attribute, type, value) >= 0, "attribute " + name);
}

void H5File::write_attribute(const std::string &group, const std::string &name, std::int64_t value) {
  write_attribute_of(group, name, H5T_NATIVE_INT64, &value);
}

void H5File::write_attribute(const std::string &group, const std::string &name, double value) {
  write_attribute_of(group, name, H5T_NATIVE_DOUBLE, &value);
}

void H5File::write_attribute(const std::string &group, const std::string &name, const std::string &value) {
  const H5Id type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type, value.size() + 1);
  write_attribute_of(group, name, type, value.c_str());
}

namespace {

template <class T>
bool read_number(hid_t at, const char *name, hid_t type, T &value) {
  if (at < 0 || H5Aexists(at, name) <= 0) return false;
  const H5Id attribute(H5Aopen(at, name, H5P_DEFAULT), H5Aclose);
  return attribute.ok() && H5Aread(attribute, type, &value) >= 0;
}

bool read_string(hid_t at, const char *name, std::string &value) {
  if (at < 0 || H5Aexists(at, name) <= 0) return false;
  const H5Id attribute(H5Aopen(at, name, H5P_DEFAULT), H5Aclose);
  const H5Id type(H5Aget_type(attribute), H5Tclose);
  if (!type.ok() || H5Tget_class(type) != H5T_STRING || H5Tis_variable_str(type) > 0) return false;
  std::vector<char> text(H5Tget_size(type) + 1, '\0');
  if (H5Aread(attribute, type, text.data()) < 0) return false;
  value = text.data();
  return true;
}

std::vector<std::string> attribute_names(hid_t at) {
  std::vector<std::string> names;
  hsize_t n = 0;
  H5Aiterate2(
      at, H5_INDEX_NAME, H5_ITER_INC, &n,
      [](hid_t, const char *name, const H5A_info_t *, void *out) -> herr_t {
        static_cast<std::vector<std::string> *>(out)->push_back(name);
        return 0;
      },
      &names);
  return names;
}

}  // namespace

bool H5File::read_attribute(const std::string &group, const std::string &name, std::int64_t &value) const {
  const H5Id at(H5Gopen2(file_, group.c_str(), H5P_DEFAULT), H5Gclose);
  return read_number(at, name.c_str(), H5T_NATIVE_INT64, value);
}

bool H5File::read_attribute(const std::string &group, const std::string &name, double &value) const {
  const H5Id at(H5Gopen2(file_, group.c_str(), H5P_DEFAULT), H5Gclose);
  return read_number(at, name.c_str(), H5T_NATIVE_DOUBLE, value);
}

bool H5File::read_attribute(const std::string &group, const std::string &name, std::string &value) const {
  const H5Id at(H5Gopen2(file_, group.c_str(), H5P_DEFAULT), H5Gclose);
  return read_string(at, name.c_str(), value);
}

std::map<std::string, double> H5File::read_doubles(const std::string &group) const {
  const H5Id at(H5Gopen2(file_, group.c_str(), H5P_DEFAULT), H5Gclose);
  std::map<std::string, double> all;
  if (!at.ok()) return all;
  for (const std::string &name : attribute_names(at)) {
    double value;
    if (read_number(at, name.c_str(), H5T_NATIVE_DOUBLE, value)) all[name] = value;
  }
  return all;
}

std::map<std::string, std::string> H5File::read_strings(const std::string &group) const {
  const H5Id at(H5Gopen2(file_, group.c_str(), H5P_DEFAULT), H5Gclose);
  std::map<std::string, std::string> all;
  if (!at.ok()) return all;
  for (const std::string &name : attribute_names(at)) {
    std::string value;
    if (read_string(at, name.c_str(), value)) all[name] = value;
  }
  return all;
}

void H5File::finish(const char *verb) {
  const std::string space = mode_ == Mode::kCreate ? free_space(path_) : "";
  if (file_.ok() && mode_ == Mode::kCreate) {
    // A file that HDF5 fails to close stays in its tables and crashes it at the end of the program. So once a write has
    // failed, make room for what HDF5 still has to write by giving up what was written, before it tries.
    make_room_if_any_failed();
    check(H5Fflush(file_, H5F_SCOPE_GLOBAL) >= 0, "flushing");
    make_room_if_any_failed();
  }
  check(file_.reset(), "closing");
  throw_together(comm_, good() ? "" : std::string("cannot ") + verb + " " + path_ + ": " + error_ + space);
}

void H5File::make_room_if_any_failed() {
  int rank, bad = !good();
  MPI_Comm_rank(comm_, &rank);
  MPI_Allreduce(MPI_IN_PLACE, &bad, 1, MPI_INT, MPI_MAX, comm_);
  if (!bad) return;
  if (rank == 0 && truncate(path_.c_str(), 0) != 0) note("the file cannot be emptied");
  MPI_Barrier(comm_);
}

void throw_together(MPI_Comm comm, const std::string &error) {
  int rank, size;
  MPI_Comm_rank(comm, &rank);
  MPI_Comm_size(comm, &size);
  const int mine = error.empty() ? size : rank;
  int first = size;
  MPI_Allreduce(&mine, &first, 1, MPI_INT, MPI_MIN, comm);
  if (first == size) return;
  int length = static_cast<int>(error.size());
  MPI_Bcast(&length, 1, MPI_INT, first, comm);
  std::string text(rank == first ? error : std::string(length, ' '));
  MPI_Bcast(text.data(), length, MPI_CHAR, first, comm);
  throw Error(text);
}

NoFileSizeSignal::NoFileSizeSignal() : old_(std::signal(SIGXFSZ, SIG_IGN)) {}
NoFileSizeSignal::~NoFileSizeSignal() {
  if (old_ != SIG_ERR) std::signal(SIGXFSZ, old_);
}

std::string free_space(const std::string &path) {
  struct statvfs s;
  if (statvfs(folder_of(path).c_str(), &s) != 0) return "";
  const auto bytes = static_cast<unsigned long long>(s.f_bavail) * s.f_frsize;
  char text[64];
  std::snprintf(text, sizeof text, " (%llu bytes are free on that disk)", bytes);
  return text;
}

std::string reserve(MPI_Comm comm, const std::string &path, std::uint64_t mine) {
  constexpr std::uint64_t kMetadata = 1 << 16;  // what HDF5 writes beside the data, and some more
  std::uint64_t bytes = 0;
  int rank;
  MPI_Comm_rank(comm, &rank);
  MPI_Reduce(&mine, &bytes, 1, MPI_UINT64_T, MPI_SUM, 0, comm);
  if (rank != 0) return "";
  bytes += kMetadata;
  const int fd = open(path.c_str(), O_RDWR | O_CREAT | O_TRUNC, 0666);
  if (fd < 0) return "creating " + path + ": " + std::strerror(errno);
  std::string error;
  // Not every file system can reserve; there the writes themselves tell.
  if (fallocate(fd, 0, 0, static_cast<off_t>(bytes)) != 0 && errno != EOPNOTSUPP && errno != ENOSYS) {
    error = std::string(std::strerror(errno)) + ": " + std::to_string(bytes) + " bytes are needed" + free_space(path);
  }
  close(fd);
  return error;
}

std::string sync_and_rename(MPI_Comm comm, const std::string &from, const std::string &to) {
  int rank;
  MPI_Comm_rank(comm, &rank);
  if (rank != 0) return "";
  const auto failure = [&](const char *what) { return std::string(what) + " " + from + ": " + std::strerror(errno); };
  const int fd = open(from.c_str(), O_RDWR);
  if (fd < 0) return failure("opening");
  const bool synced = fsync(fd) == 0;
  const std::string sync_error = synced ? "" : failure("flushing");
  if (close(fd) != 0 && synced) return failure("closing");
  if (!synced) return sync_error;
  if (std::rename(from.c_str(), to.c_str()) != 0) return failure("renaming");
  const int dir = open(folder_of(to).c_str(), O_RDONLY | O_DIRECTORY);  // so that the new name survives a crash too
  if (dir >= 0) {
    (void)fsync(dir);
    close(dir);
  }
  return "";
}

void write_text(MPI_Comm comm, const std::string &path, const std::string &text) {
  int rank;
  MPI_Comm_rank(comm, &rank);
  std::string error;
  if (rank == 0) {
    const NoFileSizeSignal quiet;
    const std::string temporary = path + ".tmp";
    std::FILE *file = std::fopen(temporary.c_str(), "wb");
    if (!file) {
      error = "cannot write " + path + ": " + std::strerror(errno);
    } else {
      const bool written = std::fwrite(text.data(), 1, text.size(), file) == text.size() && std::fflush(file) == 0;
      if (!written) error = "cannot write " + path + ": " + std::strerror(errno) + free_space(path);
      if (std::fclose(file) != 0 && error.empty()) error = "cannot write " + path + ": " + std::strerror(errno);
      if (error.empty() && std::rename(temporary.c_str(), path.c_str()) != 0) {
        error = "cannot write " + path + ": " + std::strerror(errno);
      }
      if (!error.empty()) std::remove(temporary.c_str());
    }
  }
  throw_together(comm, error);
}

}  // namespace hg
