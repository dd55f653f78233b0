// The mesh in VTU files: decoded, the pieces make up the cube and carry the fields.
#include <gtest/gtest.h>

#include "output/mesh_writer.hpp"
#include "output_files.hpp"
#include "vtu.hpp"

namespace hg::test {
namespace {

double hex_volume(const std::array<std::array<double, 3>, 8> &c) {  // VTK order, 2-point Gauss
  const double s[8][3] = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1},
                          {-1, -1, 1},  {1, -1, 1},  {1, 1, 1},  {-1, 1, 1}};
  double volume = 0;
  for (const auto &q : s) {
    double J[3][3] = {};
    for (int a = 0; a < 8; a++) {
      for (int k = 0; k < 3; k++) {
        double dN = s[a][k] / 8;
        for (int m = 0; m < 3; m++) {
          if (m != k) dN *= 1 + s[a][m] * q[m] / std::sqrt(3.0);
        }
        for (int d = 0; d < 3; d++) J[d][k] += c[a][d] * dN;
      }
    }
    const double det = J[0][0] * (J[1][1] * J[2][2] - J[1][2] * J[2][1]) -
                       J[0][1] * (J[1][0] * J[2][2] - J[1][2] * J[2][0]) +
                       J[0][2] * (J[1][0] * J[2][1] - J[1][1] * J[2][0]);
    if (det <= 0) return -1;
    volume += det;
  }
  return volume;
}

class OutputMesh : public testing::TestWithParam<int> {
 protected:
  CeedHandle ceed = make_ceed();
  Folder folder;

  void write(MeshWriter &writer, const Mesh &mesh, int step, double time) {
    const std::vector<double> &x = mesh.node_coordinates(mesh.order);
    std::vector<double> u(x.size()), region(mesh.num_cells);
    for (std::size_t i = 0; i < x.size(); i += 3) {
      u[i] = x[i] * x[i + 1] + time;
      u[i + 1] = std::sin(x[i + 2]);
      u[i + 2] = x[i] - x[i + 1];
    }
    for (CeedInt c = 0; c < mesh.num_cells; c++) region[c] = static_cast<double>(mesh.cell_ids[c]);
    const MeshView view{mesh.order, static_cast<PetscInt>(x.size() / 3), mesh.node_offsets(), mesh.corner_coords};
    const NodeField nodes[] = {{"displacement", 3, u}};
    const CellField cells[] = {{"region", region}};
    writer.write(step, time, view, nodes, cells);
  }
};
INSTANTIATE_TEST_SUITE_P(Orders, OutputMesh, testing::Values(1, 2, 4), testing::PrintToStringParamName());

TEST_P(OutputMesh, pieces_make_up_the_mesh_and_carry_its_fields) {
  const int p = GetParam();
  MeshOptions options;
  options.order = p;
  options.deform = bend;
  const auto mesh = box_mesh(ceed, "3,2,4", options);
  MeshWriter writer(PETSC_COMM_WORLD, folder / "mesh");
  write(writer, *mesh, 7, 0.25);
  MPI_Barrier(PETSC_COMM_WORLD);
  char own[32] = "mesh-000007.vtu";
  if (ranks() > 1) std::snprintf(own, sizeof own, "mesh-000007-%04d.vtu", my_rank());

  const Xml root = XmlReader::file(folder / own);
  EXPECT_EQ(root.at("type"), "UnstructuredGrid");
  EXPECT_EQ(root.at("header_type"), "UInt64");
  const Xml &piece = root.one("UnstructuredGrid").one("Piece");
  const auto x = values<double>(piece.one("Points").one("DataArray"));
  const auto connectivity = values<std::int64_t>(piece.one("Cells").named("DataArray", "connectivity"));
  const auto offsets = values<std::int64_t>(piece.one("Cells").named("DataArray", "offsets"));
  const auto types = values<std::uint8_t>(piece.one("Cells").named("DataArray", "types"));
  const auto u = values<double>(piece.one("PointData").named("DataArray", "displacement"));
  const auto region = values<double>(piece.one("CellData").named("DataArray", "region"));
  const std::size_t sub = static_cast<std::size_t>(p) * p * p, cells = mesh->num_cells * sub;
  EXPECT_EQ(piece.at("NumberOfCells"), std::to_string(cells));
  EXPECT_EQ(piece.at("NumberOfPoints"), std::to_string(x.size() / 3));
  EXPECT_EQ(connectivity.size(), 8 * cells);
  EXPECT_EQ(offsets.size(), cells);
  EXPECT_EQ(types, std::vector<std::uint8_t>(cells, 12));
  ASSERT_EQ(u.size(), x.size());
  ASSERT_EQ(region.size(), cells);

  // Node places are the mesh's, and the values stand with their nodes.
  const std::vector<double> &expected = mesh->node_coordinates(p);
  ASSERT_EQ(x.size(), expected.size());
  for (std::size_t i = 0; i < x.size(); i += 3) {
    for (int d = 0; d < 3; d++) ASSERT_NEAR(x[i + d], expected[i + d], 1e-14);
    ASSERT_NEAR(u[i], x[i] * x[i + 1] + 0.25, 1e-13);
    ASSERT_NEAR(u[i + 1], std::sin(x[i + 2]), 1e-13);
    ASSERT_NEAR(u[i + 2], x[i] - x[i + 1], 1e-13);
  }
  // Sub-cells are right-handed. Their faces are bilinear in the nodes of a trilinear map, so they fill the mesh
  // exactly.
  double volume = 0, total = 0;
  for (std::size_t c = 0; c < cells; c++) {
    EXPECT_EQ(offsets[c], static_cast<std::int64_t>(8 * (c + 1)));
    std::array<std::array<double, 3>, 8> corners;
    for (int a = 0; a < 8; a++) {
      const std::int64_t n = connectivity[8 * c + a];
      ASSERT_GE(n, 0);
      ASSERT_LT(n, static_cast<std::int64_t>(x.size() / 3));
      for (int d = 0; d < 3; d++) corners[a][d] = x[3 * n + d];
    }
    const double v = hex_volume(corners);
    ASSERT_GT(v, 0) << "sub-cell " << c << " is inverted";
    volume += v;
    EXPECT_EQ(region[c], static_cast<double>(mesh->cell_ids[c / sub]));
  }
  MPI_Allreduce(&volume, &total, 1, MPI_DOUBLE, MPI_SUM, PETSC_COMM_WORLD);
  EXPECT_NEAR(total, 1.0, 1e-12);
}

TEST_P(OutputMesh, series_lists_every_time_and_its_files_exist) {
  MeshOptions options;
  options.order = GetParam();
  const auto mesh = box_mesh(ceed, "2,2,2", options);
  {
    MeshWriter writer(PETSC_COMM_WORLD, folder / "mesh");
    for (const int step : {0, 3, 6}) write(writer, *mesh, step, 0.5 * step);
  }
  MeshWriter writer(PETSC_COMM_WORLD, folder / "mesh");
  writer.resume(4);
  write(writer, *mesh, 5, 2.5);
  if (my_rank() != 0) return;
  const Xml root = XmlReader::file(folder / "mesh.pvd");
  EXPECT_EQ(root.at("type"), "Collection");
  std::vector<double> times;
  for (const Xml *set : root.one("Collection").all("DataSet")) {
    times.push_back(std::stod(set->at("timestep")));
    const Xml file = XmlReader::file(folder / set->at("file"));
    if (ranks() == 1) {
      EXPECT_EQ(file.at("type"), "UnstructuredGrid");
      continue;
    }
    EXPECT_EQ(file.at("type"), "PUnstructuredGrid");
    const Xml &grid = file.one("PUnstructuredGrid");
    EXPECT_EQ(grid.all("Piece").size(), static_cast<std::size_t>(ranks()));
    for (const Xml *piece : grid.all("Piece")) {
      // Each array that the list promises is in the piece.
      const Xml part = XmlReader::file(folder / piece->at("Source"));
      const Xml &inside = part.one("UnstructuredGrid").one("Piece");
      for (const Xml *a : grid.one("PPointData").all("PDataArray")) {
        EXPECT_EQ(inside.one("PointData").named("DataArray", a->at("Name")).at("type"), a->at("type"));
      }
      for (const Xml *a : grid.one("PCellData").all("PDataArray")) {
        EXPECT_EQ(inside.one("CellData").named("DataArray", a->at("Name")).at("type"), a->at("type"));
      }
    }
  }
  EXPECT_EQ(times, (std::vector<double>{0, 1.5, 2.5}));
}

TEST_P(OutputMesh, wrong_lengths_are_refused_on_every_rank) {
  MeshOptions options;
  options.order = GetParam();
  const auto mesh = box_mesh(ceed, "2,2,2", options);
  const auto n = static_cast<PetscInt>(mesh->node_coordinates(mesh->order).size() / 3);
  const MeshView view{mesh->order, n, mesh->node_offsets(), mesh->corner_coords};
  MeshWriter writer(PETSC_COMM_WORLD, folder / "mesh");
  const std::vector<double> short_values(my_rank() == 0 ? 1 : 3 * n);
  const NodeField nodes[] = {{"displacement", 3, short_values}};
  try {
    writer.write(0, 0, view, nodes);
    FAIL() << "a field of the wrong length was accepted";
  } catch (const Error &e) {
    EXPECT_NE(std::string(e.what()).find("field 'displacement' has 1 values"), std::string::npos) << e.what();
  }
  EXPECT_TRUE(folder.files().empty());
}

}  // namespace
}  // namespace hg::test
