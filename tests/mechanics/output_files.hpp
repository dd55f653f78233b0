// A folder for the files of a test, the same on every rank, removed at the end.
#pragma once
#include <hdf5.h>
#include <stdlib.h>

#include <filesystem>
#include <string>
#include <vector>

#include "points_fixture.hpp"

namespace hg::test {

class Folder {
 public:
  Folder() {
    path_ = (std::filesystem::temp_directory_path() / "honeyguide-test-XXXXXX").string();
    if (my_rank() == 0 && !mkdtemp(path_.data())) fail("no temporary folder");
    MPI_Bcast(path_.data(), static_cast<int>(path_.size()), MPI_CHAR, 0, PETSC_COMM_WORLD);
  }
  ~Folder() {
    MPI_Barrier(PETSC_COMM_WORLD);
    std::error_code ignored;
    if (my_rank() == 0) std::filesystem::remove_all(path_, ignored);
  }
  Folder(const Folder &) = delete;
  Folder &operator=(const Folder &) = delete;
  std::string operator/(const std::string &name) const { return path_ + "/" + name; }
  std::vector<std::string> files() const {
    std::vector<std::string> names;
    for (const auto &e : std::filesystem::directory_iterator(path_)) names.push_back(e.path().filename().string());
    std::sort(names.begin(), names.end());
    return names;
  }

 private:
  std::string path_;
};

/// A whole dataset read by plain serial HDF5, with its dimensions.
template <class T>
std::vector<T> h5_dataset(const std::string &path, const std::string &name, std::vector<hsize_t> &dims) {
  const hid_t type =
      std::is_same_v<T, double> ? H5T_NATIVE_DOUBLE : (sizeof(T) == 8 ? H5T_NATIVE_INT64 : H5T_NATIVE_INT32);
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  const hid_t dataset = H5Dopen2(file, name.c_str(), H5P_DEFAULT), space = H5Dget_space(dataset);
  if (file < 0 || dataset < 0) fail("no dataset %s in %s", name.c_str(), path.c_str());
  dims.assign(H5Sget_simple_extent_ndims(space), 0);
  H5Sget_simple_extent_dims(space, dims.data(), nullptr);
  std::size_t n = 1;
  for (const hsize_t d : dims) n *= d;
  std::vector<T> values(n);
  const herr_t code = H5Dread(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
  H5Sclose(space);
  H5Dclose(dataset);
  H5Fclose(file);
  if (code < 0) fail("dataset %s in %s cannot be read", name.c_str(), path.c_str());
  return values;
}

}  // namespace hg::test
