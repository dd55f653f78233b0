/// @file
/// Quantities of a run over time, as CSV.
#pragma once

#include <mpi.h>
#include <petscsys.h>

#include <array>
#include <string>
#include <vector>

namespace hg {

/// What is known after a step, summed over all ranks.
struct Record {
  /// One material region. SI units: kg, m³, J, m, N.
  struct Region {
    double mass = 0, volume = 0, strain_energy = 0;
    std::array<double, 3> mean_displacement{};  ///< mean over mass
    std::array<double, 3> body_force{};         ///< resultant: mass times g(t)
  };

  PetscInt step = 0;
  double time = 0, dt = 0;
  PetscInt newton_iterations = 0, linear_iterations = 0;
  std::array<double, 3> momentum{};  ///< kg m/s
  std::vector<Region> regions;
  std::vector<std::array<double, 3>> probes;     ///< displacement of each probe
  std::vector<std::array<double, 3>> reactions;  ///< force on the body through each boundary face
};

/// Columns of the tables.
struct RecordNames {
  std::vector<std::string> regions, probes, reactions;
};

/// Which tables a run writes, read from
///   -ts_monitor_quantities [ascii:]file.csv     every quantity, one line for each step
///   -ts_monitor_strain_energy [ascii:]file.csv  step, time, and the strain energy of each region and in all
/// An option without a file prints to the screen. Rank 0 writes; each line is flushed.
class Monitors {
 public:
  Monitors(MPI_Comm comm, RecordNames names);

  /// Starts the files anew, or, after a restart, keeps their lines up to `last_step` (negative: starts anew).
  void begin(PetscInt last_step);
  void write(const Record &record);

 private:
  struct Table {
    std::string option, file;
    bool on = false;
    bool everything = false;
  };
  std::string header(const Table &table) const;
  std::string line(const Table &table, const Record &record) const;
  void put(const Table &table, const std::string &text, const char *mode);

  MPI_Comm comm_;
  int rank_ = 0;
  RecordNames names_;
  std::vector<Table> tables_;
};

}  // namespace hg
