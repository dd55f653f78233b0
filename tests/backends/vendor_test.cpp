// All that is compiled for devices, by the vendors' compilers where they are installed, for devices that need not be
// there.
#include <ceed.h>
#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <vector>

#include "backends/cuda/vendor.hpp"
#include "backends/gpu/qfunction.hpp"
#include "backends/gpu/texts.hpp"
#include "backends/gpu/vendor.hpp"
#include "backends/hip/vendor.hpp"
#include "support/errors.hpp"
#include "support/handles.hpp"

namespace {

using namespace hg;
using test::ok;

/// A kind of device, and how its compiler is told. (HIP's ends the process for architectures that it does not know.)
struct Target {
  const char *name;
  const gpu::Vendor &vendor;
  std::vector<std::string> options;
};

const std::vector<Target> &targets() {
  static const std::vector<Target> all{
      {"sm_80", cuda::vendor, {"--gpu-architecture=sm_80", "--std=c++17", "-default-device", "--ptxas-options=-v"}},
      {"sm_90", cuda::vendor, {"--gpu-architecture=sm_90", "--std=c++17", "-default-device", "--ptxas-options=-v"}},
      {"gfx90a", hip::vendor, {"--offload-arch=gfx90a", "-std=c++17", "-O3"}}};
  return all;
}

class VendorTest : public testing::TestWithParam<int> {
 protected:
  void SetUp() override {
    try {
      compiler.emplace(target().vendor);
    } catch (const gpu::DeviceError &error) {
      GTEST_SKIP() << target().vendor.name << "'s compiler: " << error.what();
    }
  }
  static const Target &target() { return targets()[static_cast<std::size_t>(GetParam())]; }
  void compiles(const std::string &name, const std::string &text) const {
    SCOPED_TRACE(name);
    EXPECT_FALSE(compiler->compile(name, text, target().options).empty());
  }

  std::optional<gpu::VendorCompiler> compiler;
};

TEST_P(VendorTest, CompilesTheLibrary) {
  compiles("library", gpu::library_text());
}

TEST_P(VendorTest, CompilesTheGallery) {
  const test::CeedHandle ceed(test::open("/cpu/self/ref"));
  for (const char *name :
       {"Mass1DBuild", "Mass2DBuild", "Mass3DBuild", "MassApply", "Vector3MassApply", "Poisson1DApply",
        "Poisson1DBuild", "Poisson2DApply", "Poisson2DBuild", "Poisson3DApply", "Poisson3DBuild",
        "Vector3Poisson1DApply", "Vector3Poisson2DApply", "Vector3Poisson3DApply", "Scale"}) {
    test::QFunction qf;
    ok(CeedQFunctionCreateInteriorByName(ceed, name, qf.out()));
    compiles(name, gpu::kernel_text(qf));
  }
}

/// A QFunction of a file below qfunctions/, with fields of these sizes.
struct Function {
  const char *place;
  std::vector<CeedInt> inputs, outputs;
};

/// What the bake-off problems and the mechanics layer compile. Fields of materials are as large as the largest.
const std::vector<Function> &functions() {
  static const std::vector<Function> all{
      {"bps/mass.h:BPMassSetup", {9, 1}, {1}},
      {"bps/mass.h:BPMassApply", {1, 1}, {1}},
      {"bps/mass.h:BPMassApply3", {3, 1}, {3}},
      {"bps/poisson.h:BPPoissonSetup", {9, 1}, {6}},
      {"bps/poisson.h:BPPoissonApply", {3, 6}, {3}},
      {"bps/poisson.h:BPPoissonApply3", {9, 6}, {9}},
      {"bps/manufactured.h:BPError", {3, 9, 3, 9, 1}, {4}},
      {"materials/linear.h:HgLinearResidual", {16, 16, 16}, {16, 16}},
      {"materials/linear.h:HgLinearJacobian", {16, 16, 16}, {16, 16}},
      {"materials/linear.h:HgLinearEnergy", {16, 16, 16}, {16, 16}},
      {"materials/neo_hookean.h:HgNeoHookeanEnergy", {16, 16, 16}, {16, 16}},
      {"materials/neo_hookean_initial.h:HgNeoHookeanInitialResidual", {16, 16, 16}, {16, 24}},
      {"materials/neo_hookean_initial.h:HgNeoHookeanInitialJacobian", {16, 24, 16}, {16, 16}},
      {"materials/neo_hookean_current.h:HgNeoHookeanCurrentResidual", {16, 16, 16}, {16, 24}},
      {"materials/neo_hookean_current.h:HgNeoHookeanCurrentJacobian", {16, 24, 16}, {16, 16}},
      {"mpm/geometry_points.h:HgGeometryPoints", {16, 16}, {16}},
      {"mpm/point_update.h:HgPointUpdate", {16, 16, 16, 16, 16}, {16, 16, 16, 16}},
      {"bc/body_force.h:HgBodyForce", {16, 16}, {16}}};
  return all;
}

TEST_P(VendorTest, CompilesWhatTheProgramsUse) {
  const test::CeedHandle ceed(test::open("/cpu/self/ref"));
  const CeedQFunctionUser never = [](void *, CeedInt, const CeedScalar *const *, CeedScalar *const *) { return 1; };
  for (const Function &function : functions()) {
    const std::string place = std::string(HG_QFUNCTIONS) + '/' + function.place;
    test::QFunction qf;
    ok(CeedQFunctionCreateInterior(ceed, 1, never, place.c_str(), qf.out()));
    const auto add = [&](const std::vector<CeedInt> &sizes, const std::string &name, auto &&add_field) {
      for (const CeedInt &size : sizes) {
        const std::string numbered = name + std::to_string(&size - sizes.data());
        ok(add_field(qf, numbered.c_str(), size, CEED_EVAL_NONE));
      }
    };
    add(function.inputs, "in", CeedQFunctionAddInput);
    add(function.outputs, "out", CeedQFunctionAddOutput);
    compiles(function.place, gpu::kernel_text(qf));
  }
}

/// The message has the user's own file and line.
TEST_P(VendorTest, SaysWhatIsWrongWithAText) {
  try {
    compiler->compile("a text", gpu::first_text() + "#line 7 \"own.h\"\nHG_DEVICE int f() { return nothing; }\n",
                      target().options);
    FAIL() << "it was compiled";
  } catch (const gpu::DeviceError &error) {
    const std::string message = error.what();
    EXPECT_NE(message.find("own.h"), std::string::npos) << message;
    EXPECT_NE(message.find("nothing"), std::string::npos) << message;
  }
}

INSTANTIATE_TEST_SUITE_P(Targets, VendorTest, testing::Range(0, static_cast<int>(targets().size())),
                         [](const auto &info) { return std::string(targets()[info.param].name); });

}  // namespace
