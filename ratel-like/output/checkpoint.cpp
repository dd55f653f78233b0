#include "output/checkpoint.hpp"

#include <bit>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <vector>

#include "options/error.hpp"
#include "options/options.hpp"
#include "output/h5.hpp"

namespace hg {
namespace {

constexpr const char *kFormat = "honeyguide checkpoint";
constexpr std::int64_t kVersion = 1;

std::uint64_t mix(std::uint64_t z) {
  z += 0x9e3779b97f4a7c15ull;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
  return z ^ (z >> 31);
}

std::uint64_t checksum(const void *data, std::size_t bytes, std::uint64_t h = 0) {
  const auto *p = static_cast<const unsigned char *>(data);
  for (; bytes >= 8; p += 8, bytes -= 8) {
    std::uint64_t word;
    std::memcpy(&word, p, 8);
    h = mix(h ^ word);
  }
  std::uint64_t rest = bytes;
  for (std::size_t i = 0; i < bytes; i++) rest = rest << 8 | p[i];
  return mix(h ^ rest);
}

/// `local` changes with the cells of a rank and their order, `mesh` only with the mesh as a whole.
struct Fingerprint {
  std::uint64_t local = 0, mesh = 0;
  std::int64_t cells = 0;
};

Fingerprint fingerprint(MPI_Comm comm, const CellGrid &grid) {
  Fingerprint f;
  std::uint64_t mine = 0;
  for (std::int32_t c = 0; c < grid.num_cells(); c++) {
    const auto id = static_cast<std::uint64_t>(grid.cell_ids[c]);
    const std::uint64_t h = checksum(grid.cell_corners(c).data(), 24 * sizeof(double), mix(id));
    f.local = mix(f.local ^ h);
    mine += h;
  }
  MPI_Allreduce(&mine, &f.mesh, 1, MPI_UINT64_T, MPI_SUM, comm);
  const std::int64_t cells = grid.num_cells();
  MPI_Allreduce(&cells, &f.cells, 1, MPI_INT64_T, MPI_SUM, comm);
  return f;
}

hid_t type_of(const PointFieldSpec &spec) {
  if (std::strcmp(spec.name, field::id) == 0) return H5T_NATIVE_INT64;
  if (std::strcmp(spec.name, field::region) == 0 || std::strcmp(spec.name, field::cell) == 0) return H5T_NATIVE_INT32;
  return H5T_NATIVE_DOUBLE;
}

/// Calls body(data, bytes) with the raw array of a field of the swarm.
template <class Body>
void with_field(const Swarm &swarm, const PointFieldSpec &spec, Body &&body) {
  const hid_t type = type_of(spec);
  if (type == H5T_NATIVE_INT64) {
    const PointField<std::int64_t> f(swarm, spec.name);
    body(static_cast<void *>(f.data()), f.span().size_bytes());
  } else if (type == H5T_NATIVE_INT32) {
    const PointField<std::int32_t> f(swarm, spec.name);
    body(static_cast<void *>(f.data()), f.span().size_bytes());
  } else {
    const PointField<double> f(swarm, spec.name);
    body(static_cast<void *>(f.data()), f.span().size_bytes());
  }
}

/// Size of this rank's share of the data.
std::uint64_t bytes_of(const Checkpoint &state) {
  std::uint64_t bytes = 0;
  for (const auto &[name, vec] : state.vectors) {
    PetscInt n;
    petsc_check(VecGetLocalSize(vec, &n));
    bytes += static_cast<std::uint64_t>(n) * sizeof(double);
  }
  if (state.swarm) {
    for (const PointFieldSpec &spec : point_fields()) {
      bytes += static_cast<std::uint64_t>(state.swarm->local_size()) * spec.components * spec.bytes;
    }
  }
  return bytes;
}

/// What a rank keeps of its own part, one row for each rank: number of entries, then their checksum as an integer.
struct Part {
  std::int64_t entries = 0, sum = 0;
};

void write_part(H5File &file, const std::string &name, MPI_Comm comm, const Part &part) {
  file.write(name, H5T_NATIVE_INT64, &part, H5Rows::of(comm, 1), 2);
}

/// The row of this rank; entries = -1 where there is none.
Part read_part(H5File &file, const std::string &name, MPI_Comm comm) {
  Part part{-1, 0};
  if (file.rows(name) < 0) return part;
  file.read(name, H5T_NATIVE_INT64, &part, H5Rows::of(comm, 1), 2);
  return part;
}

void read_vector(H5File &file, MPI_Comm comm, const std::string &name, Vec vec) {
  const Part part = read_part(file, "/parts/vector " + name, comm);
  PetscInt n;
  petsc_check(VecGetLocalSize(vec, &n));
  std::string error;
  if (part.entries < 0) {
    error = "the checkpoint has no vector '" + name + "': it is of another kind of run";
  } else if (part.entries != n) {
    error = "vector '" + name + "' has " + std::to_string(part.entries) +
            " entries on this rank in the checkpoint, expected " + std::to_string(n) +
            ": another order of the elements or other boundary conditions?";
  }
  throw_together(comm, error);
  PetscScalar *array;
  petsc_check(VecGetArrayWrite(vec, &array));
  file.read("/vectors/" + name, H5T_NATIVE_DOUBLE, array, H5Rows::of(comm, static_cast<hsize_t>(n)), 0);
  const bool intact = static_cast<std::int64_t>(checksum(array, n * sizeof(double))) == part.sum;
  petsc_check(VecRestoreArrayWrite(vec, &array));
  throw_together(
      comm, !file.good() ? file.error() : (intact ? "" : "vector '" + name + "' is damaged: its checksum is wrong"));
}

void read_points(H5File &file, MPI_Comm comm, const CellGrid &grid, Swarm &swarm) {
  const Part count = read_part(file, "/parts/points", comm);
  throw_together(comm, count.entries < 0 ? "the checkpoint has no points: it is not of a run with -method mpm" : "");
  swarm.resize(static_cast<PetscInt>(count.entries));
  const H5Rows rows = H5Rows::of(comm, static_cast<hsize_t>(count.entries));
  std::string error;
  std::uint64_t sum = 0;
  for (const PointFieldSpec &spec : point_fields()) {
    with_field(swarm, spec, [&](void *data, std::size_t bytes) {
      file.read(std::string("/points/") + spec.name, type_of(spec), data, rows, static_cast<hsize_t>(spec.components));
      sum = checksum(data, bytes, sum);
    });
  }
  if (!file.good()) {
    error = file.error();
  } else if (static_cast<std::int64_t>(sum) != count.sum) {
    error = "its points are damaged: their checksum is wrong";
  } else {
    const PointField<std::int32_t> cell(swarm, field::cell);
    for (const std::int32_t c : cell.span()) {
      if (c < 0 || c >= grid.num_cells())
        error = "a point is in cell " + std::to_string(c) + " that this rank does not have";
    }
  }
  throw_together(comm, error);
}

void check_origin(const H5File &file, MPI_Comm comm, const CellGrid &grid, H5File &parts) {
  std::string format, error;
  std::int64_t version = -1, ranks = -1, cells = -1, mesh = 0;
  int size;
  MPI_Comm_size(comm, &size);
  const Fingerprint here = fingerprint(comm, grid);
  if (!file.read_attribute("/", "format", format) || format != kFormat) {
    error = "it is not a checkpoint of this program";
  } else if (!file.read_attribute("/", "version", version) || version != kVersion) {
    error = "it has version " + std::to_string(version) + ", expected " + std::to_string(kVersion);
  } else if (!file.read_attribute("/", "ranks", ranks) || ranks != size) {
    error = "it was written by " + std::to_string(ranks) + " ranks and can be read by as many only, not by " +
            std::to_string(size);
  } else if (!file.read_attribute("/", "cells", cells) || cells != here.cells) {
    error = "its mesh has " + std::to_string(cells) + " cells, that of this run " + std::to_string(here.cells);
  } else if (!file.read_attribute("/", "mesh", mesh) || mesh != static_cast<std::int64_t>(here.mesh)) {
    error = "its mesh has as many cells as that of this run, but other ones";
  }
  throw_together(comm, error);
  const Part part = read_part(parts, "/parts/cells", comm);
  if (part.entries != grid.num_cells() || part.sum != static_cast<std::int64_t>(here.local)) {
    error = "its mesh is that of this run, but was spread over the ranks in another way";
  }
  throw_together(comm, error);
}

}  // namespace

void write_checkpoint(MPI_Comm comm, const std::string &path, const CellGrid &grid, const Checkpoint &state) {
  const NoFileSizeSignal quiet;
  const std::string temporary = path + ".tmp";
  int rank, size;
  MPI_Comm_rank(comm, &rank);
  MPI_Comm_size(comm, &size);
  const Fingerprint here = fingerprint(comm, grid);
  try {
    throw_together(comm, reserve(comm, temporary, bytes_of(state)));
    H5File file(comm, temporary, H5File::Mode::kCreate);
    if (file.good()) {
      file.write_attribute("/", "format", std::string(kFormat));
      file.write_attribute("/", "version", kVersion);
      file.write_attribute("/", "ranks", std::int64_t{size});
      file.write_attribute("/", "cells", here.cells);
      file.write_attribute("/", "mesh", static_cast<std::int64_t>(here.mesh));
      file.write_attribute("/", "step", static_cast<std::int64_t>(state.step));
      file.write_attribute("/", "time", state.time);
      file.write_attribute("/", "dt", state.dt);
      for (const char *group : {"/parts", "/scalars", "/texts", "/vectors"}) file.make_group(group);
      for (const auto &[name, value] : state.scalars) file.write_attribute("/scalars", name, value);
      for (const auto &[name, value] : state.texts) file.write_attribute("/texts", name, value);
      write_part(file, "/parts/cells", comm, {grid.num_cells(), static_cast<std::int64_t>(here.local)});
      for (const auto &[name, vec] : state.vectors) {
        PetscInt n;
        const PetscScalar *array;
        petsc_check(VecGetLocalSize(vec, &n));
        petsc_check(VecGetArrayRead(vec, &array));
        file.write("/vectors/" + name, H5T_NATIVE_DOUBLE, array, H5Rows::of(comm, static_cast<hsize_t>(n)), 0);
        write_part(file, "/parts/vector " + name, comm,
                   {n, static_cast<std::int64_t>(checksum(array, n * sizeof(double)))});
        petsc_check(VecRestoreArrayRead(vec, &array));
      }
      if (state.swarm) {
        file.make_group("/points");
        const auto n = static_cast<hsize_t>(state.swarm->local_size());
        const H5Rows rows = H5Rows::of(comm, n);
        std::uint64_t sum = 0;
        for (const PointFieldSpec &spec : point_fields()) {
          with_field(*state.swarm, spec, [&](void *data, std::size_t bytes) {
            file.write(std::string("/points/") + spec.name, type_of(spec), data, rows,
                       static_cast<hsize_t>(spec.components));
            sum = checksum(data, bytes, sum);
          });
        }
        write_part(file, "/parts/points", comm, {static_cast<std::int64_t>(n), static_cast<std::int64_t>(sum)});
      }
    }
    file.finish("write");
    throw_together(comm, sync_and_rename(comm, temporary, path));
  } catch (const Error &error) {
    if (rank == 0) std::remove(temporary.c_str());
    const bool old = std::filesystem::exists(path);
    fail("checkpoint %s was not written: %s%s", path.c_str(), error.what(),
         old ? "; the one before is still there" : "");
  }
}

void read_checkpoint(MPI_Comm comm, const std::string &path, const CellGrid &grid, Checkpoint &state) {
  int rank;
  MPI_Comm_rank(comm, &rank);
  try {
    std::string error;
    if (rank == 0) {
      if (!std::filesystem::is_regular_file(path)) {
        error = "there is no such file";
      } else {
        H5E_auto2_t handler;
        void *data;
        H5Eget_auto2(H5E_DEFAULT, &handler, &data);
        H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
        if (H5Fis_hdf5(path.c_str()) <= 0) error = "it is not an HDF5 file";
        H5Eset_auto2(H5E_DEFAULT, handler, data);
      }
    }
    throw_together(comm, error);
    H5File file(comm, path, H5File::Mode::kRead);
    throw_together(comm, file.error());
    check_origin(file, comm, grid, file);
    std::int64_t step = 0;
    const bool complete = file.read_attribute("/", "step", step) && file.read_attribute("/", "time", state.time) &&
                          file.read_attribute("/", "dt", state.dt);
    throw_together(comm, complete ? "" : "it has no step, time or step size");
    state.step = static_cast<PetscInt>(step);
    state.scalars = file.read_doubles("/scalars");
    state.texts = file.read_strings("/texts");
    for (const auto &[name, vec] : state.vectors) read_vector(file, comm, name, vec);
    if (state.swarm) {
      read_points(file, comm, grid, *state.swarm);
    } else {
      throw_together(
          comm, file.rows("/parts/points") >= 0 ? "it has points, which a run without -method mpm cannot use" : "");
    }
    file.finish("read");
  } catch (const Error &error) {
    fail("cannot restart from %s: %s", path.c_str(), error.what());
  }
}

CheckpointOptions CheckpointOptions::read(MPI_Comm comm) {
  OptionGroup group(comm, "", "Checkpoints");
  CheckpointOptions o;
  o.file = group.string("checkpoint", "file that the state is written to (HDF5); none by default", "");
  o.interval = group.integer("checkpoint_interval", "steps between checkpoints; the last step is always written", 1,
                             Range::at_least(1));
  o.restart = group.string("restart", "checkpoint to go on from", "");
  return o;
}

}  // namespace hg
