/// @file
/// One case of bps-kernel: a problem at one degree and size on one backend.
#pragma once

#include <array>
#include <optional>

#include "bakeoff.hpp"
#include "cg.hpp"
#include "record.hpp"

namespace hg::bps {

struct Case {
  Problem problem;
  CeedInt degree;
  std::array<CeedInt, 3> num_cells;
  std::optional<Placement> placement;  ///< empty: at quadrature points
  CeedInt points_per_cell = 0;

  /// `bp3 p=2, 8×8×8 cells, 64 uniform points a cell`
  std::string description() const;
};

/// The operator of a case, ready to be applied, and its boundary mask.
class CaseOperator {
 public:
  CaseOperator(Ceed ceed, const Case &which);

  const Bakeoff &bakeoff() const { return bakeoff_; }
  /// Null for mass.
  CeedVector mask() const { return mask_; }

 private:
  CaseOperator(Ceed ceed, const Case &which, const BoxMesh &mesh);

  Bakeoff bakeoff_;
  Vector mask_;
};

/// Times `repetitions` applications after one to warm up, then solves with CG. Throws Error.
Record run_case(Ceed ceed, const Case &which, int repetitions, const CgOptions &cg);

}  // namespace hg::bps
