// A solid with a solver on it, for the tests of solvers.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "mesh_fixture.hpp"
#include "operators/fem_operators.hpp"
#include "solve/static_solver.hpp"

namespace hg::test {

struct Problem {
  explicit Problem(const std::string &model, const std::string &faces = "3,3,3", PetscInt order = 2,
                   std::function<void(double *)> deform = nullptr, MPI_Comm comm = PETSC_COMM_WORLD,
                   const char *resource = "/cpu/self/ref/serial")
      : ceed(make_ceed(resource)) {
    MeshOptions mesh_options{.order = order};
    mesh_options.deform = deform;
    ScopedOptions box{{"-dm_plex_box_faces", faces}};
    mesh = std::make_unique<Mesh>(comm, ceed, mesh_options);
    options = RunOptions::read(comm);
    regions = std::make_unique<RegionMap>(*mesh, options.regions);
    boundary = std::make_unique<BoundaryConditions>(*mesh, comm);
    materials = {{&find_material(model), {.E = 2.8, .nu = 0.4, .rho = 1.}}};
    operators = std::make_unique<FemOperators>(*mesh, *regions, materials);
    solver = std::make_unique<StaticSolver>(*mesh, *operators, *boundary, options);
    solver->operators_changed(std::vector<char>(mesh->num_cells, 1));
    petsc_check(DMCreateGlobalVector(mesh->dm, u.put()));
    petsc_check(VecZeroEntries(u));
  }

  SolveResult solve(double t = 1) { return solver->solve({.t = t}, u); }

  std::vector<double> local() const {
    VecHandle vector;
    petsc_check(DMCreateLocalVector(mesh->dm, vector.put()));
    solver->to_local(u, vector);
    const PetscScalar *array;
    petsc_check(VecGetArrayRead(vector, &array));
    std::vector<double> values(array, array + mesh->local_size);
    petsc_check(VecRestoreArrayRead(vector, &array));
    return values;
  }

  /// Of this rank's cells.
  double energy() const {
    auto values = local();
    CeedVectorHandle vector;
    ceed_check(CeedVectorCreate(ceed, mesh->local_size, vector.put()));
    ceed_check(CeedVectorSetArray(vector, CEED_MEM_HOST, CEED_USE_POINTER, values.data()));
    return operators->integrals(vector)[0].strain_energy;
  }

  CeedHandle ceed;
  std::unique_ptr<Mesh> mesh;
  RunOptions options;
  std::unique_ptr<RegionMap> regions;
  std::unique_ptr<BoundaryConditions> boundary;
  std::vector<RegionMaterial> materials;
  std::unique_ptr<FemOperators> operators;
  std::unique_ptr<StaticSolver> solver;
  VecHandle u;
};

}  // namespace hg::test
