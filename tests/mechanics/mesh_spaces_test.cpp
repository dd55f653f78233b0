// The mesh and its nodal spaces: one frame for corners and nodes, polynomials exact across cells and ranks.
#include <ceed/backend.h>
#include <gtest/gtest.h>

#include "mesh/region_map.hpp"
#include "mesh_fixture.hpp"

namespace hg::test {
namespace {

double sum_over_ranks(double mine) {
  double sum = 0;
  MPI_Allreduce(&mine, &sum, 1, MPI_DOUBLE, MPI_SUM, PETSC_COMM_WORLD);
  return sum;
}

std::string test_file(const std::string &stem) {
  int size;
  MPI_Comm_size(PETSC_COMM_WORLD, &size);
  return stem + "_np" + std::to_string(size) + ".msh";
}

// E-vector of a local array of a space, as a host copy.
std::vector<double> to_elements(const Mesh &mesh, CeedElemRestriction rstr, const std::vector<double> &local) {
  CeedVectorHandle l, e;
  ceed_check(CeedVectorCreate(mesh.ceed, static_cast<CeedSize>(local.size()), l.put()));
  ceed_check(CeedVectorSetArray(l, CEED_MEM_HOST, CEED_COPY_VALUES, const_cast<double *>(local.data())));
  ceed_check(CeedElemRestrictionCreateVector(rstr, nullptr, e.put()));
  ceed_check(CeedElemRestrictionApply(rstr, CEED_NOTRANSPOSE, l, e, CEED_REQUEST_IMMEDIATE));
  CeedSize size;
  const CeedScalar *array;
  ceed_check(CeedVectorGetLength(e, &size));
  ceed_check(CeedVectorGetArrayRead(e, CEED_MEM_HOST, &array));
  std::vector<double> copy(array, array + size);
  ceed_check(CeedVectorRestoreArrayRead(e, &array));
  return copy;
}

std::array<double, 3> map(std::span<const double, 24> corners, const std::array<double, 3> &X) {
  std::array<double, 3> x{};
  for (int a = 0; a < 8; ++a) {
    double N = 1;
    for (int d = 0; d < 3; ++d) N *= (1 + (a >> d & 1 ? X[d] : -X[d])) / 2;
    for (int c = 0; c < 3; ++c) x[c] += N * corners[3 * a + c];
  }
  return x;
}

double monomials(const std::array<double, 3> &x, int p) {
  return std::pow(x[0] - 0.3, p) + 2 * std::pow(x[1], p) - std::pow(x[2] + 0.1, p) +
         x[0] * std::pow(x[1], p > 1 ? p - 1 : 0);
}

// Every node, seen from every cell that has it, is where that cell's trilinear map puts its Gauss-Lobatto point. This
// fails for any disagreement about the direction of an edge or the frame of a face.
double largest_node_mismatch(const Mesh &mesh, PetscInt p) {
  const MeshSpace &space = mesh.space(p, 3);
  const std::vector<double> e = to_elements(mesh, space.rstr, mesh.node_coordinates(p));
  const int P = static_cast<int>(p) + 1, nodes = P * P * P;
  std::vector<double> reference(P), weights(P);
  ceed_check(CeedLobattoQuadrature(P, reference.data(), weights.data()));
  CeedInt layout[3];
  ceed_check(CeedElemRestrictionGetELayout(space.rstr, layout));
  double worst = 0;
  for (CeedInt cell = 0; cell < mesh.num_cells; ++cell) {
    for (int n = 0; n < nodes; ++n) {
      const auto x = map(mesh.corners(cell), {reference[n % P], reference[n / P % P], reference[n / P / P]});
      for (int c = 0; c < 3; ++c) {
        worst = std::max(worst, std::abs(e[n * layout[0] + c * layout[1] + cell * layout[2]] - x[c]));
      }
    }
  }
  return worst;
}

// A field at the quadrature points of every cell, through an operator whose QFunction copies: value i of `size` at
// point q of cell c is at (c * size + i) * num_q + q.
std::vector<double> at_points(const Mesh &mesh, CeedElemRestriction rstr, CeedBasis basis, CeedEvalMode mode,
                              CeedInt size, CeedVector l) {
  CeedInt num_q;
  ceed_check(CeedBasisGetNumQuadraturePoints(basis, &num_q));
  const CeedSize total = static_cast<CeedSize>(mesh.num_cells) * size * num_q;
  const CeedInt strides[3] = {1, num_q, num_q * size};
  CeedElemRestrictionHandle strided;
  CeedQFunctionHandle copy;
  CeedOperatorHandle op;
  CeedVectorHandle out;
  ceed_check(CeedElemRestrictionCreateStrided(mesh.ceed, mesh.num_cells, num_q, size, total, strides, strided.put()));
  ceed_check(CeedQFunctionCreateIdentity(mesh.ceed, size, mode, CEED_EVAL_NONE, copy.put()));
  ceed_check(CeedOperatorCreate(mesh.ceed, copy, nullptr, nullptr, op.put()));
  ceed_check(CeedOperatorSetField(op, "input", rstr, basis, CEED_VECTOR_ACTIVE));
  ceed_check(CeedOperatorSetField(op, "output", strided, CEED_BASIS_NONE, CEED_VECTOR_ACTIVE));
  ceed_check(CeedVectorCreate(mesh.ceed, total, out.put()));
  ceed_check(CeedOperatorApply(op, l, out, CEED_REQUEST_IMMEDIATE));
  const CeedScalar *array;
  ceed_check(CeedVectorGetArrayRead(out, CEED_MEM_HOST, &array));
  std::vector<double> values(array, array + total);
  ceed_check(CeedVectorRestoreArrayRead(out, &array));
  return values;
}

double volume(const Mesh &mesh) {
  const CeedInt Q = 3, num_q = Q * Q * Q;
  if (mesh.num_cells == 0) return 0;
  CeedBasisHandle basis = mesh.basis(1, 3, Q, CEED_GAUSS);
  const std::vector<double> g = at_points(mesh, mesh.rstr_x, basis, CEED_EVAL_GRAD, 9, mesh.x);
  std::vector<double> points(Q), weights(Q);
  ceed_check(CeedGaussQuadrature(Q, points.data(), weights.data()));
  double sum = 0;
  for (CeedInt cell = 0; cell < mesh.num_cells; ++cell) {
    for (CeedInt q = 0; q < num_q; ++q) {
      const auto J = [&](int d, int c) { return g[(cell * 9 + d * 3 + c) * num_q + q]; };
      const double det = J(0, 0) * (J(1, 1) * J(2, 2) - J(1, 2) * J(2, 1)) -
                         J(0, 1) * (J(1, 0) * J(2, 2) - J(1, 2) * J(2, 0)) +
                         J(0, 2) * (J(1, 0) * J(2, 1) - J(1, 1) * J(2, 0));
      EXPECT_GT(det, 0);
      sum += weights[q % Q] * weights[q / Q % Q] * weights[q / Q / Q] * det;
    }
  }
  return sum;
}

// Values of a polynomial of degree p at the nodes, interpolated by the basis to Gauss points of each cell.
double largest_interpolation_error(const Mesh &mesh, PetscInt p) {
  const MeshSpace &space = mesh.space(p, 1);
  const std::vector<double> &at = mesh.node_coordinates(p);
  VecHandle global, local;
  petsc_check(DMCreateLocalVector(space.dm, local.put()));
  petsc_check(DMCreateGlobalVector(space.dm, global.put()));
  PetscScalar *array;
  petsc_check(VecGetArray(local, &array));
  for (PetscInt i = 0; i < space.local_size; ++i) {
    array[i] = monomials({at[3 * i], at[3 * i + 1], at[3 * i + 2]}, static_cast<int>(p));
  }
  petsc_check(VecRestoreArray(local, &array));
  // Through the global vector: only the owner's values survive.
  petsc_check(DMLocalToGlobal(space.dm, local, INSERT_VALUES, global));
  petsc_check(VecSet(local, NAN));
  petsc_check(DMGlobalToLocal(space.dm, global, INSERT_VALUES, local));
  petsc_check(VecGetArray(local, &array));
  const std::vector<double> nodal(array, array + space.local_size);
  petsc_check(VecRestoreArray(local, &array));
  if (mesh.num_cells == 0) return 0;

  const CeedInt Q = static_cast<CeedInt>(p) + 2, num_q = Q * Q * Q;
  CeedBasisHandle basis = mesh.basis(p, 1, Q, CEED_GAUSS);
  CeedVectorHandle l;
  ceed_check(CeedVectorCreate(mesh.ceed, space.local_size, l.put()));
  ceed_check(CeedVectorSetArray(l, CEED_MEM_HOST, CEED_COPY_VALUES, const_cast<double *>(nodal.data())));
  const std::vector<double> values = at_points(mesh, space.rstr, basis, CEED_EVAL_INTERP, 1, l);
  std::vector<double> points(Q), weights(Q);
  ceed_check(CeedGaussQuadrature(Q, points.data(), weights.data()));
  double worst = 0;
  for (CeedInt cell = 0; cell < mesh.num_cells; ++cell) {
    for (int i = 0; i < num_q; ++i) {
      const auto x = map(mesh.corners(cell), {points[i % Q], points[i / Q % Q], points[i / Q / Q]});
      worst = std::max(worst, std::abs(values[cell * num_q + i] - monomials(x, static_cast<int>(p))));
    }
  }
  return worst;
}

class MeshOrder : public testing::TestWithParam<int> {};

TEST_P(MeshOrder, BoxNodesLieWhereEachCellPutsThem) {
  CeedHandle ceed = make_ceed();
  const PetscInt p = GetParam();
  auto mesh = box_mesh(ceed, "3,2,4", {.order = p, .deform = bend});
  EXPECT_EQ(mesh->num_cells_global, 24);
  EXPECT_LT(largest_node_mismatch(*mesh, p), 1e-14);
}

TEST_P(MeshOrder, RotatedGmshNodesLieWhereEachCellPutsThem) {
  CeedHandle ceed = make_ceed();
  const PetscInt p = GetParam();
  auto mesh = gmsh_mesh(ceed, write_rotated_gmsh(test_file("spaces_rotated"), 3), {.order = p, .deform = bend});
  EXPECT_EQ(mesh->num_cells_global, 27);
  EXPECT_LT(largest_node_mismatch(*mesh, p), 1e-14);
}

TEST_P(MeshOrder, PolynomialsAreInterpolatedExactly) {
  CeedHandle ceed = make_ceed();
  const PetscInt p = GetParam();
  EXPECT_LT(largest_interpolation_error(*box_mesh(ceed, "2,3,2", {.order = p}), p), 2e-12);
  auto rotated = gmsh_mesh(ceed, write_rotated_gmsh(test_file("spaces_rotated"), 3), {.order = p});
  EXPECT_LT(largest_interpolation_error(*rotated, p), 2e-12);
}

TEST_P(MeshOrder, GlobalSizeCountsEachNodeOnceAndDropsConstraints) {
  CeedHandle ceed = make_ceed();
  const PetscInt p = GetParam();
  auto mesh = box_mesh(ceed, "3,2,2", {.order = p});
  VecHandle global;
  PetscInt size;
  petsc_check(DMCreateGlobalVector(mesh->dm, global.put()));
  petsc_check(VecGetSize(global, &size));
  EXPECT_EQ(size, 3 * (3 * p + 1) * (2 * p + 1) * (2 * p + 1));

  // Constrain components 0 and 2 of the plane x = 0, by coordinates so that every rank agrees.
  const auto &at = mesh->node_coordinates(p);
  std::vector<char> constrained(at.size(), 0);
  for (std::size_t node = 0; node < at.size() / 3; ++node) {
    if (at[3 * node] < 1e-10) constrained[3 * node] = constrained[3 * node + 2] = 1;
  }
  mesh->constrain(constrained);
  petsc_check(DMCreateGlobalVector(mesh->dm, global.put()));
  petsc_check(VecGetSize(global, &size));
  EXPECT_EQ(size, (3 * 3 * p + 1) * (2 * p + 1) * (2 * p + 1));
  VecHandle local;
  petsc_check(DMCreateLocalVector(mesh->dm, local.put()));
  petsc_check(VecGetSize(local, &size));
  EXPECT_EQ(size, mesh->local_size);

  // Global to local leaves constrained entries alone and fills all others.
  petsc_check(VecSet(local, 7.));
  petsc_check(VecSet(global, 1.));
  petsc_check(DMGlobalToLocal(mesh->dm, global, INSERT_VALUES, local));
  const PetscScalar *array;
  petsc_check(VecGetArrayRead(local, &array));
  for (PetscInt i = 0; i < size; ++i) ASSERT_EQ(array[i], constrained[i] ? 7. : 1.) << i;
  petsc_check(VecRestoreArrayRead(local, &array));
}

INSTANTIATE_TEST_SUITE_P(Orders, MeshOrder, testing::Values(1, 2, 3, 4, 5, 8));

TEST(Mesh, VolumesAddUp) {
  CeedHandle ceed = make_ceed();
  EXPECT_NEAR(sum_over_ranks(volume(*box_mesh(ceed, "3,4,5", {}, "2,1,3"))), 6, 1e-12);
  EXPECT_NEAR(sum_over_ranks(volume(*box_mesh(ceed, "4,4,4", {.deform = bend}))), 1, 1e-12);
  auto rotated = gmsh_mesh(ceed, write_rotated_gmsh(test_file("spaces_rotated"), 3), {.deform = bend});
  EXPECT_NEAR(sum_over_ranks(volume(*rotated)), 1, 1e-12);
}

TEST(Mesh, VectorsAndMatricesAreOfTheTypesThatOptionsName) {
  CeedHandle ceed = make_ceed();
  const ScopedOptions types{{"-dm_vec_type", "mpi"}, {"-dm_mat_type", "baij"}};
  const auto mesh = box_mesh(ceed, "2,2,2", {});
  VecType vec_type;
  MatType mat_type;
  for (DM dm : {mesh->dm.get(), mesh->space(1, 1).dm.get()}) {
    petsc_check(DMGetVecType(dm, &vec_type));
    EXPECT_STREQ(vec_type, "mpi");
  }
  petsc_check(DMGetMatType(mesh->dm, &mat_type));
  EXPECT_STREQ(mat_type, "baij");
}

TEST(Mesh, FacesAndNeighboursFollowTheTensorFrame) {
  CeedHandle ceed = make_ceed();
  auto mesh = gmsh_mesh(ceed, write_rotated_gmsh(test_file("spaces_rotated"), 3), {});
  int inner = 0;
  for (CeedInt cell = 0; cell < mesh->num_cells; ++cell) {
    for (int f = 0; f < 6; ++f) {
      const PetscInt other = mesh->neighbours[6 * cell + f];
      if (other < 0) continue;
      ++inner;
      ASSERT_LT(other, mesh->num_cells);
      // The centroid of the neighbour lies beyond this face, at reference coordinate ±2 in the face's direction.
      std::array<double, 3> X{}, centroid{};
      X[f / 2] = f % 2 ? 2 : -2;
      const auto expected = map(mesh->corners(cell), X);
      for (int i = 0; i < 24; ++i) centroid[i % 3] += mesh->corners(static_cast<CeedInt>(other))[i] / 8;
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(centroid[c], expected[c], 1e-12);
    }
  }
  int size;
  MPI_Comm_size(PETSC_COMM_WORLD, &size);
  if (size == 1) {
    EXPECT_EQ(inner, 2 * 3 * 9 * 2);
  }
}

TEST(Mesh, BoxFaceSetsHaveTheDocumentedNumbers) {
  CeedHandle ceed = make_ceed();
  const PetscInt p = 3;
  auto mesh = box_mesh(ceed, "2,3,2", {.order = p});
  const auto &at = mesh->node_coordinates(p);
  const int component[] = {2, 2, 1, 1, 0, 0};
  const double place[] = {0, 1, 0, 1, 1, 0};
  for (PetscInt face = 1; face <= 6; ++face) {
    const auto nodes = mesh->nodes_on(p, "Face Sets", face);
    for (PetscInt node : nodes) EXPECT_NEAR(at[3 * node + component[face - 1]], place[face - 1], 1e-14);
    const auto rotated_nodes = sum_over_ranks(static_cast<double>(nodes.size()));
    EXPECT_GE(rotated_nodes, face <= 2 ? 7 * 10 : face <= 4 ? 7 * 7 : 10 * 7);
  }
}

TEST(Mesh, GmshFaceSetsSurvive) {
  CeedHandle ceed = make_ceed();
  auto mesh = gmsh_mesh(ceed, write_rotated_gmsh(test_file("spaces_rotated"), 3), {.order = 2});
  const auto &at = mesh->node_coordinates(2);
  const auto high_x = mesh->nodes_on(2, "Face Sets", 5);
  for (PetscInt node : high_x) EXPECT_NEAR(at[3 * node], 1, 1e-14);
  EXPECT_GE(sum_over_ranks(static_cast<double>(high_x.size())), 49);
}

TEST(Mesh, SharedNodesAreSummedOverRanks) {
  CeedHandle ceed = make_ceed();
  auto mesh = box_mesh(ceed, "4,4,4", {.order = 2});
  const MeshSpace &space = mesh->space(2, 2);
  std::vector<double> ones(space.local_size, 1.);
  mesh->sum_shared(2, 2, ones);
  // The sum over ranks of 1/multiplicity counts each node once.
  double mine = 0;
  for (double multiplicity : ones) mine += 1 / multiplicity;
  EXPECT_NEAR(sum_over_ranks(mine), 2. * 9 * 9 * 9, 1e-9);
}

TEST(Regions, BoxesLabelsAndTheRest) {
  CeedHandle ceed = make_ceed();
  auto mesh = gmsh_mesh(ceed, write_rotated_gmsh(test_file("spaces_rotated"), 4), {});
  Region left{.name = "left", .prefix = "left_", .label_name = "Cell Sets", .label_values = {11}};
  Region corner{.name = "corner", .prefix = "corner_", .box = std::array<double, 6>{0.75, 0.75, 0.75, 1, 1, 1}};
  Region rest{.name = "rest", .prefix = "rest_"};
  RegionMap map(*mesh, std::vector{rest, left, corner});
  EXPECT_EQ(sum_over_ranks(static_cast<double>(map.cells(1).size())), 32);
  EXPECT_EQ(sum_over_ranks(static_cast<double>(map.cells(2).size())), 1);
  EXPECT_EQ(sum_over_ranks(static_cast<double>(map.cells(0).size())), 31);
  map.require_all_cells();
  const double in_box[3] = {0.9, 0.9, 0.75}, outside[3] = {0.9, 0.9, 0.74};
  if (mesh->num_cells > 0) {
    for (CeedInt cell : map.cells(0)) {
      EXPECT_EQ(map.of_point(cell, in_box), 2);
      EXPECT_EQ(map.of_point(cell, outside), 0);
    }
  }
  RegionMap gap(*mesh, std::vector{left, corner});
  EXPECT_THROW(gap.require_all_cells(), Error);
  EXPECT_THROW(RegionMap(*mesh, std::vector{rest, Region{}}), Error);
  left.label_values = {999};
  EXPECT_THROW(RegionMap(*mesh, std::vector{left}), Error);
}

TEST(Mesh, BadInputIsNamed) {
  CeedHandle ceed = make_ceed();
  const auto message_of = [&](auto &&make) -> std::string {
    try {
      make();
    } catch (const Error &error) {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(message_of([&] { gmsh_mesh(ceed, "no_such_file.msh", {}); }).find("no_such_file.msh"), std::string::npos);
  EXPECT_NE(message_of([&] { box_mesh(ceed, "2,2,2", {.order = 9}); }).find("1 to 8"), std::string::npos);
  const auto turn_inside_out = [](double *x) { x[0] = -x[0]; };
  EXPECT_NE(message_of([&] { box_mesh(ceed, "2,2,2", {.deform = turn_inside_out}); }).find("inverted"),
            std::string::npos);
  const std::string name = test_file("one_tetrahedron");
  int rank;
  MPI_Comm_rank(PETSC_COMM_WORLD, &rank);
  if (rank == 0) {
    std::FILE *file = std::fopen(name.c_str(), "w");
    std::fprintf(file,
                 "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n$EndNodes\n"
                 "$Elements\n1\n1 4 2 1 1 1 2 3 4\n$EndElements\n");
    std::fclose(file);
  }
  MPI_Barrier(PETSC_COMM_WORLD);
  EXPECT_NE(message_of([&] { gmsh_mesh(ceed, name, {}); }).find("not hexahedra"), std::string::npos);
}

}  // namespace
}  // namespace hg::test
