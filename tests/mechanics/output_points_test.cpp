// Points in HDF5 and XDMF: read back, and the XDMF says what the HDF5 holds.
#include <gtest/gtest.h>

#include "output/points_writer.hpp"
#include "output_files.hpp"
#include "xml.hpp"

namespace hg::test {
namespace {

PointMaterial two_regions(std::int32_t, const double *x) {
  return {.region = x[0] < 0.5 ? 3 : 7, .rho0 = 1, .K = 1, .mu = 1};
}

class OutputPoints : public testing::Test {
 protected:
  OutputPoints() : points(box_mesh(ceed, "3,4,2", {}), {.points_per_cell = 8}, two_regions) { deform(); }

  /// A known state for each point, by its place when seeded.
  void deform() {
    const Swarm &s = points.swarm;
    const PointField<double> X0(s, field::X0), x(s, field::x), u(s, field::u), v(s, field::v), F(s, field::F),
        V(s, field::V);
    for (PetscInt p = 0; p < s.local_size(); p++) {
      const double a = X0[3 * p], b = X0[3 * p + 1], c = X0[3 * p + 2];
      const double move[3] = {0.1 * b, 0.2 * a * c, -0.1 * c};
      for (int d = 0; d < 3; d++) {
        u[3 * p + d] = move[d];
        x[3 * p + d] = X0[3 * p + d] + move[d];
        v[3 * p + d] = 10 * move[d];
      }
      const double grad[9] = {1, 0.1, 0, 0.2 * c, 1, 0.2 * a, 0, 0, 0.9};
      std::copy_n(grad, 9, &F[9 * p]);
      V[p] *= 0.9 * (1 - 0.02 * c);
    }
  }

  CeedHandle ceed = make_ceed();
  Folder folder;
  PointsOnMesh points;
};

/// Every DataItem of a grid names a dataset of the size and type it says.
void check_items(const Xml &element, const std::string &folder, int &count) {
  for (const Xml &c : element.children) check_items(c, folder, count);
  if (element.name != "DataItem") return;
  count++;
  EXPECT_EQ(element.at("Format"), "HDF");
  const std::size_t colon = element.text.find(":/");
  ASSERT_NE(colon, std::string::npos) << element.text;
  const std::string file = folder + "/" + element.text.substr(0, colon), name = element.text.substr(colon + 2);
  std::vector<hsize_t> dims;
  if (element.at("NumberType") == "Float") {
    h5_dataset<double>(file, name, dims);
  } else {
    h5_dataset<std::int64_t>(file, name, dims);
  }
  std::string expected;
  for (const hsize_t d : dims) expected += (expected.empty() ? "" : " ") + std::to_string(d);
  EXPECT_EQ(element.at("Dimensions"), expected) << name;
  const hid_t f = H5Fopen(file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), d = H5Dopen2(f, name.c_str(), H5P_DEFAULT);
  const hid_t type = H5Dget_type(d);
  EXPECT_EQ(std::to_string(H5Tget_size(type)), element.at("Precision")) << name;
  EXPECT_EQ(H5Tget_class(type) == H5T_FLOAT, element.at("NumberType") == "Float") << name;
  H5Tclose(type);
  H5Dclose(d);
  H5Fclose(f);
}

TEST_F(OutputPoints, fields_read_back_are_those_of_the_points) {
  std::vector<double> stress(6 * points.swarm.local_size()), energy(points.swarm.local_size());
  {
    const PointField<std::int64_t> id(points.swarm, field::id);
    for (std::size_t p = 0; p < id.size(); p++) {
      for (int i = 0; i < 6; i++) stress[6 * p + i] = 100.0 * id[p] + i;
      energy[p] = 0.5 * id[p];
    }
  }
  const ExtraPointField extra[] = {{"stress", 6, stress}, {"energy", 1, energy}};
  PointsWriter writer(PETSC_COMM_WORLD, folder / "points");
  writer.write(12, 0.75, points.swarm, extra);
  if (my_rank() != 0) return;

  const std::string file = folder / "points-000012.h5";
  std::vector<hsize_t> dims;
  const auto id = h5_dataset<std::int64_t>(file, "id", dims);
  ASSERT_EQ(id.size(), 192u);
  std::map<std::int64_t, std::size_t> row;
  for (std::size_t r = 0; r < id.size(); r++) ASSERT_TRUE(row.emplace(id[r], r).second);
  const auto x = h5_dataset<double>(file, "x", dims);
  EXPECT_EQ(dims, (std::vector<hsize_t>{192, 3}));
  const auto u = h5_dataset<double>(file, "displacement", dims), v = h5_dataset<double>(file, "velocity", dims);
  const auto V = h5_dataset<double>(file, "volume", dims), J = h5_dataset<double>(file, "J", dims);
  const auto region = h5_dataset<std::int32_t>(file, "region", dims);
  const auto sigma = h5_dataset<double>(file, "stress", dims);
  EXPECT_EQ(dims, (std::vector<hsize_t>{192, 9}));
  const auto e = h5_dataset<double>(file, "energy", dims);
  // Uniform points of a 3 × 4 × 2 box, 8 in each cell: id gives cell and place.
  for (std::int64_t i = 0; i < 192; i++) {
    ASSERT_TRUE(row.count(i));
    const std::size_t r = row[i];
    const std::int64_t cell = i / 8, k = i % 8;
    const double X[3] = {(cell % 3 + 0.25 + 0.5 * (k & 1)) / 3, (cell / 3 % 4 + 0.25 + 0.5 * (k >> 1 & 1)) / 4,
                         (cell / 12 + 0.25 + 0.5 * (k >> 2)) / 2};
    const double move[3] = {0.1 * X[1], 0.2 * X[0] * X[2], -0.1 * X[2]};
    for (int d = 0; d < 3; d++) {
      EXPECT_NEAR(u[3 * r + d], move[d], 1e-15);
      EXPECT_NEAR(x[3 * r + d], X[d] + move[d], 1e-15);
      EXPECT_NEAR(v[3 * r + d], 10 * move[d], 1e-14);
    }
    EXPECT_NEAR(J[r], 0.9 * (1 - 0.02 * X[2]), 1e-15);
    EXPECT_NEAR(V[r], J[r] / 192, 1e-15);
    EXPECT_EQ(region[r], X[0] < 0.5 ? 3 : 7);
    EXPECT_EQ(e[r], 0.5 * static_cast<double>(i));
    const int voigt[9] = {0, 5, 4, 5, 1, 3, 4, 3, 2};
    for (int t = 0; t < 9; t++) EXPECT_EQ(sigma[9 * r + t], 100.0 * static_cast<double>(i) + voigt[t]);
  }
}

TEST_F(OutputPoints, xdmf_lists_every_output_and_describes_the_hdf5) {
  PointsWriter writer(PETSC_COMM_WORLD, folder / "points");
  for (const int step : {0, 5, 10}) {
    writer.write(step, 0.1 * step, points.swarm);
    MPI_Barrier(PETSC_COMM_WORLD);
    const Xml root = XmlReader::file(folder / "points.xdmf");  // whole and readable after every write
    const auto grids = root.one("Domain").one("Grid").all("Grid");
    EXPECT_EQ(grids.size(), step / 5 + 1u);
    MPI_Barrier(PETSC_COMM_WORLD);
  }
  if (my_rank() != 0) return;
  const Xml root = XmlReader::file(folder / "points.xdmf");
  EXPECT_EQ(root.name, "Xdmf");
  const Xml &series = root.one("Domain").one("Grid");
  EXPECT_EQ(series.at("CollectionType"), "Temporal");
  for (int i = 0; i < 3; i++) {
    const Xml &grid = *series.all("Grid")[i];
    EXPECT_EQ(std::stod(grid.one("Time").at("Value")), 0.1 * 5 * i);
    EXPECT_EQ(grid.one("Topology").at("TopologyType"), "Polyvertex");
    EXPECT_EQ(grid.one("Topology").at("NumberOfElements"), "192");
    std::vector<hsize_t> dims;
    const std::string &cells = grid.one("Topology").one("DataItem").text;
    const auto vertex = h5_dataset<std::int64_t>(folder / cells.substr(0, cells.find(':')), "vertex", dims);
    for (std::size_t p = 0; p < vertex.size(); p++) EXPECT_EQ(vertex[p], static_cast<std::int64_t>(p));
    EXPECT_EQ(grid.one("Geometry").at("GeometryType"), "XYZ");
    for (const char *name : {"displacement", "velocity", "volume", "J", "region", "id"}) {
      EXPECT_EQ(grid.named("Attribute", name).at("Center"), "Node");
    }
    EXPECT_EQ(grid.named("Attribute", "displacement").at("AttributeType"), "Vector");
    int items = 0;
    check_items(grid, folder / "", items);
    EXPECT_EQ(items, 8);
  }
  const std::vector<std::string> files = folder.files();
  EXPECT_EQ(files,
            (std::vector<std::string>{"points-000000.h5", "points-000005.h5", "points-000010.h5", "points.xdmf"}));
}

TEST_F(OutputPoints, a_restarted_series_goes_on_where_the_checkpoint_was) {
  {
    PointsWriter writer(PETSC_COMM_WORLD, folder / "points");
    for (const int step : {0, 2, 4, 6}) writer.write(step, step, points.swarm);
  }
  PointsWriter writer(PETSC_COMM_WORLD, folder / "points");
  writer.resume(3);
  writer.write(5, 5.0, points.swarm);
  if (my_rank() != 0) return;
  std::vector<double> times;
  const Xml root = XmlReader::file(folder / "points.xdmf");
  for (const Xml *g : root.one("Domain").one("Grid").all("Grid")) {
    times.push_back(std::stod(g->one("Time").at("Value")));
  }
  EXPECT_EQ(times, (std::vector<double>{0, 2, 5}));
}

TEST_F(OutputPoints, a_foreign_file_is_not_overwritten_by_resume) {
  if (my_rank() == 0) std::ofstream(folder / "points.xdmf") << "my notes\n";
  MPI_Barrier(PETSC_COMM_WORLD);
  PointsWriter writer(PETSC_COMM_WORLD, folder / "points");
  EXPECT_THROW(writer.resume(3), Error);
}

TEST_F(OutputPoints, ranks_without_points_and_no_points_at_all) {
  PointsWriter writer(PETSC_COMM_WORLD, folder / "corner");
  const PointsOnMesh corner(box_mesh(ceed, "3,4,2", {}), {.points_per_cell = 8}, [](std::int32_t, const double *x) {
    return PointMaterial{.region = x[0] + x[1] + x[2] < 0.6 ? 0 : -1, .rho0 = 1, .K = 1, .mu = 1};
  });
  writer.write(1, 1.0, corner.swarm);
  const PetscInt n = corner.swarm.global_size();
  EXPECT_GT(n, 0);
  const Swarm empty(PETSC_COMM_WORLD);
  writer.write(2, 2.0, empty);
  if (my_rank() != 0) return;
  std::vector<hsize_t> dims;
  EXPECT_EQ(h5_dataset<std::int64_t>(folder / "corner-000001.h5", "id", dims).size(), static_cast<std::size_t>(n));
  EXPECT_EQ(h5_dataset<double>(folder / "corner-000002.h5", "x", dims).size(), 0u);
}

TEST_F(OutputPoints, failures_name_the_file_on_every_rank) {
  PointsWriter writer(PETSC_COMM_WORLD, folder / "nowhere/points");
  try {
    writer.write(1, 1.0, points.swarm);
    FAIL() << "written into a folder that does not exist";
  } catch (const Error &e) {
    EXPECT_NE(std::string(e.what()).find("nowhere/points-000001.h5"), std::string::npos) << e.what();
  }
  PointsWriter other(PETSC_COMM_WORLD, folder / "points");
  const std::vector<double> five(5);
  const ExtraPointField wrong[] = {{"wrong", 1, five}};
  try {
    other.write(1, 1.0, points.swarm, wrong);
    FAIL() << "a field of the wrong length was accepted";
  } catch (const Error &e) {
    EXPECT_NE(std::string(e.what()).find("field 'wrong' has 5 values"), std::string::npos) << e.what();
  }
}

}  // namespace
}  // namespace hg::test
