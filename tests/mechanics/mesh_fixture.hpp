// Meshes for the tests of the mechanics layer.
#pragma once

#include <ceed.h>
#include <petscsys.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "mesh/mesh.hpp"
#include "options/error.hpp"

namespace hg::test {

inline CeedHandle make_ceed(const char *resource = "/cpu/self/ref/serial") {
  CeedHandle ceed;
  ceed_check(CeedInit(resource, ceed.put()));
  keep_ceed_errors(ceed);
  return ceed;
}

/// Sets options for the lifetime of this object, then removes them: `ScopedOptions scoped{{"-nu", "0.3"}};`
class ScopedOptions {
 public:
  ScopedOptions(std::initializer_list<std::pair<std::string, std::string>> options) : options_(options) {
    for (const auto &[name, value] : options_) petsc_check(PetscOptionsSetValue(nullptr, name.c_str(), value.c_str()));
  }
  ~ScopedOptions() {
    for (const auto &option : options_) (void)PetscOptionsClearValue(nullptr, option.first.c_str());
  }
  ScopedOptions(const ScopedOptions &) = delete;
  ScopedOptions &operator=(const ScopedOptions &) = delete;

 private:
  std::vector<std::pair<std::string, std::string>> options_;
};

inline std::unique_ptr<Mesh> box_mesh(Ceed ceed, const std::string &faces, const MeshOptions &options,
                                      const std::string &upper = "1,1,1") {
  ScopedOptions scoped{{"-dm_plex_box_faces", faces}, {"-dm_plex_box_upper", upper}};
  return std::make_unique<Mesh>(PETSC_COMM_WORLD, ceed, options);
}

/// Moves the inner vertices of the unit cube smoothly; the boundary stays, so the volume stays 1.
inline void bend(double *x) {
  const double bump = 0.08 * std::sin(M_PI * x[0]) * std::sin(M_PI * x[1]) * std::sin(M_PI * x[2]);
  x[0] += bump;
  x[1] -= 0.7 * bump;
  x[2] += 0.5 * bump;
}

/// Writes a Gmsh file of the unit cube with n³ hexahedra whose vertices are listed in one of the 24 right-handed ways
/// each, at random, with vertex numbers shuffled; boundary faces carry physical groups 1 to 6 (z-, z+, y-, y+, x+, x-),
/// cells physical group 10, or 11 where x < 1/2. Rank 0 writes, all ranks wait.
inline std::string write_rotated_gmsh(const std::string &name, int n) {
  int rank;
  MPI_Comm_rank(PETSC_COMM_WORLD, &rank);
  if (rank == 0) {
    std::mt19937 random(42);
    const int m = n + 1, num_nodes = m * m * m;
    std::vector<int> number(num_nodes);
    for (int i = 0; i < num_nodes; ++i) number[i] = i + 1;
    std::shuffle(number.begin(), number.end(), random);
    const auto node = [&](int i, int j, int k) { return number[(k * m + j) * m + i]; };

    // Rotations of the cube as permutations of the corners in tensor order.
    std::vector<std::array<int, 8>> rotations;
    std::array<int, 3> axes{0, 1, 2};
    do {
      for (int flip = 0; flip < 8; ++flip) {
        const bool even = (axes == std::array{0, 1, 2} || axes == std::array{1, 2, 0} || axes == std::array{2, 0, 1});
        if (even != (__builtin_popcount(flip) % 2 == 0)) continue;
        std::array<int, 8> corner{};
        for (int a = 0; a < 8; ++a) {
          for (int d = 0; d < 3; ++d) corner[a] |= ((a >> d & 1) ^ (flip >> d & 1)) << axes[d];
        }
        rotations.push_back(corner);
      }
    } while (std::next_permutation(axes.begin(), axes.end()));

    std::FILE *file = std::fopen(name.c_str(), "w");
    if (!file) fail("cannot write %s", name.c_str());
    std::fprintf(file, "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n%d\n", num_nodes);
    std::vector<std::array<double, 3>> coords(num_nodes);
    for (int k = 0; k < m; ++k) {
      for (int j = 0; j < m; ++j) {
        for (int i = 0; i < m; ++i) coords[node(i, j, k) - 1] = {1. * i / n, 1. * j / n, 1. * k / n};
      }
    }
    for (int i = 0; i < num_nodes; ++i) {
      std::fprintf(file, "%d %.17g %.17g %.17g\n", i + 1, coords[i][0], coords[i][1], coords[i][2]);
    }
    std::fprintf(file, "$EndNodes\n$Elements\n%d\n", n * n * n + 6 * n * n);
    int id = 1;
    for (int b = 0; b < n; ++b) {
      for (int a = 0; a < n; ++a) {
        const auto quad = [&](int group, auto &&at) {
          const auto p0 = at(a, b), p1 = at(a + 1, b), p2 = at(a + 1, b + 1), p3 = at(a, b + 1);
          std::fprintf(file, "%d 3 2 %d %d %d %d %d %d\n", id++, group, group, p0, p1, p2, p3);
        };
        quad(1, [&](int s, int t) { return node(s, t, 0); });
        quad(2, [&](int s, int t) { return node(s, t, n); });
        quad(3, [&](int s, int t) { return node(s, 0, t); });
        quad(4, [&](int s, int t) { return node(s, n, t); });
        quad(5, [&](int s, int t) { return node(n, s, t); });
        quad(6, [&](int s, int t) { return node(0, s, t); });
      }
    }
    constexpr int gmsh_corner[8] = {0, 1, 3, 2, 4, 5, 7, 6};  // tensor corner of each vertex in Gmsh's list
    for (int k = 0; k < n; ++k) {
      for (int j = 0; j < n; ++j) {
        for (int i = 0; i < n; ++i) {
          const auto &rotation = rotations[random() % rotations.size()];
          std::fprintf(file, "%d 5 2 %d 1", id++, 2 * i < n ? 11 : 10);
          for (int a : gmsh_corner) {
            const int c = rotation[a];
            std::fprintf(file, " %d", node(i + (c & 1), j + (c >> 1 & 1), k + (c >> 2 & 1)));
          }
          std::fprintf(file, "\n");
        }
      }
    }
    std::fprintf(file, "$EndElements\n");
    std::fclose(file);
  }
  MPI_Barrier(PETSC_COMM_WORLD);
  return name;
}

inline std::unique_ptr<Mesh> gmsh_mesh(Ceed ceed, const std::string &file, const MeshOptions &options) {
  ScopedOptions scoped{{"-dm_plex_filename", file}};
  return std::make_unique<Mesh>(PETSC_COMM_WORLD, ceed, options);
}

}  // namespace hg::test
