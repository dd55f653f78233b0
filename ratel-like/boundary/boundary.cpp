#include "boundary/boundary.hpp"

#include <cmath>

#include "options/error.hpp"
#include "qfunctions/bc/mms_linear.h"

namespace hg {

namespace {

// The header's QFunctions belong to the operators; only its helper is used here.
[[maybe_unused]] constexpr CeedQFunctionUser used_elsewhere[] = {HgMmsLinearForce, HgMmsLinearError};

double final_time() {
  PetscReal time = 1.;
  petsc_check(PetscOptionsGetReal(nullptr, nullptr, "-ts_max_time", &time, nullptr));
  return time;
}

template <std::size_t N>
std::vector<std::array<double, N>> in_rows(const OptionGroup &group, const char *name,
                                           const std::vector<double> &flat) {
  if (flat.size() % N != 0) {
    fail("option %s: %zu numbers, expected %zu for each time", group.full(name).c_str(), flat.size(), N);
  }
  std::vector<std::array<double, N>> rows(flat.size() / N);
  for (std::size_t i = 0; i < flat.size(); ++i) rows[i / N][i % N] = flat[i];
  return rows;
}

void read_times(OptionGroup &group, BoundaryFace &face) {
  const std::size_t steps = std::max(face.translate.size(), face.rotate.size());
  face.times = group.reals("times", "time of each value, ascending [s]; default: -ts_max_time", {final_time()}, -1);
  face.ramp =
      group.choice("interpolation", "between the times: linear (from 0 at t = 0), or step: the next time's value",
                   {"linear", "step"}, "linear") == "step"
          ? Ramp::step
          : Ramp::linear;
  for (std::size_t given : {face.translate.size(), face.rotate.size()}) {
    if (given && given != face.times.size()) {
      fail("options -%s*: %zu values for %zu times, expected as many", group.prefix().c_str(), given,
           face.times.size());
    }
  }
  for (std::size_t i = 1; steps && i < face.times.size(); ++i) {
    if (face.times[i] <= face.times[i - 1]) {
      fail("option %s: %g after %g, expected ascending", group.full("times").c_str(), face.times[i], face.times[i - 1]);
    }
  }
}

BoundaryFace read_clamp(MPI_Comm comm, PetscInt number) {
  BoundaryFace face;
  face.face = number;
  face.components = {true, true, true};
  OptionGroup group(comm, "bc_clamp_" + std::to_string(number) + "_", "Clamped face " + std::to_string(number));
  face.translate =
      in_rows<3>(group, "translate", group.reals("translate", "displacement x,y,z at each time [m]", {}, -1));
  face.rotate =
      in_rows<5>(group, "rotate",
                 group.reals("rotate", "axis rx,ry,rz and c0,c1 at each time: angle c0 + c1 r.x/|r| [rad]", {}, -1));
  for (const auto &row : face.rotate) {
    if (std::hypot(row[0], row[1], row[2]) == 0) fail("option %s: the axis is zero", group.full("rotate").c_str());
  }
  read_times(group, face);
  return face;
}

BoundaryFace read_slip(MPI_Comm comm, PetscInt number) {
  BoundaryFace face;
  face.kind = BoundaryFace::Kind::slip;
  face.face = number;
  OptionGroup group(comm, "bc_slip_" + std::to_string(number) + "_", "Slipping face " + std::to_string(number));
  const std::vector<PetscInt> components = group.integers("components", "components that are given: 0, 1, 2", {});
  if (components.empty() && !group.helping())
    fail("option %s is missing: expected a list of 0, 1, 2", group.full("components").c_str());
  for (PetscInt c : components) {
    if (c < 0 || c > 2) fail("option %s: %" PetscInt_FMT ", expected 0, 1 or 2", group.full("components").c_str(), c);
    face.components[c] = true;
  }
  const std::vector<double> flat = group.reals("translate", "displacement of each component at each time [m]", {}, -1);
  if (!flat.empty() && (components.empty() || flat.size() % components.size() != 0)) {
    fail("option %s: %zu numbers, expected %zu for each time", group.full("translate").c_str(), flat.size(),
         components.size());
  }
  face.translate.resize(flat.empty() ? 0 : flat.size() / components.size());
  for (std::size_t i = 0; i < flat.size(); ++i) {
    face.translate[i / components.size()][components[i % components.size()]] = flat[i];
  }
  read_times(group, face);
  return face;
}

// What a face's rotation at time t does to x, or undoes: a piecewise path of rotations whose angles are interpolated
// and whose axis is that of the next time. A rotation keeps the coordinate along its axis, so the angle can be undone.
std::array<double, 3> rotated_by(const BoundaryFace &face, double t, std::span<const double, 3> x, double sign = 1.) {
  std::vector<std::array<double, 3>> angles;
  std::size_t next = 0;
  while (next + 1 < face.times.size() && face.times[next] < t) ++next;
  const auto &row = face.rotate[next];
  const double length = std::hypot(row[0], row[1], row[2]);
  const double k[3] = {row[0] / length, row[1] / length, row[2] / length};
  const double along = k[0] * x[0] + k[1] * x[1] + k[2] * x[2];
  for (const auto &each : face.rotate) angles.push_back({each[3] + each[4] * along, 0, 0});
  const double theta = sign * vector_at(face.times, angles, face.ramp, t)[0];
  // Rodrigues: u = sin θ (k × x) + (1 − cos θ) (k (k·x) − x)
  const double s = std::sin(theta), c = 1 - std::cos(theta);
  return {s * (k[1] * x[2] - k[2] * x[1]) + c * (k[0] * along - x[0]),
          s * (k[2] * x[0] - k[0] * x[2]) + c * (k[1] * along - x[1]),
          s * (k[0] * x[1] - k[1] * x[0]) + c * (k[2] * along - x[2])};
}

}  // namespace

double mms_factor(double t, double final_time) {
  return final_time > 0 ? std::min(t / final_time, 1.) : 1.;
}

std::array<double, 3> BoundaryFace::value(double t, std::span<const double, 3> x) const {
  std::array<double, 3> u{};
  if (kind == Kind::mms) {
    const double at[3] = {x[0], x[1], x[2]};
    hg_mms_linear_displacement(at, mms_amplitude * mms_factor(t, final_time), u.data());
    return u;
  }
  if (!translate.empty()) u = vector_at(times, translate, ramp, t);
  if (!rotate.empty()) {
    const auto turn = rotated_by(*this, t, x);
    for (int c = 0; c < 3; ++c) u[c] += turn[c];
  }
  return u;
}

std::array<double, 3> BoundaryFace::increment(double t_from, double t, std::span<const double, 3> x) const {
  // where the piece of boundary that is at x now was at first
  std::array<double, 3> X{x[0], x[1], x[2]};
  if (!rotate.empty()) {
    if (!translate.empty()) {
      const auto moved = vector_at(times, translate, ramp, t_from);
      for (int c = 0; c < 3; ++c) X[c] -= moved[c];
    }
    const auto back = rotated_by(*this, t_from, X, -1.);
    for (int c = 0; c < 3; ++c) X[c] += back[c];
  }
  const auto from = value(t_from, X), to = value(t, X);
  return {to[0] - from[0], to[1] - from[1], to[2] - from[2]};
}

std::vector<BoundaryFace> BoundaryConditions::read(MPI_Comm comm) {
  OptionGroup group(comm, "", "Boundary conditions");
  std::vector<BoundaryFace> faces;
  for (PetscInt number : group.integers("bc_clamp", "faces where the displacement is given", {})) {
    faces.push_back(read_clamp(comm, number));
  }
  for (PetscInt number : group.integers("bc_slip", "faces where some components are given", {})) {
    faces.push_back(read_slip(comm, number));
  }
  for (PetscInt number : group.integers("bc_mms", "faces that follow the manufactured solution", {})) {
    BoundaryFace face;
    face.kind = BoundaryFace::Kind::mms;
    face.face = number;
    face.components = {true, true, true};
    face.final_time = final_time();
    faces.push_back(face);
  }
  return faces;
}

BoundaryConditions::BoundaryConditions(Mesh &mesh, MPI_Comm comm) : BoundaryConditions(mesh, read(comm)) {}

BoundaryConditions::BoundaryConditions(Mesh &mesh, std::vector<BoundaryFace> faces)
    : mesh_(mesh), faces_(std::move(faces)) {
  const std::size_t num_nodes = mesh.node_coordinates(mesh.order).size() / 3;
  std::vector<int> owner(3 * num_nodes, -1);
  for (int f = 0; f < static_cast<int>(faces_.size()); ++f) {
    std::vector<double> touched(num_nodes, 0.);
    for (PetscInt node : mesh.nodes_on(mesh.order, "Face Sets", faces_[f].face)) touched[node] = 1;
    // A node on the face may belong to a rank that has no cell behind the face.
    mesh.sum_shared(mesh.order, 1, touched);
    double found = 0, total = 0;
    for (std::size_t node = 0; node < num_nodes; ++node) {
      if (touched[node] == 0) continue;
      ++found;
      for (int c = 0; c < 3; ++c) {
        if (faces_[f].components[c] && owner[3 * node + c] < 0) owner[3 * node + c] = f;
      }
    }
    MPI_Allreduce(&found, &total, 1, MPI_DOUBLE, MPI_SUM, mesh.comm);
    if (total == 0) {
      fail("boundary condition on face %" PetscInt_FMT
           ": the mesh has no face with this value in the label 'Face Sets'",
           faces_[f].face);
    }
  }
  std::vector<char> constrained(owner.size(), 0);
  for (std::size_t i = 0; i < owner.size(); ++i) {
    if (owner[i] < 0) continue;
    constrained[i] = 1;
    entries_.push_back({static_cast<PetscInt>(i), owner[i]});
  }
  mesh.constrain(constrained);
}

void BoundaryConditions::insert(double t, double t_from, double scale, std::span<double> local) const {
  const auto &at = mesh_.node_coordinates(mesh_.order);
  for (const auto &[index, f] : entries_) {
    const std::span<const double, 3> x(at.data() + 3 * (index / 3), 3);
    const int c = static_cast<int>(index % 3);
    local[index] = scale == 0 ? faces_[f].value(t, x)[c] : scale * faces_[f].increment(t_from, t, x)[c];
  }
}

}  // namespace hg
