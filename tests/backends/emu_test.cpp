// The emulator finds what a device may hide, in kernels that have the faults.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <numeric>
#include <string>
#include <vector>

#include "backends/emu/emulator.hpp"

namespace {

using namespace hg;

constexpr std::uint64_t num_blocks = 3;

/// What the kernels below get.
struct Job {
  const double *x;
  double *y;
};
const char *const job_text = "struct Job { const double *x; double *y; };\nusing namespace hg::gpu;\n";

class EmulatorTest : public testing::TestWithParam<const char *> {
 protected:
  explicit EmulatorTest(int num_threads = 8) : num_threads(num_threads), length(num_threads * num_blocks) {}
  /// Runs a kernel with this body on x = 0, 1, ...; y. Each thread has a word of shared memory, or there are so many.
  std::vector<double> run(const std::string &body, std::size_t num_shared = 0, bool has_barriers = true) {
    if (num_shared == 0) num_shared = num_threads;
    emu::Emulator device(emu::parse(GetParam()));
    std::vector<double> x(length), y(length, -1);
    std::iota(x.begin(), x.end(), 0.0);
    auto *on_device = static_cast<double *>(device.allocate(2 * length * sizeof(double)));
    device.copy_to_device(on_device, x.data(), length * sizeof(double));
    device.copy_to_device(on_device + length, y.data(), length * sizeof(double));
    const auto module = device.compile("test", job_text + ("HG_KERNEL(test, Job) {" + body + "}"));
    const Job job{on_device, on_device + length};
    try {
      device.launch(module->kernel("test"),
                    {.num_blocks = num_blocks,
                     .num_threads = num_threads,
                     .shared_bytes = num_shared * sizeof(double),
                     .has_barriers = has_barriers},
                    &job, sizeof job);
    } catch (...) {
      device.free(on_device);
      throw;
    }
    device.copy_to_host(y.data(), on_device + length, length * sizeof(double));
    device.free(on_device);
    return y;
  }
  /// The message with which it is refused.
  std::string error_of(const std::string &body, std::size_t num_shared = 0, bool has_barriers = true) {
    try {
      run(body, num_shared, has_barriers);
    } catch (const gpu::DeviceError &error) {
      return error.what();
    }
    return "no error";
  }
  static void expect_names(const std::string &message, const std::string &words) {
    EXPECT_NE(message.find(words), std::string::npos) << message;
    EXPECT_NE(message.find("'test'"), std::string::npos) << message;
  }

  const int num_threads;
  const std::size_t length;
};

TEST_P(EmulatorTest, ThreadsExchangeValuesThroughSharedMemory) {
  const auto y =
      run("HG_SHARED(s); s[thread()] = job.x[index()]; barrier();"
          "const double other = s[num_threads() - 1 - thread()]; barrier();"
          "s[thread()] = other; barrier(); s[thread()] += 100; barrier(); job.y[index()] = s[thread()];");
  for (std::size_t i = 0; i < length; i++) {
    const std::size_t block = i / num_threads, thread = i % num_threads;
    EXPECT_EQ(y[i], 100 + static_cast<double>(block * num_threads + num_threads - 1 - thread));
  }
}

TEST_P(EmulatorTest, FindsAMissingBarrier) {
  const std::string message =
      error_of("HG_SHARED(s); s[thread()] = job.x[index()]; job.y[index()] = s[(thread() + 1) % num_threads()];");
  const bool is_found = message.find("reads shared memory that was not written") != std::string::npos ||
                        message.find("reads what another thread has written") != std::string::npos;
  EXPECT_TRUE(is_found) << message;
}

/// Every thread reads what was there before, and whether it is there still is a matter of luck.
TEST_P(EmulatorTest, FindsAMissingBarrierBeforeAWrite) {
  expect_names(error_of("HG_SHARED(s); s[thread()] = 1; barrier();"
                        "const double sum = s[0] + s[1]; s[thread()] = sum; barrier(); job.y[index()] = s[0];"),
               "since the last barrier");
}

TEST_P(EmulatorTest, FindsWhatIsReadBeforeItIsWritten) {
  expect_names(error_of("HG_SHARED(s); if (thread() > 0) s[thread()] = 1; barrier(); job.y[index()] = s[0];"),
               "reads shared memory that was not written: word 0 of 8");
}

TEST_P(EmulatorTest, ForgetsSharedMemoryBetweenBlocks) {
  expect_names(error_of("HG_SHARED(s); if (block() != 1) s[thread()] = 1; barrier(); job.y[index()] = s[thread()];"),
               "reads shared memory that was not written");
}

TEST_P(EmulatorTest, FindsWhatIsOutsideOfSharedMemory) {
  expect_names(error_of("HG_SHARED(s); s[thread() + 1] = 1;"), "is outside of shared memory: word 8 of 8");
  expect_names(error_of("HG_SHARED(s); s[thread() - 1] = 1;"), "is outside of shared memory: word -1 of 8");
}

/// Devices refuse it.
TEST_P(EmulatorTest, FindsAPairAtAnOddPlace) {
  const std::string message = "takes for a pair what begins at an odd word: word 3 of 8";
  expect_names(error_of("HG_SHARED(s); if (thread() == 1) write_pair(s + 1, 2, {1, 2});"), message);
  expect_names(error_of("HG_SHARED(s); if (thread() == 1) write_pair(s, 2, {1, 2}); barrier();"
                        "if (thread() == 1) job.y[index()] = read_pair(s, 3).first;"),
               message);
}

TEST_P(EmulatorTest, FindsARace) {
  expect_names(error_of("HG_SHARED(s); s[thread() / 2] = thread(); barrier(); job.y[index()] = s[0];"),
               "writes what another thread has written since the last barrier");
}

TEST_P(EmulatorTest, FindsABarrierThatNotAllComeTo) {
  expect_names(error_of("if (thread() != 3) barrier(); job.y[index()] = 1;"),
               "waits at a barrier that thread 3 does not come to");
  expect_names(error_of("barrier();", num_threads, false), "has a barrier, and was said to have none");
}

/// Several warps in a block.
class WarpTest : public EmulatorTest {
 protected:
  WarpTest() : EmulatorTest(128) {}

  const int warp_size = emu::Emulator(emu::parse(GetParam())).properties().warp_size;
};

TEST_P(WarpTest, ThreadsOfAWarpExchangeValues) {
  const auto y =
      run("double values[2] = {job.x[index()], 1000 + job.x[index()]}; exchange<2>(values, 5);"
          "exchange<1>(values, 16); job.y[index()] = values[0] + values[1];");
  for (std::size_t i = 0; i < length; i++) {
    EXPECT_EQ(y[i], static_cast<double>(((i ^ 16) ^ 5) + (1000 + (i ^ 5)))) << i;
  }
}

TEST_P(WarpTest, FindsAnExchangeThatNotAllComeTo) {
  expect_names(error_of("double v = 1; if (thread() % 4 != 3) exchange<1>(&v, 1); job.y[index()] = v;"),
               "waits at a barrier of its warp that thread ");
  expect_names(error_of("double v = 1; if (thread() % 4 != 3) { exchange<1>(&v, 1); } else { warp_barrier(); }"),
               "exchanges 1 values with thread ");
  expect_names(error_of("double v[2] = {}; if (thread() % 2) { exchange<1>(v, 1); } else { exchange<2>(v, 1); }"),
               "values with thread ");
}

/// On a device it orders nothing in memory.
TEST_P(WarpTest, ExchangesAreNoBarriers) {
  expect_names(error_of("HG_SHARED(s); double v = 1; s[thread()] = 1; exchange<1>(&v, 1);"
                        "job.y[index()] = s[thread() ^ 1];"),
               "reads what another thread has written since the last barrier");
}

TEST_P(WarpTest, FindsAnExchangeWithAnotherWarp) {
  expect_names(error_of("double v = 1; exchange<1>(&v, 64); job.y[index()] = v;"), "which is not of its warp");
}

/// One warp may be beyond its barrier while another one has not come to its own.
TEST_P(WarpTest, ThreadsOfAWarpWaitForEachOther) {
  const std::string warp = std::to_string(warp_size);
  const auto y =
      run("HG_SHARED(s); s[thread()] = job.x[index()]; for (int i = 0; i < 3 + thread() / " + warp +
          "; i++) { warp_barrier(); const double other = s[thread() ^ 1]; warp_barrier(); s[thread()] = other; }"
          "job.y[index()] = s[thread()];");
  for (std::size_t i = 0; i < length; i++) {
    const std::size_t turns = 3 + i % num_threads / static_cast<std::size_t>(warp_size);
    EXPECT_EQ(y[i], static_cast<double>(turns % 2 == 0 ? i : i ^ 1)) << i;
  }
}

TEST_P(WarpTest, FindsAMissingBarrierOfAWarp) {
  expect_names(error_of("HG_SHARED(s); s[thread()] = 1; warp_barrier(); const double other = s[thread() ^ 1];"
                        "s[thread()] = other; warp_barrier(); job.y[index()] = s[thread()];"),
               "since the last barrier");
}

TEST_P(WarpTest, FindsABarrierOfAWarpWhereThatOfABlockIsWanted) {
  const std::string next = "s[(thread() + " + std::to_string(warp_size) + ") % num_threads()]";
  const std::string read = error_of("HG_SHARED(s); s[thread()] = 1; warp_barrier(); job.y[index()] = " + next + ";");
  const bool is_found = read.find("reads shared memory that was not written") != std::string::npos ||
                        read.find("reads what another thread has written") != std::string::npos;
  EXPECT_TRUE(is_found) << read;
  expect_names(error_of("HG_SHARED(s); s[thread()] = 1; barrier(); const double other = " + next +
                        "; warp_barrier(); s[thread()] = other; barrier(); job.y[index()] = s[thread()];"),
               "since the last barrier");
}

/// What several warps have read is not forgotten when one of them reads it again.
TEST_P(WarpTest, RemembersReadersOfSeveralWarps) {
  expect_names(error_of("HG_SHARED(s); s[thread()] = 1; barrier(); double sum = s[0]; warp_barrier(); sum += s[0];"
                        "warp_barrier(); if (thread() == 0) s[0] = sum; barrier(); job.y[index()] = s[0];"),
               "writes what another thread has read since the last barrier");
}

TEST_P(WarpTest, FindsAWarpThatDoesNotComeToABarrierOfAll) {
  expect_names(error_of("if (thread() < " + std::to_string(warp_size) + ") { barrier(); } else { warp_barrier(); }"),
               "waits at a barrier that thread ");
}

/// Threads run one after another, so that a counter shows their order.
TEST_P(EmulatorTest, RunsThreadsInItsOrder) {
  const auto y =
      run("double &count = job.y[block() * num_threads()]; if (thread() == 0) count = 0; barrier();"
          "const double mine = count++; barrier(); job.y[index()] = mine;");
  const std::string order = GetParam();
  for (std::uint64_t block = 0; block < num_blocks; block++) {
    std::vector<double> turns(y.begin() + static_cast<std::ptrdiff_t>(block * num_threads),
                              y.begin() + static_cast<std::ptrdiff_t>((block + 1) * num_threads));
    if (order.find("backward") != std::string::npos) {
      EXPECT_TRUE(std::is_sorted(turns.rbegin(), turns.rend()));
    } else if (order.find("shuffled") != std::string::npos) {
      EXPECT_FALSE(std::is_sorted(turns.begin(), turns.end()));
    } else {
      EXPECT_TRUE(std::is_sorted(turns.begin(), turns.end()));
    }
    std::sort(turns.begin(), turns.end());
    for (int t = 0; t < num_threads; t++) EXPECT_EQ(turns[t], t);
  }
}

/// So do calls that do not depend on each other: each puts its turn where it says.
TEST_P(EmulatorTest, MakesCallsInItsOrder) {
  struct Turn {
    double *count, *turn;
  };
  emu::Emulator device(emu::parse(GetParam()));
  constexpr int num_calls = 9;
  std::vector<double> counts(num_calls + 1, 0);
  const auto module = device.compile("test",
                                     "struct Turn { double *count, *turn; }; using namespace hg::gpu;\n"
                                     "HG_KERNEL(test, Turn) { *job.turn = (*job.count)++; }");
  const gpu::Kernel kernel = module->kernel("test");
  std::vector<gpu::Call> calls;
  for (int i = 0; i < num_calls; i++) {
    const Turn job{counts.data(), &counts[i + 1]};
    calls.push_back({.kernel = kernel, .launch = {.num_blocks = 1, .num_threads = 1}, .job = {}});
    calls.back().job.resize(sizeof job);
    std::memcpy(calls.back().job.data(), &job, sizeof job);
  }
  device.make_calls()->launch(calls);
  EXPECT_EQ(counts[0], num_calls);
  std::vector<double> turns(counts.begin() + 1, counts.end());
  const std::string order = GetParam();
  EXPECT_EQ(std::is_sorted(turns.begin(), turns.end()), order.find("forward") != std::string::npos);
  EXPECT_EQ(std::is_sorted(turns.rbegin(), turns.rend()), order.find("backward") != std::string::npos);
  std::sort(turns.begin(), turns.end());
  for (int i = 0; i < num_calls; i++) EXPECT_EQ(turns[i], i);
}

TEST_P(EmulatorTest, RefusesLaunchesThatNoDeviceTakes) {
  expect_names(error_of("", 1 << 20), "cannot be launched with 8 threads and 8388608 bytes of shared memory");
  emu::Emulator device(emu::parse(GetParam()));
  const auto module = device.compile("test", job_text + std::string("HG_KERNEL(test, Job) {}"));
  const gpu::Kernel kernel = module->kernel("test");
  const std::vector<std::byte> job(5000);
  for (const auto &[num_blocks, bytes] :
       {std::pair(std::uint64_t{0}, 100), std::pair(std::uint64_t{1} << 31, 100), std::pair(std::uint64_t{1}, 5000)}) {
    try {
      device.launch(kernel, {.num_blocks = num_blocks, .num_threads = 1}, job.data(), bytes);
      ADD_FAILURE() << num_blocks << " blocks and " << bytes << " bytes";
    } catch (const gpu::DeviceError &error) {
      const std::string what = std::to_string(num_blocks) + " blocks and a job of " + std::to_string(bytes) + " bytes";
      EXPECT_NE(std::string(error.what()).find(what), std::string::npos) << error.what();
    }
  }
}

TEST_P(EmulatorTest, NamesAKernelThatIsNotThereAndTextThatIsNone) {
  emu::Emulator device(emu::parse(GetParam()));
  const auto module = device.compile("a text", job_text);
  EXPECT_THROW(module->kernel("nothing"), gpu::DeviceError);
  try {
    device.compile("a text", "this is no kernel");
    FAIL() << "it was compiled";
  } catch (const gpu::DeviceError &error) {
    EXPECT_NE(std::string(error.what()).find("'a text' is not compiled"), std::string::npos) << error.what();
  }
}

/// What was not written on the device is no number.
TEST_P(EmulatorTest, PoisonsNewMemory) {
  emu::Emulator device(emu::parse(GetParam()));
  void *memory = device.allocate(sizeof(double));
  double value = 0;
  device.copy_to_host(&value, memory, sizeof value);
  device.free(memory);
  EXPECT_NE(value, value);
}

const auto orders = testing::Values("order=forward", "order=backward", "order=shuffled,warp=64");
std::string name_of(const testing::TestParamInfo<const char *> &info) {
  std::string name(info.param);
  std::replace_if(
      name.begin(), name.end(), [](char c) { return c == '=' || c == ','; }, '_');
  return name;
}
INSTANTIATE_TEST_SUITE_P(Orders, EmulatorTest, orders, name_of);
INSTANTIATE_TEST_SUITE_P(Orders, WarpTest, orders, name_of);

TEST(EmulatorOptions, AreRead) {
  EXPECT_EQ(emu::Emulator(emu::parse("warp=64")).properties().warp_size, 64);
  EXPECT_EQ(emu::Emulator(emu::parse("")).properties().warp_size, 32);
  EXPECT_EQ(emu::Emulator(emu::parse("shared=227")).properties().shared_per_block, 227U << 10);
  EXPECT_EQ(emu::Emulator(emu::parse("")).properties().shared_per_block, 64U << 10);
  try {
    emu::parse("order=sideways");
    FAIL() << "it was taken";
  } catch (const gpu::DeviceError &error) {
    EXPECT_NE(std::string(error.what()).find("'order=sideways'; expected order=forward"), std::string::npos);
  }
}

}  // namespace
