// What the vendors' driver asks of their libraries, here of a fake: it runs no kernel.
#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "backends/cuda/vendor.hpp"
#include "backends/gpu/vendor.hpp"
#include "backends/hip/vendor.hpp"
#include "fake_vendors.hpp"
#include "support/program.hpp"

namespace {

using namespace hg;

constexpr const char *fake_files[] = {HG_FAKE_VENDORS};
constexpr const char *missing_files[] = {"/nowhere/libcuda.so.1", "/nowhere/libcuda.so"};

/// By the vendor's name.
class DriverTest : public testing::TestWithParam<std::string> {
 protected:
  DriverTest() {
    fake = {};
    vendor.driver_files = vendor.compiler_files = fake_files;
  }
  std::string error_of(int device) {
    try {
      gpu::make_driver(vendor, device);
      return "";
    } catch (const gpu::DeviceError &error) {
      return error.what();
    }
  }

  const bool is_cuda = GetParam() == cuda::vendor.name;
  gpu::Vendor vendor = is_cuda ? cuda::vendor : hip::vendor;
};

TEST_P(DriverTest, TakesTheDeviceThatIsCurrent) {
  fake.current = 1;
  const auto driver = gpu::make_driver(vendor, gpu::current_device);
  EXPECT_EQ(driver->properties().number, 1);
  EXPECT_EQ(driver->properties().name, "fake 1");
}

TEST_P(DriverTest, TakesTheFirstDeviceWhereNoneIsCurrent) {
  const auto driver = gpu::make_driver(vendor, gpu::current_device);
  EXPECT_EQ(driver->properties().number, 0);
}

TEST_P(DriverTest, TakesTheDeviceThatIsNamed) {
  fake.current = 1;
  EXPECT_EQ(gpu::make_driver(vendor, 0)->properties().number, 0);
}

TEST_P(DriverTest, RefusesADeviceThatIsNotThere) {
  const std::string error = error_of(2);
  EXPECT_NE(error.find("device_id=2"), std::string::npos) << error;
  EXPECT_NE(error.find("expected 0 to 1"), std::string::npos) << error;
}

TEST_P(DriverTest, IsScoredWithoutAContext) {
  const char *reason = nullptr;
  EXPECT_EQ(gpu::score_of(vendor, &reason), 1) << reason;
  EXPECT_EQ(fake.num_retained, 0);
}

TEST_P(DriverTest, ScoresNothingWithoutALibrary) {
  const char *reason = "";
  vendor.driver_files = missing_files;
  EXPECT_EQ(gpu::score_of(vendor, &reason), 0);
  EXPECT_NE(std::string(reason).find("/nowhere/libcuda.so.1"), std::string::npos) << reason;
  vendor.driver_files = fake_files;
  vendor.compiler_files = missing_files;
  EXPECT_EQ(gpu::score_of(vendor, &reason), 0);
}

TEST_P(DriverTest, MakesItsDeviceCurrentForEachCall) {
  const auto first = gpu::make_driver(vendor, 0), second = gpu::make_driver(vendor, 1);
  void *on_first = first->allocate(8);
  EXPECT_EQ(fake.current, 0);
  void *on_second = second->allocate(8);
  EXPECT_EQ(fake.current, 1);
  first->free(on_first);
  EXPECT_EQ(fake.current, 0);
  second->free(on_second);
  EXPECT_EQ(fake.current, 1);
  const auto module = first->compile("nothing", "");
  EXPECT_EQ(fake.current, 0);
}

TEST_P(DriverTest, SaysThatMemoryIsShort) {
  const auto driver = gpu::make_driver(vendor, 0);
  fake.is_full = true;
  try {
    driver->allocate(8000);
    FAIL() << "there was memory";
  } catch (const gpu::DeviceError &error) {
    EXPECT_STREQ(error.what(), "Out of memory: 'fake 0' has no room for 8000 bytes");
  }
}

TEST_P(DriverTest, CountsWhatIsCopied) {
  const auto driver = gpu::make_driver(vendor, 0);
  std::array<double, 3> from{1, 2, 3}, to{};
  void *memory = driver->allocate(sizeof from);
  driver->copy_to_device(memory, from.data(), sizeof from);
  driver->copy_to_host(to.data(), memory, sizeof to);
  driver->copy_to_host(to.data(), memory, 0);
  driver->free(memory);
  EXPECT_EQ(to, from);
  const CeedTransfers transfers = driver->transfers();
  EXPECT_EQ(transfers.num_to_device, 1);
  EXPECT_EQ(transfers.bytes_to_device, 24);
  EXPECT_EQ(transfers.num_to_host, 1);
  EXPECT_EQ(transfers.bytes_to_host, 24);
}

/// On the device: the host goes on.
TEST_P(DriverTest, LetsAStreamWaitForTheOneBefore) {
  using Waits = std::vector<std::pair<void *, void *>>;
  int one = 0, other = 0;
  {
    const auto driver = gpu::make_driver(vendor, 0);
    driver->set_stream(&one);
    EXPECT_EQ(fake.waits, (Waits{{&one, nullptr}}));
    driver->set_stream(&one);
    driver->set_stream(&other);
    EXPECT_EQ(fake.waits, (Waits{{&one, nullptr}, {&other, &one}}));
    EXPECT_EQ(fake.num_events, 1);
    EXPECT_TRUE(fake.waited_for.empty());
  }
  EXPECT_EQ(fake.num_events, 0);
}

TEST_P(DriverTest, WorksOnItsStream) {
  const auto driver = gpu::make_driver(vendor, 0);
  const auto module = driver->compile("nothing", "");
  int stream = 0;
  driver->set_stream(&stream);
  double values[2] = {};
  driver->copy_to_device(&values[0], &values[1], sizeof(double));
  driver->copy_to_host(&values[0], &values[1], sizeof(double));
  driver->copy(&values[0], &values[1], sizeof(double));
  driver->clear(values, sizeof(double));
  const int job = 0;
  driver->launch(module->kernel("f"), {.num_blocks = 1, .num_threads = 32}, &job, sizeof job);
  EXPECT_EQ(fake.worked_on, std::vector<void *>(5, &stream));
  EXPECT_EQ(fake.waited_for, std::vector<void *>(2, &stream));  // for what came from or went to the host
}

TEST_P(DriverTest, ClearsMemory) {
  const auto driver = gpu::make_driver(vendor, 0);
  std::array<double, 3> values{1, 2, 3};
  driver->clear(values.data(), 2 * sizeof(double));
  driver->clear(&values[2], 0);
  EXPECT_EQ(values, (std::array<double, 3>{0, 0, 3}));
}

TEST_P(DriverTest, RefusesMoreBlocksThanAGridHas) {
  const auto driver = gpu::make_driver(vendor, 0);
  const auto module = driver->compile("nothing", "");
  const int job = 0;
  const std::uint64_t most = 2147483647;
  driver->launch(module->kernel("f"), {.num_blocks = most, .num_threads = 32}, &job, sizeof job);
  try {
    driver->launch(module->kernel("f"), {.num_blocks = most + 1, .num_threads = 32}, &job, sizeof job);
    FAIL() << "it was launched";
  } catch (const gpu::DeviceError &error) {
    EXPECT_EQ(error.what(), GetParam() + ": 'nothing' is launched with 2147483648 blocks; expected 2147483647 at most");
  }
}

TEST_P(DriverTest, LaunchesKernelsOfTheUsers) {
  const auto driver = gpu::make_driver(vendor, 1);
  EXPECT_EQ(driver->properties().user_kernels, is_cuda ? gpu::UserKernels::cuda : gpu::UserKernels::hip);
  int context = 0, stream = 0;
  CeedScalar in = 0, out = 0;
  gpu::UserFields fields;
  fields.inputs[0] = &in;
  fields.outputs[0] = &out;
  driver->set_stream(&stream);
  driver->launch_user(&fake.user_kernel, &context, 0, fields);
  EXPECT_EQ(fake.num_launched, 0);
  driver->launch_user(&fake.user_kernel, &context, 257, fields);
  EXPECT_EQ(fake.current, 1);
  const FakeVendors::UserCall &call = fake.user_call;
  EXPECT_EQ(call.context, &context);
  EXPECT_EQ(call.Q, 257);
  EXPECT_EQ(call.first_input, &in);
  EXPECT_EQ(call.first_output, &out);
  EXPECT_EQ(call.num_blocks, 2U);
  EXPECT_EQ(call.num_threads, 256U);
  EXPECT_EQ(call.stream, &stream);
}

/// Calls of kernels that are launched as one.
class GraphTest : public DriverTest {
 protected:
  static gpu::Call call(gpu::Kernel kernel, int job, std::uint64_t num_blocks, std::size_t shared_bytes = 0) {
    gpu::Call made{.kernel = kernel,
                   .launch = {.num_blocks = num_blocks, .num_threads = 96, .shared_bytes = shared_bytes},
                   .job = std::vector<std::byte>(sizeof job)};
    std::memcpy(made.job.data(), &job, sizeof job);
    return made;
  }
  static FakeVendors::Called called(gpu::Kernel kernel, int job, unsigned num_blocks, unsigned shared_bytes = 0,
                                    void *stream = nullptr) {
    return {kernel.handle, job, num_blocks, 96, shared_bytes, stream};
  }

  const std::shared_ptr<gpu::Driver> driver = gpu::make_driver(vendor, 1);
  const std::unique_ptr<gpu::Module> module = driver->compile("nothing", "");
  const gpu::Kernel f = module->kernel("f"), g = module->kernel("g");
};

/// It is kept as long as the same kernels are called; jobs may be others each time.
TEST_P(GraphTest, IsKept) {
  int stream = 0;
  {
    const auto calls = driver->make_calls();
    calls->launch(std::vector{call(f, 1, 5), call(g, 2, 6)});
    calls->launch(std::vector{call(f, 1, 5), call(g, 2, 6)});
    EXPECT_EQ(fake.num_changed, 0);
    calls->launch(std::vector{call(f, 1, 5), call(g, 3, 6)});
    driver->set_stream(&stream);
    calls->launch(std::vector{call(f, 1, 4), call(g, 3, 6, 50000)});
    EXPECT_EQ(fake.num_changed, 3);
    EXPECT_EQ(fake.num_made, 1);
    EXPECT_EQ(fake.allowed, is_cuda ? std::vector<int>{50000} : std::vector<int>{});  // HIP does not ask
    EXPECT_EQ(fake.called,
              (std::vector{called(f, 1, 5), called(g, 2, 6), called(f, 1, 5), called(g, 2, 6), called(f, 1, 5),
                           called(g, 3, 6), called(f, 1, 4, 0, &stream), called(g, 3, 6, 50000, &stream)}));
    EXPECT_GT(calls->num_bytes(), 0U);
  }
  EXPECT_EQ(fake.num_graphs, 0);
  EXPECT_EQ(fake.num_executables, 0);
  EXPECT_EQ(fake.current, 1);
  EXPECT_EQ(fake.num_launched, 0);
}

TEST_P(GraphTest, IsMadeAnewForOtherKernels) {
  const auto calls = driver->make_calls();
  calls->launch(std::vector{call(f, 1, 5), call(g, 2, 6)});
  calls->launch(std::vector{call(g, 1, 5), call(f, 2, 6)});
  calls->launch(std::vector{call(f, 7, 1)});
  EXPECT_EQ(fake.num_made, 3);
  EXPECT_EQ(fake.num_graphs, 1);
  EXPECT_EQ(fake.called,
            (std::vector{called(f, 1, 5), called(g, 2, 6), called(g, 1, 5), called(f, 2, 6), called(f, 7, 1)}));
}

/// A module that has gone may have left its kernel's handle to another one.
TEST_P(GraphTest, IsMadeAnewForANewKernelWithAnOldHandle) {
  const auto calls = driver->make_calls();
  fake.reuses_functions = true;
  const gpu::Kernel other = driver->compile("nothing", "")->kernel("g");
  ASSERT_EQ(other.handle, g.handle);
  calls->launch(std::vector{call(f, 1, 5), call(g, 2, 6)});
  calls->launch(std::vector{call(f, 1, 5), call(other, 2, 6)});
  EXPECT_EQ(fake.num_made, 2);
}

TEST_P(GraphTest, IsThereAfterAFailure) {
  const auto calls = driver->make_calls();
  EXPECT_THROW(calls->launch(std::vector{call(f, 7, std::uint64_t{1} << 31)}), gpu::DeviceError);
  calls->launch(std::vector{call(f, 1, 5)});
  fake.refused_changes = 1;
  EXPECT_THROW(calls->launch(std::vector{call(f, 2, 5)}), gpu::DeviceError);
  calls->launch(std::vector{call(f, 2, 5)});
  EXPECT_EQ(fake.called, (std::vector{called(f, 1, 5), called(f, 2, 5)}));
}

/// Of a module's kernels, by ROCm 5.2, or for want of memory. It is not asked again for the same kernels.
TEST_P(GraphTest, IsDoneWithoutWhereItIsRefused) {
  for (int *refused : {&fake.refused_nodes, &fake.refused_graphs}) {
    const auto calls = driver->make_calls();
    fake.num_launched = 0;
    *refused = 1;
    calls->launch(std::vector{call(f, 1, 5), call(g, 2, 6)});
    calls->launch(std::vector{call(f, 1, 5), call(g, 3, 6)});
    EXPECT_EQ(fake.num_launched, 4);
    EXPECT_TRUE(fake.called.empty());
    calls->launch(std::vector{call(g, 1, 5)});
    EXPECT_EQ(fake.num_launched, 4);
    EXPECT_EQ(fake.called, std::vector{called(g, 1, 5)});
    fake.called.clear();
  }
  EXPECT_EQ(fake.num_graphs, 0);
  EXPECT_EQ(fake.num_executables, 0);
}

/// A driver that is older than the compiler need not have all calls.
TEST_P(GraphTest, IsDoneWithoutWhereTheDriverHasNone) {
  constexpr const char *names[] = {"cuGraphCreate", "cuGraphOfTomorrow", "c", "d", "e", "f", "g"};
  vendor.graph_names = names;
  driver->make_calls()->launch(std::vector{call(f, 1, 5), call(g, 2, 6)});
  EXPECT_EQ(fake.num_launched, 2);
}

TEST_P(DriverTest, FindsItsCodeAgain) {
  const test::EmptyCache cache;
  for (int device : {0, 1}) gpu::make_driver(vendor, device)->compile("a text", "// some text");
  EXPECT_EQ(fake.num_compiled, is_cuda ? 1 : 2);  // of one architecture, where options name it; else by devices' names
}

/// What is in the cache for a device of the same name need not be of its architecture, where options do not name it.
TEST_P(DriverTest, CompilesAgainWhatDoesNotLoad) {
  const test::EmptyCache cache;
  vendor.options_have_architecture = false;
  const auto driver = gpu::make_driver(vendor, 0);
  driver->compile("a text", "// some text");
  EXPECT_EQ(fake.num_compiled, 1);
  fake.refused_loads = 1;
  driver->compile("a text", "// some text");
  EXPECT_EQ(fake.num_compiled, 2);
  driver->compile("a text", "// some text");
  EXPECT_EQ(fake.num_compiled, 2);  // what was made last is what is kept
  fake.refused_loads = 2;
  try {
    driver->compile("a text", "// some text");
    FAIL() << "it was loaded";
  } catch (const gpu::DeviceError &error) {
    EXPECT_NE(std::string(error.what()).find("'a text' cannot be loaded"), std::string::npos) << error.what();
  }
}

INSTANTIATE_TEST_SUITE_P(Vendors, DriverTest, testing::Values(cuda::vendor.name, hip::vendor.name),
                         [](const auto &info) { return info.param; });
INSTANTIATE_TEST_SUITE_P(Vendors, GraphTest, testing::Values(cuda::vendor.name, hip::vendor.name),
                         [](const auto &info) { return info.param; });

}  // namespace
