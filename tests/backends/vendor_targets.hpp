/// @file
/// The compilers for devices that need not be there.
#pragma once

#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <vector>

#include "backends/cuda/vendor.hpp"
#include "backends/gpu/vendor.hpp"
#include "backends/hip/vendor.hpp"

namespace hg::test {

/// A kind of device, and how its compiler is told. (HIP's ends the process for architectures that it does not know.)
struct Target {
  const char *name;
  const gpu::Vendor &vendor;
  std::vector<std::string> options;
  int warp_size;
  std::size_t shared_bytes;  ///< of a block, at most
};

inline const std::vector<Target> &targets() {
  static const std::vector<Target> all{
      {"sm_80",
       cuda::vendor,
       {"--gpu-architecture=sm_80", "--std=c++17", "-default-device", "--ptxas-options=-v"},
       32,
       163 << 10},
      {"sm_90",
       cuda::vendor,
       {"--gpu-architecture=sm_90", "--std=c++17", "-default-device", "--ptxas-options=-v"},
       32,
       227 << 10},
      {"gfx90a", hip::vendor, {"--offload-arch=gfx90a", "-std=c++17", "-O3"}, 64, 64 << 10}};
  return all;
}

/// Has a target's compiler, or is skipped.
class VendorTest : public testing::TestWithParam<int> {
 public:
  static auto all() { return testing::Range(0, static_cast<int>(targets().size())); }
  static std::string name_of(const testing::TestParamInfo<int> &info) { return targets()[info.param].name; }

 protected:
  void SetUp() override {
    try {
      const gpu::VendorLibrary library(target().vendor.compiler_files);
    } catch (const gpu::DeviceError &error) {
      GTEST_SKIP() << target().vendor.name << "'s compiler: " << error.what();
    }
    compiler.emplace(target().vendor);  // which has all that is called
  }
  static const Target &target() { return targets()[static_cast<std::size_t>(GetParam())]; }
  void compiles(const std::string &name, const std::string &text, std::string *log = nullptr) const {
    SCOPED_TRACE(name);
    EXPECT_FALSE(compiler->compile(name, text, target().options, log).empty());
  }

  std::optional<gpu::VendorCompiler> compiler;
};

}  // namespace hg::test
