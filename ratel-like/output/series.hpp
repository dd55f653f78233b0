/// @file
/// The list of outputs of a time series, kept as text so that a restarted run can go on from the file it finds.
#pragma once

#include <petscsys.h>

#include <mpi.h>

#include <string>
#include <vector>

namespace hg {

/// Blocks of a text file, one for each output, between a fixed head and tail. A block begins with a comment that names
/// its step, which is how resume() finds it again.
class TimeSeries {
 public:
  TimeSeries(MPI_Comm comm, std::string path, std::string head, std::string tail);
  /// Adds a block (or replaces that of the same step and all after it) and writes the whole file. Collective.
  void add(PetscInt step, const std::string &block);
  /// Keeps the blocks of an existing file with step <= last_step; a missing file is an empty one. Collective.
  void resume(PetscInt last_step);
  std::size_t size() const { return blocks_.size(); }

 private:
  struct Block {
    PetscInt step;
    std::string text;
  };
  MPI_Comm comm_;
  std::string path_, head_, tail_;
  std::vector<Block> blocks_;
};

/// "<prefix>-000012<extension>"
std::string numbered(const std::string &prefix, PetscInt step, const std::string &extension);
/// The part of a path after its last '/': files of a series stand in one folder and name each other so.
std::string file_name(const std::string &path);

}  // namespace hg
