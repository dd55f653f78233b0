// Where PETSc has its vectors on a device, a solver leaves them there. PETSc's functions that hand out arrays are taken
// over: they say that arrays are on the device, which the emulator cannot tell from the host's, and count the program's
// own calls for arrays on the host, each of which would be a copy. CeedGetTransfers() counts those of the library.
#include <ceed/backend.h>
#include <dlfcn.h>
#include <gtest/gtest.h>
#include <petscdm.h>

#include <algorithm>
#include <string>
#include <vector>

#include "solver_fixture.hpp"

namespace {

int host_calls = 0, device_calls = 0;
bool are_on_device = false;

/// PETSc's own function.
template <typename Function>
Function *own(const char *name) {
  return reinterpret_cast<Function *>(dlsym(RTLD_NEXT, name));
}

/// Whether the code that was called from `place` is this program's, not PETSc's: that works where its vectors are.
bool is_program(const void *place) {
  Dl_info caller{}, here{};
  dladdr(place, &caller);
  dladdr(reinterpret_cast<const void *>(&is_program), &here);
  return caller.dli_fbase == here.dli_fbase;
}

/// An array on the device, for the program; PETSc's own calls, which would go on to the device, get what is there.
PetscErrorCode on_device(const void *place, PetscErrorCode code, PetscMemType *type) {
  if (!are_on_device || !is_program(place)) return code;
  device_calls++;
  if (type != nullptr) *type = PETSC_MEMTYPE_CUDA;
  return code;
}
void on_host(const void *place) {
  if (are_on_device && is_program(place)) host_calls++;
}

}  // namespace

extern "C" {

PetscErrorCode VecGetArray(Vec vec, PetscScalar **array) {
  on_host(__builtin_return_address(0));
  return own<decltype(VecGetArray)>("VecGetArray")(vec, array);
}
PetscErrorCode VecGetArrayRead(Vec vec, const PetscScalar **array) {
  on_host(__builtin_return_address(0));
  return own<decltype(VecGetArrayRead)>("VecGetArrayRead")(vec, array);
}
PetscErrorCode VecGetArrayWrite(Vec vec, PetscScalar **array) {
  on_host(__builtin_return_address(0));
  return own<decltype(VecGetArrayWrite)>("VecGetArrayWrite")(vec, array);
}
PetscErrorCode VecGetArrayAndMemType(Vec vec, PetscScalar **array, PetscMemType *type) {
  return on_device(__builtin_return_address(0),
                   own<decltype(VecGetArrayAndMemType)>("VecGetArrayAndMemType")(vec, array, type), type);
}
PetscErrorCode VecGetArrayReadAndMemType(Vec vec, const PetscScalar **array, PetscMemType *type) {
  return on_device(__builtin_return_address(0),
                   own<decltype(VecGetArrayReadAndMemType)>("VecGetArrayReadAndMemType")(vec, array, type), type);
}
PetscErrorCode VecGetArrayWriteAndMemType(Vec vec, PetscScalar **array, PetscMemType *type) {
  return on_device(__builtin_return_address(0),
                   own<decltype(VecGetArrayWriteAndMemType)>("VecGetArrayWriteAndMemType")(vec, array, type), type);
}

}  // extern "C"

namespace hg::test {
namespace {

class DeviceVectors : public testing::TestWithParam<const char *> {
 protected:
  explicit DeviceVectors(const char *mat_type = "shell")
      : options{{"-bc_clamp", "1"}, {"-mat_type", mat_type}}, problem{"elasticity-linear", "2,2,2",   2, nullptr,
                                                                      PETSC_COMM_WORLD,    GetParam()} {}
  void SetUp() override {
    are_on_device = true;
    problem.solver->set_time(1);
    petsc_check(VecSet(problem.u, 0.01));
    petsc_check(VecDuplicate(problem.u, f.put()));
    // Half of the cells without material: their nodes have rows of the identity.
    std::vector<char> active(problem.mesh->num_cells, 1);
    for (std::size_t c = 0; c < active.size() / 2; c++) active[c] = 0;
    problem.solver->operators_changed(active);
    // What is made at the first use is made here.
    problem.solver->residual(problem.u, f);
    problem.solver->matrix().multiply(problem.u, f);
    problem.solver->matrix().diagonal(f);
    start_counting();
  }
  void TearDown() override { are_on_device = false; }

  void start_counting() {
    host_calls = device_calls = 0;
    ceed_check(CeedGetTransfers(problem.ceed, &before));
  }
  CeedSize transfers() const {
    CeedTransfers now{};
    ceed_check(CeedGetTransfers(problem.ceed, &now));
    return now.num_to_device - before.num_to_device + now.num_to_host - before.num_to_host;
  }
  void expect_no_copies() const {
    EXPECT_GT(device_calls, 0) << "nobody has asked for an array on the device";
    EXPECT_EQ(host_calls, 0) << "arrays on the host were asked for";
    EXPECT_EQ(transfers(), 0) << "the library has copied";
  }

  ScopedOptions options;
  Problem problem;
  VecHandle f;
  CeedTransfers before{};
};

TEST_P(DeviceVectors, StayThereInResiduals) {
  for (int i = 0; i < 3; i++) problem.solver->residual(problem.u, f);
  expect_no_copies();
}

TEST_P(DeviceVectors, StayThereInProducts) {
  for (int i = 0; i < 3; i++) problem.solver->matrix().multiply(problem.u, f);
  expect_no_copies();
}

TEST_P(DeviceVectors, StayThereInDiagonals) {
  for (int i = 0; i < 3; i++) problem.solver->matrix().diagonal(f);
  if (std::string(GetParam()).ends_with("ref")) {
    EXPECT_GT(transfers(), 0) << "in stages the host assembles";
  } else {
    expect_no_copies();
  }
}

class DeviceMatrices : public DeviceVectors {
 protected:
  DeviceMatrices() : DeviceVectors("aij") {}
  /// What is on the diagonal, with vectors on the host.
  std::vector<double> diagonal_on_host() {
    are_on_device = false;
    VecHandle d;
    petsc_check(MatCreateVecs(problem.solver->matrix().mat(), nullptr, d.put()));
    petsc_check(MatGetDiagonal(problem.solver->matrix().mat(), d));
    const PetscScalar *array = nullptr;
    PetscInt size = 0;
    petsc_check(VecGetLocalSize(d, &size));
    petsc_check(VecGetArrayRead(d, &array));
    std::vector<double> values(array, array + size);
    petsc_check(VecRestoreArrayRead(d, &array));
    return values;
  }
};

/// Entries are assembled there, and PETSc gets them from there, the ones of rows without material among them.
TEST_P(DeviceMatrices, GetTheirEntriesThere) {
  problem.solver->matrix().update();
  start_counting();
  for (int i = 0; i < 2; i++) problem.solver->matrix().update();
  if (std::string(GetParam()).ends_with("ref")) {
    EXPECT_GT(transfers(), 0) << "in stages the host assembles";
  } else {
    expect_no_copies();
  }
  const std::vector<double> on_device = diagonal_on_host();
  problem.solver->matrix().update();
  const std::vector<double> on_host = diagonal_on_host();
  problem.solver->operators_changed(std::vector<char>(problem.mesh->num_cells, 1));
  problem.solver->matrix().update();
  const std::vector<double> of_cells = diagonal_on_host();
  int num_ones = 0;
  for (std::size_t i = 0; i < on_host.size(); i++) {
    EXPECT_NEAR(on_device[i], on_host[i], 1e-13) << i;
    const double added = on_device[i] - of_cells[i];
    EXPECT_NEAR(added, added > 0.5 ? 1 : 0, 1e-13) << i;
    if (added > 0.5) num_ones++;
  }
  EXPECT_EQ(num_ones, 75);  // the unclamped nodes of the cells without material, but for those that others share
}

/// The checks see a copy where there is one.
TEST_P(DeviceVectors, AreSeenToBeCopied) {
  const PetscScalar *array = nullptr;
  petsc_check(VecGetArrayRead(problem.u, &array));
  petsc_check(VecRestoreArrayRead(problem.u, &array));
  EXPECT_EQ(host_calls, 1);
  CeedVectorHandle vec;
  const CeedScalar *values = nullptr;
  ceed_check(CeedVectorCreate(problem.ceed, 5, vec.put()));
  ceed_check(CeedVectorSetValue(vec, 1));
  ceed_check(CeedVectorGetArrayRead(vec, CEED_MEM_DEVICE, &values));
  ceed_check(CeedVectorRestoreArrayRead(vec, &values));
  ceed_check(CeedVectorGetArrayRead(vec, CEED_MEM_HOST, &values));
  ceed_check(CeedVectorRestoreArrayRead(vec, &values));
  EXPECT_EQ(transfers(), 1);
}

INSTANTIATE_TEST_SUITE_P(Backends, DeviceVectors, testing::Values("/gpu/emu/ref", "/gpu/emu/gen"),
                         [](const auto &info) { return std::string(info.param).substr(9); });
INSTANTIATE_TEST_SUITE_P(Backends, DeviceMatrices, testing::Values("/gpu/emu/ref", "/gpu/emu/gen"),
                         [](const auto &info) { return std::string(info.param).substr(9); });

}  // namespace
}  // namespace hg::test
