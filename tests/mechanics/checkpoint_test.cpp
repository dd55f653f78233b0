// Checkpoints: what is read is what was written, a run goes on bitwise, and no failure costs the checkpoint before.
#include "output/checkpoint.hpp"

#include <gtest/gtest.h>
#include <sys/mount.h>
#include <sys/resource.h>

#include <chrono>
#include <fstream>
#include <sstream>
#include <thread>

#include "output/h5.hpp"
#include "output_files.hpp"

namespace hg::test {
namespace {

class Checkpoints : public testing::Test {
 protected:
  CeedHandle ceed = make_ceed();
  Folder folder;

  PointsOnMesh make(const char *faces = "4,3,5", MeshOptions options = {}) {
    return PointsOnMesh(box_mesh(ceed, faces, options), {.points_per_cell = 8});
  }
  static VecHandle vector(const PointsOnMesh &points, PetscInt extra = 0) {
    VecHandle v;
    petsc_check(VecCreateMPI(PETSC_COMM_WORLD, 3 * points.mesh->num_cells + extra, PETSC_DETERMINE, v.put()));
    return v;
  }
  static void fill(Vec v, double factor) {
    PetscInt first, last;
    petsc_check(VecGetOwnershipRange(v, &first, &last));
    for (PetscInt i = first; i < last; i++)
      petsc_check(VecSetValue(v, i, factor / (3.0 + static_cast<double>(i)), INSERT_VALUES));
    petsc_check(VecAssemblyBegin(v));
    petsc_check(VecAssemblyEnd(v));
  }
  static std::vector<double> host(Vec v) {
    PetscInt n;
    const PetscScalar *a;
    petsc_check(VecGetLocalSize(v, &n));
    petsc_check(VecGetArrayRead(v, &a));
    std::vector<double> copy(a, a + n);
    petsc_check(VecRestoreArrayRead(v, &a));
    return copy;
  }
  static void move(PointsOnMesh &points) {
    points.displace([](const double *x, double *d) {
      const double bump = 16 * x[0] * (1 - x[0]) * x[1] * (1 - x[1]) * x[2] * (1 - x[2]);
      d[0] = bump * (0.5 - x[1]);
      d[1] = bump * (x[0] - 0.5);
      d[2] = 0.1 * bump;
    });
    {
      const PointField<double> F(points.swarm, field::F), V(points.swarm, field::V), x(points.swarm, field::x);
      for (std::size_t p = 0; p < V.size(); p++) {
        V[p] *= 1 + 0.01 * x[3 * p];
        for (int i = 0; i < 9; i++) F[9 * p + i] += 0.001 * x[3 * p + i % 3];
      }
    }
    points.locate();
  }
  /// Every field of every point as bytes, storage order.
  static std::vector<std::vector<unsigned char>> bytes(const Swarm &swarm) {
    std::vector<std::vector<unsigned char>> all;
    for (const PointFieldSpec &f : point_fields()) {
      void *data;
      petsc_check(DMSwarmGetField(swarm.dm(), f.name, nullptr, nullptr, &data));
      const auto *b = static_cast<const unsigned char *>(data);
      all.emplace_back(b, b + f.bytes * f.components * swarm.local_size());
      petsc_check(DMSwarmRestoreField(swarm.dm(), f.name, nullptr, nullptr, &data));
    }
    return all;
  }
  /// The message of a read that must fail, the same on every rank.
  static std::string read_error(const std::string &path, const CellGrid &grid, Checkpoint &state) {
    std::string text;
    try {
      read_checkpoint(PETSC_COMM_WORLD, path, grid, state);
    } catch (const Error &e) {
      text = e.what();
    }
    EXPECT_FALSE(text.empty()) << "a bad checkpoint was read";
    int length = static_cast<int>(text.size());
    MPI_Bcast(&length, 1, MPI_INT, 0, PETSC_COMM_WORLD);
    std::string first = text;
    first.resize(length);
    MPI_Bcast(first.data(), length, MPI_CHAR, 0, PETSC_COMM_WORLD);
    EXPECT_EQ(text, first);
    return text;
  }
  /// Runs body(file) on the HDF5 file, on rank 0.
  template <class Body>
  static void tamper(const std::string &path, Body &&body) {
    MPI_Barrier(PETSC_COMM_WORLD);
    if (my_rank() == 0) {
      const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
      if (file < 0) fail("cannot open %s", path.c_str());
      body(file);
      H5Fclose(file);
    }
    MPI_Barrier(PETSC_COMM_WORLD);
  }
  static void set_attribute(hid_t file, const char *name, std::int64_t value) {
    const hid_t a = H5Aopen(file, name, H5P_DEFAULT);
    if (H5Awrite(a, H5T_NATIVE_INT64, &value) < 0) fail("cannot change %s", name);
    H5Aclose(a);
  }
};

TEST_F(Checkpoints, everything_is_read_back_bitwise) {
  PointsOnMesh points = make();
  move(points);
  VecHandle u = vector(points), w = vector(points, 2);
  fill(u, 1.0);
  fill(w, -0.1);
  Checkpoint out{.step = 17, .time = 0.1 + 0.2, .dt = 1.0 / 3};
  out.scalars = {{"last error", 1e-300}, {"negative zero", -0.0}, {"pi", M_PI}};
  out.texts = {{"method", "mpm"}, {"empty", ""}, {"with space", "a b\nc"}};
  out.vectors = {{"u", u}, {"w", w}};
  out.swarm = &points.swarm;
  write_checkpoint(PETSC_COMM_WORLD, folder / "state.h5", points.grid, out);
  EXPECT_EQ(folder.files(), std::vector<std::string>{"state.h5"});

  VecHandle u2 = vector(points), w2 = vector(points, 2);
  Swarm swarm(PETSC_COMM_WORLD);
  Checkpoint in;
  in.vectors = {{"u", u2}, {"w", w2}};
  in.swarm = &swarm;
  read_checkpoint(PETSC_COMM_WORLD, folder / "state.h5", points.grid, in);
  EXPECT_EQ(in.step, out.step);
  EXPECT_EQ(in.time, out.time);
  EXPECT_EQ(in.dt, out.dt);
  EXPECT_EQ(in.scalars, out.scalars);
  EXPECT_TRUE(std::signbit(in.scalars["negative zero"]));
  EXPECT_EQ(in.texts, out.texts);
  EXPECT_EQ(host(u2), host(u));
  EXPECT_EQ(host(w2), host(w));
  EXPECT_EQ(bytes(swarm), bytes(points.swarm));
}

TEST_F(Checkpoints, a_run_that_stops_and_goes_on_equals_one_that_does_not_bitwise) {
  PointsOnMesh whole = make();
  for (int step = 0; step < 6; step++) move(whole);
  {
    PointsOnMesh first = make();
    for (int step = 0; step < 3; step++) move(first);
    Checkpoint out{.step = 3};
    out.swarm = &first.swarm;
    write_checkpoint(PETSC_COMM_WORLD, folder / "state.h5", first.grid, out);
  }
  PointsOnMesh second = make();
  Checkpoint in;
  in.swarm = &second.swarm;
  read_checkpoint(PETSC_COMM_WORLD, folder / "state.h5", second.grid, in);
  ASSERT_EQ(in.step, 3);
  for (int step = 3; step < 6; step++) move(second);
  EXPECT_EQ(bytes(second.swarm), bytes(whole.swarm));
}

TEST_F(Checkpoints, the_same_state_gives_the_same_file) {
  PointsOnMesh points = make();
  Checkpoint state{.step = 4};
  state.swarm = &points.swarm;
  const auto text = [&](const char *name) {
    write_checkpoint(PETSC_COMM_WORLD, folder / name, points.grid, state);
    std::ifstream in(folder / name, std::ios::binary);
    std::stringstream all;
    all << in.rdbuf();
    return all.str();
  };
  const std::string first = text("a.h5");
  std::this_thread::sleep_for(std::chrono::milliseconds(1100));  // HDF5 would note the second of each dataset
  const std::string second = text("b.h5");
  EXPECT_GT(first.size(), 100000u);
  EXPECT_TRUE(first == second) << "the files differ";
}

TEST_F(Checkpoints, the_new_one_replaces_the_old) {
  const PointsOnMesh points = make();
  Checkpoint state{.step = 1};
  write_checkpoint(PETSC_COMM_WORLD, folder / "state.h5", points.grid, state);
  state.step = 2;
  write_checkpoint(PETSC_COMM_WORLD, folder / "state.h5", points.grid, state);
  Checkpoint in;
  read_checkpoint(PETSC_COMM_WORLD, folder / "state.h5", points.grid, in);
  EXPECT_EQ(in.step, 2);
}

TEST_F(Checkpoints, a_full_disk_leaves_the_old_one_and_says_so) {
  PointsOnMesh points = make("8,8,8");
  Checkpoint state{.step = 1};
  state.swarm = &points.swarm;
  const std::string path = folder / "state.h5";
  write_checkpoint(PETSC_COMM_WORLD, path, points.grid, state);
  const auto size = std::filesystem::file_size(path);
  const auto before = bytes(points.swarm);
  move(points);
  state.step = 2;
  // No file may grow beyond a share of what is needed: every write past it fails as on a full disk.
  for (const double share : {0.9, 0.3, 0.001}) {
    MPI_Barrier(PETSC_COMM_WORLD);
    rlimit old;
    ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &old), 0);
    rlimit small = old;
    small.rlim_cur = static_cast<rlim_t>(share * static_cast<double>(size));
    ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
    std::string text;
    try {
      write_checkpoint(PETSC_COMM_WORLD, path, points.grid, state);
    } catch (const Error &e) {
      text = e.what();
    }
    ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &old), 0);
    EXPECT_NE(text.find("checkpoint " + path + " was not written: "), std::string::npos) << text;
    EXPECT_NE(text.find("the one before is still there"), std::string::npos) << text;
    MPI_Barrier(PETSC_COMM_WORLD);
    EXPECT_EQ(folder.files(), std::vector<std::string>{"state.h5"}) << "the temporary file is left";
    Swarm swarm(PETSC_COMM_WORLD);
    Checkpoint in;
    in.swarm = &swarm;
    read_checkpoint(PETSC_COMM_WORLD, path, points.grid, in);
    EXPECT_EQ(in.step, 1);
    EXPECT_EQ(bytes(swarm), before);
  }
}

// The same one level down, without asking for room first: HDF5 meets the full disk in the middle of its work, on some
// ranks only. Wants a disk that is small and may be filled.
TEST_F(Checkpoints, a_disk_that_fills_while_writing_is_an_error_on_every_rank) {
  const std::string disk = folder / "disk";
  int mounted = 0;
  if (my_rank() == 0) {
    std::filesystem::create_directory(disk);
    mounted = mount("tmpfs", disk.c_str(), "tmpfs", 0, "size=64k") == 0;
  }
  MPI_Bcast(&mounted, 1, MPI_INT, 0, PETSC_COMM_WORLD);
  if (!mounted) GTEST_SKIP() << "no right to mount a small disk here";
  const std::vector<double> rows(4000);  // 32,000 bytes on each rank
  std::string text;
  try {
    H5File file(PETSC_COMM_WORLD, disk + "/big.h5", H5File::Mode::kCreate);
    for (const char *name : {"a", "b", "c"}) {
      file.write(name, H5T_NATIVE_DOUBLE, rows.data(), H5Rows::of(PETSC_COMM_WORLD, rows.size()), 0);
    }
    file.finish("write");
  } catch (const Error &e) {
    text = e.what();
  }
  EXPECT_NE(text.find("cannot write " + disk + "/big.h5: writing "), std::string::npos) << text;
  EXPECT_NE(text.find(" bytes are free on that disk"), std::string::npos) << text;
  // And a checkpoint there, which asks first.
  PointsOnMesh points = make("8,8,8");
  Checkpoint state;
  state.swarm = &points.swarm;
  try {
    write_checkpoint(PETSC_COMM_WORLD, disk + "/state.h5", points.grid, state);
    ADD_FAILURE() << "a checkpoint went where there is no room";
  } catch (const Error &e) {
    EXPECT_NE(std::string(e.what()).find("No space left on device: "), std::string::npos) << e.what();
  }
  MPI_Barrier(PETSC_COMM_WORLD);
  if (my_rank() == 0) {
    EXPECT_FALSE(std::filesystem::exists(disk + "/state.h5.tmp"));
    EXPECT_EQ(umount(disk.c_str()), 0);
  }
}

TEST_F(Checkpoints, no_folder_to_write_to) {
  const PointsOnMesh points = make();
  try {
    write_checkpoint(PETSC_COMM_WORLD, folder / "nowhere/state.h5", points.grid, {});
    FAIL() << "written into a folder that does not exist";
  } catch (const Error &e) {
    EXPECT_NE(std::string(e.what()).find("nowhere/state.h5 was not written: "), std::string::npos) << e.what();
    EXPECT_EQ(std::string(e.what()).find("the one before"), std::string::npos) << e.what();
  }
}

TEST_F(Checkpoints, files_that_are_none) {
  const PointsOnMesh points = make();
  Checkpoint in;
  EXPECT_NE(read_error(folder / "missing.h5", points.grid, in).find("there is no such file"), std::string::npos);
  if (my_rank() == 0) std::ofstream(folder / "text.h5") << "not HDF5\n";
  MPI_Barrier(PETSC_COMM_WORLD);
  EXPECT_NE(read_error(folder / "text.h5", points.grid, in).find("it is not an HDF5 file"), std::string::npos);
  if (my_rank() == 0) H5Fclose(H5Fcreate((folder / "other.h5").c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT));
  MPI_Barrier(PETSC_COMM_WORLD);
  EXPECT_NE(read_error(folder / "other.h5", points.grid, in).find("not a checkpoint of this program"),
            std::string::npos);
}

TEST_F(Checkpoints, of_another_version_number_of_ranks_mesh_or_partition) {
  const PointsOnMesh points = make();
  const std::string path = folder / "state.h5";
  Checkpoint in;
  write_checkpoint(PETSC_COMM_WORLD, path, points.grid, {});
  tamper(path, [](hid_t f) { set_attribute(f, "version", 2); });
  EXPECT_NE(read_error(path, points.grid, in).find("it has version 2, expected 1"), std::string::npos);
  tamper(path, [](hid_t f) {
    set_attribute(f, "version", 1);
    set_attribute(f, "ranks", 77);
  });
  const std::string expected =
      "it was written by 77 ranks and can be read by as many only, not by " + std::to_string(ranks());
  EXPECT_NE(read_error(path, points.grid, in).find(expected), std::string::npos);
  tamper(path, [](hid_t f) { set_attribute(f, "ranks", ranks()); });

  const PointsOnMesh finer = make("4,3,6");
  EXPECT_NE(read_error(path, finer.grid, in).find("its mesh has 60 cells, that of this run 72"), std::string::npos);
  const PointsOnMesh bent = make("4,3,5", {.deform = bend});
  EXPECT_NE(read_error(path, bent.grid, in).find("its mesh has as many cells as that of this run, but other ones"),
            std::string::npos);
  CellGrid turned = points.grid;  // the same cells in another order
  const std::size_t n = turned.cell_ids.size();
  std::swap_ranges(turned.corners.begin(), turned.corners.begin() + 24, turned.corners.end() - 24);
  std::swap(turned.cell_ids[0], turned.cell_ids[n - 1]);
  EXPECT_NE(read_error(path, turned, in).find("spread over the ranks in another way"), std::string::npos);
  read_checkpoint(PETSC_COMM_WORLD, path, points.grid, in);  // and the file itself is good
}

TEST_F(Checkpoints, of_another_kind_of_run) {
  PointsOnMesh points = make();
  VecHandle u = vector(points), longer = vector(points, 1);
  fill(u, 1);
  Checkpoint fem, mpm;
  fem.vectors = {{"u", u}};
  mpm.swarm = &points.swarm;
  write_checkpoint(PETSC_COMM_WORLD, folder / "fem.h5", points.grid, fem);
  write_checkpoint(PETSC_COMM_WORLD, folder / "mpm.h5", points.grid, mpm);
  Checkpoint in;
  in.vectors = {{"u", longer}};
  EXPECT_NE(read_error(folder / "fem.h5", points.grid, in).find("vector 'u' has "), std::string::npos);
  in.vectors = {{"p", u}};
  EXPECT_NE(read_error(folder / "fem.h5", points.grid, in).find("no vector 'p'"), std::string::npos);
  in.vectors.clear();
  EXPECT_NE(read_error(folder / "mpm.h5", points.grid, in).find("it has points, which"), std::string::npos);
  Swarm swarm(PETSC_COMM_WORLD);
  in.swarm = &swarm;
  EXPECT_NE(read_error(folder / "fem.h5", points.grid, in).find("has no points"), std::string::npos);
}

TEST_F(Checkpoints, that_are_damaged) {
  PointsOnMesh points = make();
  VecHandle u = vector(points);
  fill(u, 1);
  Checkpoint state;
  state.vectors = {{"u", u}};
  state.swarm = &points.swarm;
  const auto flip = [](hid_t file, const char *name) {
    const hid_t d = H5Dopen2(file, name, H5P_DEFAULT), s = H5Dget_space(d);
    std::vector<double> values(H5Sget_simple_extent_npoints(s));
    H5Dread(d, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
    values[values.size() / 2] += 1e-9;
    H5Dwrite(d, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
    H5Sclose(s);
    H5Dclose(d);
  };
  const std::string path = folder / "state.h5";
  write_checkpoint(PETSC_COMM_WORLD, path, points.grid, state);
  tamper(path, [&](hid_t f) { flip(f, "/points/V"); });
  EXPECT_NE(read_error(path, points.grid, state).find("its points are damaged"), std::string::npos);
  write_checkpoint(PETSC_COMM_WORLD, path, points.grid, state);
  tamper(path, [&](hid_t f) { flip(f, "/vectors/u"); });
  EXPECT_NE(read_error(path, points.grid, state).find("vector 'u' is damaged"), std::string::npos);
  write_checkpoint(PETSC_COMM_WORLD, path, points.grid, state);
  MPI_Barrier(PETSC_COMM_WORLD);
  if (my_rank() == 0) std::filesystem::resize_file(path, std::filesystem::file_size(path) / 2);
  MPI_Barrier(PETSC_COMM_WORLD);
  EXPECT_NE(read_error(path, points.grid, state).find("cannot restart from "), std::string::npos);
}

TEST_F(Checkpoints, options) {
  ScopedOptions scoped{{"-checkpoint", "run.h5"}, {"-checkpoint_interval", "5"}, {"-restart", "old.h5"}};
  const CheckpointOptions o = CheckpointOptions::read(PETSC_COMM_WORLD);
  EXPECT_EQ(o.file, "run.h5");
  EXPECT_EQ(o.interval, 5);
  EXPECT_EQ(o.restart, "old.h5");
  ScopedOptions bad{{"-checkpoint_interval", "0"}};
  EXPECT_THROW(CheckpointOptions::read(PETSC_COMM_WORLD), Error);
}

}  // namespace
}  // namespace hg::test
