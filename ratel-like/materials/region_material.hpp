/// @file
/// The material of each region, as the options give it.
#pragma once

#include <mpi.h>

#include <span>
#include <vector>

#include "materials/material.hpp"
#include "options/options.hpp"

namespace hg {

/// What fills one region. Its number is its place in RunOptions::regions.
struct RegionMaterial {
  const Material *material = nullptr;
  ElasticParameters parameters;
};

/// Reads -<prefix>model, -<prefix>E, -<prefix>nu, -<prefix>rho of one region; a model without its prefix (-model)
/// serves every region that has none of its own. Collective. Throws hg::Error for an unknown model (listing the known
/// ones), a missing E or nu, E <= 0, nu outside (-1, 1/2) or rho < 0.
RegionMaterial read_region_material(MPI_Comm comm, const Region &region);

/// The same for all regions, in order.
std::vector<RegionMaterial> read_region_materials(MPI_Comm comm, std::span<const Region> regions);

}  // namespace hg
