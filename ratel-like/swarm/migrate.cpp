#include "swarm/migrate.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "options/error.hpp"

namespace hg {
namespace {

// While points are on their way, their cell field says what is known of them:
//   >= 0 settled, kLost no cell, kSearch to be searched without a guess, <= kFirstGuess walk on from cell kFirstGuess -
//   cell.
constexpr std::int32_t kLost = -1;
constexpr std::int32_t kSearch = -2;
constexpr std::int32_t kFirstGuess = -3;

void mpi_check(int code, const char *what) {
  if (code != MPI_SUCCESS) fail("%s failed with MPI error %d", what, code);
}

/// What migration must keep: the count, the mass, and a checksum of every (id, mass) that no order or partition
/// changes.
struct Tally {
  std::uint64_t count = 0, checksum = 0;
  double mass = 0.0;
};

std::uint64_t fingerprint(std::int64_t id, double mass) {
  std::uint64_t z = static_cast<std::uint64_t>(id) * 0x9e3779b97f4a7c15ull ^ std::bit_cast<std::uint64_t>(mass);
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
  return z ^ (z >> 31);
}

Tally tally(const Swarm &swarm) {
  const PointField<std::int64_t> id(swarm, field::id);
  const PointField<double> rho0(swarm, field::rho0), V0(swarm, field::V0);
  Tally t;
  t.count = id.size();
  for (std::size_t p = 0; p < id.size(); p++) {
    const double mass = rho0[p] * V0[p];
    t.checksum += fingerprint(id[p], mass);
    t.mass += mass;
  }
  return t;
}

Tally sum(const Tally &mine, MPI_Comm comm) {
  Tally all;
  const std::uint64_t in[2] = {mine.count, mine.checksum};
  std::uint64_t out[2];
  mpi_check(MPI_Allreduce(in, out, 2, MPI_UINT64_T, MPI_SUM, comm), "MPI_Allreduce");
  mpi_check(MPI_Allreduce(&mine.mass, &all.mass, 1, MPI_DOUBLE, MPI_SUM, comm), "MPI_Allreduce");
  all.count = out[0];
  all.checksum = out[1];
  return all;
}

PetscInt sum(PetscInt mine, MPI_Comm comm) {
  PetscInt all = 0;
  mpi_check(MPI_Allreduce(&mine, &all, 1, MPIU_INT, MPI_SUM, comm), "MPI_Allreduce");
  return all;
}

/// A point without a cell, as every rank sees it.
struct Lost {
  double x[3];
  std::int64_t id;
  std::int32_t rank, local;  // where it is stored
};

class Migration {
 public:
  Migration(const SwarmOptions &options, const CellGrid &grid, const HexLocator &locator, Swarm &swarm)
      : options_(options), grid_(grid), locator_(locator), swarm_(swarm), comm_(swarm.comm()) {
    MPI_Comm_rank(comm_, &rank_);
    MPI_Comm_size(comm_, &size_);
  }

  MigrateStats run() {
    Tally before = sum(tally(swarm_), comm_);
    settle(true);
    std::vector<Lost> lost = gather_lost();
    if (!lost.empty() && size_ > 1) {
      offer(lost);
      settle(false);
      lost = gather_lost();
    }
    if (!lost.empty()) apply_policy(lost, before);
    const Tally after = sum(tally(swarm_), comm_);
    if (after.count != before.count || after.checksum != before.checksum) {
      fail("moving points between ranks changed them: %llu points of mass %.17g kg before, %llu of mass %.17g kg after",
           static_cast<unsigned long long>(before.count), before.mass, static_cast<unsigned long long>(after.count),
           after.mass);
    }
    return stats_;
  }

 private:
  /// Locates points on this rank. First time: all, from the cell they were in; then only those that arrived.
  PetscInt locate_here(bool first) {
    const PointField<double> x(swarm_, field::x), xi(swarm_, field::x_ref);
    const PointField<std::int32_t> cell(swarm_, field::cell);
    void *data;
    petsc_check(DMSwarmGetField(swarm_.dm(), DMSwarmField_rank, nullptr, nullptr, &data));
    auto *target = static_cast<PetscInt *>(data);
    PetscInt leaving = 0;
    for (std::size_t p = 0; p < cell.size(); p++) {
      target[p] = rank_;
      if (!first && (cell[p] >= 0 || cell[p] == kLost)) continue;
      std::int32_t guess[1] = {first ? cell[p] : (cell[p] <= kFirstGuess ? kFirstGuess - cell[p] : -1)};
      PointPlace place[1];
      locator_.locate(x.span().subspan(3 * p, 3), guess, xi.span().subspan(3 * p, 3), place);
      if (place[0] == PointPlace::kInside) {
        cell[p] = guess[0];
      } else if (place[0] == PointPlace::kOutside) {
        cell[p] = kLost;
      } else {
        const CellGrid::RemoteFace &face = grid_.remote[guess[0]];
        target[p] = face.rank;
        cell[p] = kFirstGuess - face.cell;
        leaving++;
      }
    }
    petsc_check(DMSwarmRestoreField(swarm_.dm(), DMSwarmField_rank, nullptr, nullptr, &data));
    return leaving;
  }

  /// Ships every point whose rank field names another rank.
  void ship(PetscInt leaving_everywhere) {
    petsc_check(DMSwarmMigrate(swarm_.dm(), PETSC_TRUE));
    stats_.moved += leaving_everywhere;
    stats_.rounds++;
  }

  /// Walks across ranks until no point is on its way; what has not arrived by then circles, and is lost.
  void settle(bool first) {
    const PetscInt most_rounds = 64 + 8 * static_cast<PetscInt>(size_);
    for (PetscInt round = 0;; round++) {
      const PetscInt leaving = sum(locate_here(first), comm_);
      first = false;
      if (leaving == 0) return;
      if (round == most_rounds) break;
      ship(leaving);
    }
    const PointField<std::int32_t> cell(swarm_, field::cell);
    for (std::size_t p = 0; p < cell.size(); p++) {
      if (cell[p] < 0) cell[p] = kLost;
    }
  }

  /// Lost points of all ranks, in rank order.
  std::vector<Lost> gather_lost() const {
    std::vector<Lost> mine;
    {
      const PointField<double> x(swarm_, field::x);
      const PointField<std::int64_t> id(swarm_, field::id);
      const PointField<std::int32_t> cell(swarm_, field::cell);
      for (std::size_t p = 0; p < cell.size(); p++) {
        if (cell[p] == kLost) {
          mine.push_back({{x[3 * p], x[3 * p + 1], x[3 * p + 2]}, id[p], rank_, static_cast<std::int32_t>(p)});
        }
      }
    }
    if (sum(static_cast<PetscInt>(mine.size()), comm_) == 0) return {};
    const int bytes = static_cast<int>(mine.size() * sizeof(Lost));
    std::vector<int> counts(size_), starts(size_, 0);
    mpi_check(MPI_Allgather(&bytes, 1, MPI_INT, counts.data(), 1, MPI_INT, comm_), "MPI_Allgather");
    for (int r = 1; r < size_; r++) starts[r] = starts[r - 1] + counts[r - 1];
    std::vector<Lost> all((starts.back() + counts.back()) / sizeof(Lost));
    mpi_check(MPI_Allgatherv(mine.data(), bytes, MPI_BYTE, all.data(), counts.data(), starts.data(), MPI_BYTE, comm_),
              "MPI_Allgatherv");
    return all;
  }

  /// Sends each of `lost` that `to` gives a rank (size_: none) there, to be searched without a guess.
  void send(const std::vector<Lost> &lost, const std::vector<int> &to) {
    PetscInt leaving = 0;
    {
      const PointField<std::int32_t> cell(swarm_, field::cell);
      void *data;
      petsc_check(DMSwarmGetField(swarm_.dm(), DMSwarmField_rank, nullptr, nullptr, &data));
      auto *target = static_cast<PetscInt *>(data);
      for (std::size_t p = 0; p < cell.size(); p++) target[p] = rank_;
      for (std::size_t i = 0; i < lost.size(); i++) {
        if (to[i] == size_) continue;
        if (to[i] != lost[i].rank) leaving++;
        if (lost[i].rank != rank_) continue;
        cell[lost[i].local] = kSearch;
        target[lost[i].local] = to[i];
      }
      petsc_check(DMSwarmRestoreField(swarm_.dm(), DMSwarmField_rank, nullptr, nullptr, &data));
    }
    if (leaving) ship(leaving);
  }

  /// Asks every rank for each lost point; the lowest rank that holds it takes it (a tie is settled by the walk there).
  void offer(const std::vector<Lost> &lost) {
    std::vector<int> mine(lost.size()), to(lost.size());
    for (std::size_t i = 0; i < lost.size(); i++) {
      mine[i] = locator_.find(lost[i].x).place == PointPlace::kInside ? rank_ : size_;
    }
    mpi_check(MPI_Allreduce(mine.data(), to.data(), static_cast<int>(lost.size()), MPI_INT, MPI_MIN, comm_),
              "MPI_Allreduce");
    send(lost, to);
  }

  struct Nearest {
    double distance;
    int rank;
  };
  /// The rank nearest to each point (size_ on a mesh without cells), and this rank's own candidates.
  std::vector<Nearest> nearest(std::span<const Lost> lost, std::vector<Location> &own) const {
    std::vector<Nearest> mine(lost.size()), best(lost.size());
    own.resize(lost.size());
    for (std::size_t i = 0; i < lost.size(); i++) {
      mine[i].distance = locator_.nearest(lost[i].x, own[i]);
      mine[i].rank = rank_;
    }
    mpi_check(MPI_Allreduce(mine.data(), best.data(), static_cast<int>(lost.size()), MPI_DOUBLE_INT, MPI_MINLOC, comm_),
              "MPI_Allreduce");
    return best;
  }

  void apply_policy(const std::vector<Lost> &lost, Tally &conserved) {
    bool finite = true;
    for (const Lost &l : lost)
      finite = finite && std::isfinite(l.x[0]) && std::isfinite(l.x[1]) && std::isfinite(l.x[2]);
    if (options_.outside == OutsidePolicy::kError || !finite) report(lost);
    if (options_.outside == OutsidePolicy::kRemove) {
      remove(lost, conserved);
    } else {
      project(lost);
    }
  }

  [[noreturn]] void report(const std::vector<Lost> &lost) const {
    constexpr std::size_t kShown = 3;
    const std::span<const Lost> shown(lost.data(), std::min(lost.size(), kShown));
    std::vector<Location> own;
    const std::vector<Nearest> best = nearest(shown, own);
    std::string text =
        std::to_string(lost.size()) + (lost.size() == 1 ? " point is" : " points are") + " outside the mesh:";
    for (std::size_t i = 0; i < shown.size(); i++) {
      long long cell =
          best[i].rank == rank_ && own[i].index >= 0 ? static_cast<long long>(grid_.cell_ids[own[i].index]) : -1;
      mpi_check(MPI_Allreduce(MPI_IN_PLACE, &cell, 1, MPI_LONG_LONG, MPI_MAX, comm_), "MPI_Allreduce");
      char line[256];
      const Lost &l = shown[i];
      if (cell >= 0) {
        std::snprintf(line, sizeof line, " point %lld at (%g, %g, %g), nearest cell %lld at distance %g;",
                      static_cast<long long>(l.id), l.x[0], l.x[1], l.x[2], cell, best[i].distance);
      } else {
        std::snprintf(line, sizeof line, " point %lld at (%g, %g, %g);", static_cast<long long>(l.id), l.x[0], l.x[1],
                      l.x[2]);
      }
      text += line;
    }
    if (lost.size() > kShown) text += " ...";
    text +=
        " every point must stay inside (enlarge the mesh, take smaller steps, or set -mpm_point_outside "
        "project|remove)";
    throw Error(text);
  }

  void remove(const std::vector<Lost> &lost, Tally &conserved) {
    Tally gone;
    {
      const PointField<double> rho0(swarm_, field::rho0), V0(swarm_, field::V0);
      for (const Lost &l : lost) {
        if (l.rank != rank_) continue;
        const double mass = rho0[l.local] * V0[l.local];
        gone.mass += mass;
        gone.checksum += fingerprint(l.id, mass);
        gone.count++;
      }
    }
    for (std::size_t i = lost.size(); i-- > 0;) {  // from the back, for removal fills a hole with the last point
      if (lost[i].rank == rank_) petsc_check(DMSwarmRemovePointAtIndex(swarm_.dm(), lost[i].local));
    }
    gone = sum(gone, comm_);
    stats_.removed = static_cast<PetscInt>(gone.count);
    stats_.removed_mass = gone.mass;
    conserved.count -= gone.count;
    conserved.checksum -= gone.checksum;
    conserved.mass -= gone.mass;
  }

  void project(const std::vector<Lost> &lost) {
    std::vector<Location> own;
    const std::vector<Nearest> best = nearest(lost, own);
    std::vector<double> places(3 * lost.size(), 0.0);
    std::vector<int> to(lost.size());
    for (std::size_t i = 0; i < lost.size(); i++) {
      to[i] = best[i].rank;
      if (best[i].rank == rank_ && own[i].index >= 0) locator_.map(own[i].index, own[i].xi, &places[3 * i]);
    }
    mpi_check(MPI_Allreduce(MPI_IN_PLACE, places.data(), static_cast<int>(places.size()), MPI_DOUBLE, MPI_SUM, comm_),
              "MPI_Allreduce");
    {
      const PointField<double> x(swarm_, field::x), X0(swarm_, field::X0), u(swarm_, field::u);
      for (std::size_t i = 0; i < lost.size(); i++) {
        if (lost[i].rank != rank_) continue;
        for (int d = 0; d < 3; d++) {
          const std::size_t k = 3 * static_cast<std::size_t>(lost[i].local) + d;
          x[k] = places[3 * i + d];
          u[k] = x[k] - X0[k];
        }
      }
    }
    stats_.projected = static_cast<PetscInt>(lost.size());
    send(lost, to);
    settle(false);
    const std::vector<Lost> still = gather_lost();
    if (!still.empty()) report(still);
  }

  const SwarmOptions &options_;
  const CellGrid &grid_;
  const HexLocator &locator_;
  Swarm &swarm_;
  MPI_Comm comm_;
  PetscMPIInt rank_ = 0, size_ = 1;
  MigrateStats stats_;
};

}  // namespace

MigrateStats locate_points(const SwarmOptions &options, const CellGrid &grid, const HexLocator &locator, Swarm &swarm) {
  return Migration(options, grid, locator, swarm).run();
}

}  // namespace hg
