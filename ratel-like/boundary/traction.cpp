#include "boundary/traction.hpp"

#include <cmath>
#include <string>

#include "options/error.hpp"

namespace hg {

namespace {

// Lagrange polynomials through `nodes` at `points`: N[q][i].
std::vector<std::vector<double>> lagrange(const std::vector<double> &nodes, const std::vector<double> &points) {
  std::vector<std::vector<double>> N(points.size(), std::vector<double>(nodes.size(), 1.));
  for (std::size_t q = 0; q < points.size(); ++q) {
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      for (std::size_t j = 0; j < nodes.size(); ++j) {
        if (i != j) N[q][i] *= (points[q] - nodes[j]) / (nodes[i] - nodes[j]);
      }
    }
  }
  return N;
}

}  // namespace

Tractions::Tractions(const Mesh &mesh) {
  PetscReal final_time = 1.;
  petsc_check(PetscOptionsGetReal(nullptr, nullptr, "-ts_max_time", &final_time, nullptr));
  OptionGroup list(mesh.comm, "", "Tractions");
  for (PetscInt number : list.integers("bc_traction", "faces with a traction (fem)", {})) {
    const std::string name = "bc_traction_" + std::to_string(number);
    OptionGroup group(mesh.comm, name + "_", "Traction on face " + std::to_string(number));
    Face face;
    const std::vector<double> flat =
        list.reals(name.c_str(), "x,y,z at each time: force per undeformed area [Pa]", {}, -1);
    if (!list.helping() && (flat.empty() || flat.size() % 3 != 0)) {
      fail("option -%s: %zu numbers, expected 3 for each time", name.c_str(), flat.size());
    }
    for (std::size_t i = 0; i + 2 < flat.size(); i += 3) face.vectors.push_back({flat[i], flat[i + 1], flat[i + 2]});
    face.times = group.reals("times", "time of each vector, ascending [s]; default: -ts_max_time", {final_time}, -1);
    if (!list.helping() && face.times.size() != face.vectors.size()) {
      fail("options -%s*: %zu vectors for %zu times, expected as many", name.c_str(), face.vectors.size(),
           face.times.size());
    }
    for (std::size_t i = 1; i < face.times.size(); ++i) {
      if (face.times[i] <= face.times[i - 1]) {
        fail("option -%s_times: %g after %g, expected ascending", name.c_str(), face.times[i], face.times[i - 1]);
      }
    }
    face.ramp = group.choice("interpolation", "between the times: linear (from 0 at t = 0), or step",
                             {"linear", "step"}, "linear") == "step"
                    ? Ramp::step
                    : Ramp::linear;
    PetscInt found = 0, total = 0;
    for (CeedInt cell = 0; cell < mesh.num_cells; ++cell) {
      for (int side = 0; side < 6; ++side) {
        PetscInt value;
        petsc_check(DMGetLabelValue(mesh.dm, "Face Sets", mesh.faces[6 * cell + side], &value));
        if (value != number) continue;
        integrate(mesh, cell, side, face);
        ++found;
      }
    }
    MPI_Allreduce(&found, &total, 1, MPIU_INT, MPI_SUM, mesh.comm);
    if (total == 0) {
      fail("option -bc_traction: the mesh has no face with the value %" PetscInt_FMT " in the label 'Face Sets'",
           number);
    }
    faces_.push_back(std::move(face));
  }
}

void Tractions::integrate(const Mesh &mesh, CeedInt cell, int side, Face &face) {
  const int P = static_cast<int>(mesh.order) + 1, Q = P + 1;
  const int normal = side / 2, first = normal == 0 ? 1 : 0, second = normal == 2 ? 1 : 2;
  std::vector<double> nodes(P), ignored(P), points(Q), weights(Q);
  ceed_check(CeedLobattoQuadrature(P, nodes.data(), ignored.data()));
  ceed_check(CeedGaussQuadrature(Q, points.data(), weights.data()));
  const auto N = lagrange(nodes, points);
  const auto corners = mesh.corners(cell);
  std::vector<double> areas(static_cast<std::size_t>(P) * P, 0.);
  for (int t = 0; t < Q; ++t) {
    for (int s = 0; s < Q; ++s) {
      // Tangents of the bilinear face; its area element is the length of their cross product.
      double a[3] = {}, b[3] = {};
      for (int corner = 0; corner < 8; ++corner) {
        if ((corner >> normal & 1) != side % 2) continue;
        const double sign_s = corner >> first & 1 ? 1 : -1, sign_t = corner >> second & 1 ? 1 : -1;
        for (int c = 0; c < 3; ++c) {
          a[c] += sign_s * (1 + sign_t * points[t]) / 4 * corners[3 * corner + c];
          b[c] += sign_t * (1 + sign_s * points[s]) / 4 * corners[3 * corner + c];
        }
      }
      const double dA = weights[s] * weights[t] *
                        std::hypot(a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]);
      for (int j = 0; j < P; ++j) {
        for (int i = 0; i < P; ++i) areas[j * P + i] += N[s][i] * N[t][j] * dA;
      }
    }
  }
  for (int j = 0; j < P; ++j) {
    for (int i = 0; i < P; ++i) {
      int at[3];
      at[normal] = side % 2 ? P - 1 : 0;
      at[first] = i;
      at[second] = j;
      face.offsets.push_back(mesh.node_offsets()[P * P * P * cell + (at[2] * P + at[1]) * P + at[0]]);
      face.areas.push_back(areas[j * P + i]);
    }
  }
}

void Tractions::add(double time, std::span<double> local) const {
  for (const Face &face : faces_) {
    const std::array<double, 3> t = vector_at(face.times, face.vectors, face.ramp, time);
    for (std::size_t n = 0; n < face.offsets.size(); ++n) {
      for (int c = 0; c < 3; ++c) local[face.offsets[n] + c] += face.areas[n] * t[c];
    }
  }
}

}  // namespace hg
