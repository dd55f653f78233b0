#include "swarm/swarm.hpp"

#include <cstring>
#include <type_traits>

#include "options/error.hpp"

namespace hg {
namespace {

struct FieldSpec {
  const char *name;
  std::size_t bytes;  // of one component
  PetscInt components;
};

constexpr FieldSpec kFields[] = {
    {field::x, sizeof(double), 3},
    {field::X0, sizeof(double), 3},
    {field::u, sizeof(double), 3},
    {field::v, sizeof(double), 3},
    {field::F, sizeof(double), 9},
    {field::V, sizeof(double), 1},
    {field::V0, sizeof(double), 1},
    {field::rho0, sizeof(double), 1},
    {field::material, sizeof(double), 2},
    {field::x_ref, sizeof(double), 3},
    {field::region, sizeof(std::int32_t), 1},
    {field::id, sizeof(std::int64_t), 1},
    {field::cell, sizeof(std::int32_t), 1},
};

}  // namespace

Swarm::Swarm(MPI_Comm comm) {
  petsc_check(DMCreate(comm, dm_.put()));
  petsc_check(DMSetType(dm_, DMSWARM));
  petsc_check(DMSetDimension(dm_, 3));
  petsc_check(PetscObjectSetName(reinterpret_cast<PetscObject>(dm_.get()), "points"));
  petsc_check(DMSwarmSetType(dm_, DMSWARM_BASIC));
  petsc_check(DMSwarmInitializeFieldRegister(dm_));
  for (const FieldSpec &f : kFields) {
    petsc_check(DMSwarmRegisterUserDatatypeField(dm_, f.name, f.bytes, f.components));
  }
  petsc_check(DMSwarmFinalizeFieldRegister(dm_));
  petsc_check(DMSwarmSetLocalSizes(dm_, 0, 0));
}

MPI_Comm Swarm::comm() const {
  return PetscObjectComm(reinterpret_cast<PetscObject>(dm_.get()));
}

PetscInt Swarm::local_size() const {
  PetscInt n = 0;
  petsc_check(DMSwarmGetLocalSize(dm_, &n));
  return n;
}

PetscInt Swarm::global_size() const {
  PetscInt n = 0;
  petsc_check(DMSwarmGetSize(dm_, &n));
  return n;
}

void Swarm::resize(PetscInt n) {
  petsc_check(DMSwarmSetLocalSizes(dm_, n, 0));
}

double Swarm::total_mass() const {
  double mine = 0.0, all = 0.0;
  {
    const PointField<double> rho0(*this, field::rho0), V0(*this, field::V0);
    for (std::size_t p = 0; p < V0.size(); p++) mine += rho0[p] * V0[p];
  }
  if (MPI_Allreduce(&mine, &all, 1, MPI_DOUBLE, MPI_SUM, comm()) != MPI_SUCCESS) fail("MPI_Allreduce failed");
  return all;
}

std::span<const PointFieldSpec> point_fields() {
  static const auto specs = [] {
    std::array<PointFieldSpec, std::size(kFields)> s;
    for (std::size_t i = 0; i < s.size(); i++) s[i] = {kFields[i].name, kFields[i].bytes, kFields[i].components};
    return s;
  }();
  return specs;
}

template <class T>
PointField<T>::PointField(DM dm, const char *name) : dm_(dm), name_(name) {
  const FieldSpec *spec = nullptr;
  for (const FieldSpec &f : kFields) {
    if (std::strcmp(f.name, name) == 0) spec = &f;
  }
  if (!spec) fail("material points have no field '%s'", name);
  // Only the two sizes of integers and doubles occur; x and id differ by type though not by size.
  const bool integer = spec->name == field::region || spec->name == field::id || spec->name == field::cell;
  if (spec->bytes != sizeof(T) || integer != std::is_integral_v<T>) {
    fail("field '%s' of the material points has %s of %d bytes, not the type asked for", name,
         integer ? "integers" : "reals", static_cast<int>(spec->bytes));
  }
  void *data = nullptr;
  PetscInt n = 0;
  PetscDataType type;
  petsc_check(DMSwarmGetField(dm_, name_, &components_, &type, &data));
  data_ = static_cast<T *>(data);
  if (const PetscErrorCode code = DMSwarmGetLocalSize(dm_, &n)) {
    (void)DMSwarmRestoreField(dm_, name_, nullptr, nullptr, &data);
    petsc_check(code);
  }
  size_ = static_cast<std::size_t>(n) * static_cast<std::size_t>(components_);
}

template <class T>
PointField<T>::~PointField() {
  void *data = data_;
  (void)DMSwarmRestoreField(dm_, name_, nullptr, nullptr, &data);
}

template class PointField<double>;
template class PointField<std::int32_t>;
template class PointField<std::int64_t>;

}  // namespace hg
