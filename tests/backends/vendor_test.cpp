// All that is compiled for devices, by the vendors' compilers where they are installed, for devices that need not be
// there.
#include <ceed.h>
#include <ceed/plugin.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "backends/cuda/vendor.hpp"
#include "backends/gpu/operator_text.hpp"
#include "backends/gpu/options.hpp"
#include "backends/gpu/qfunction.hpp"
#include "backends/gpu/tables.hpp"
#include "backends/gpu/texts.hpp"
#include "backends/gpu/vendor.hpp"
#include "backends/hip/vendor.hpp"
#include "bakeoff_operator.hpp"
#include "support/errors.hpp"
#include "support/handles.hpp"
#include "support/program.hpp"
#include "vendor_targets.hpp"

namespace {

using namespace hg;
using test::ok;
using test::VendorTest;

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

/// The text of an operator for a kind of device.
gpu::OperatorText text_of(CeedOperator op, const test::Target &target, gpu::Purpose purpose = gpu::Purpose::apply) {
  const CeedProgram *program = nullptr;
  ok(CeedOperatorGetProgram(op, &program));
  const gpu::Block block{.num_threads = program->at_points ? 128 : 256,
                         .warp_size = target.warp_size,
                         .shared_bytes = target.shared_bytes};
  const gpu::FunctionText function(program->qf);
  return program->at_points ? gpu::cells_text(block, *program, function, purpose)
                            : gpu::elements_text(block, *program, function, purpose);
}

/// The largest number right before `words` in what a compiler printed, of the kernel or of functions that it calls.
/// (Not by <regex>: GCC 12 warns of it when it sanitizes.)
std::optional<int> number_before(const std::string &words, const std::string &log) {
  std::optional<int> largest;
  for (auto end = log.find(words); end != std::string::npos; end = log.find(words, end + 1)) {
    std::size_t begin = end;
    while (begin > 0 && std::isdigit(static_cast<unsigned char>(log[begin - 1])) != 0) begin--;
    if (begin < end) largest = std::max(largest.value_or(0), std::stoi(log.substr(begin, end - begin)));
  }
  return largest;
}

/// The largest number that follows a name in the notes of AMD's code, in MessagePack.
std::optional<int> number_after(const std::string &name, const std::string &code) {
  std::optional<int> largest;
  for (auto at = code.find(name); at != std::string::npos; at = code.find(name, at + 1)) {
    std::size_t next = at + name.size();
    const auto byte = [&] { return next < code.size() ? static_cast<unsigned char>(code[next++]) : 0; };
    const int first = byte(), num_bytes = first < 0x80    ? 0
                                          : first == 0xcc ? 1
                                          : first == 0xcd ? 2
                                          : first == 0xce ? 4
                                                          : -1;
    if (num_bytes < 0) continue;
    int number = num_bytes == 0 ? first : 0;
    for (int i = 0; i < num_bytes; i++) number = number << 8 | byte();
    largest = std::max(largest.value_or(0), number);
  }
  return largest;
}

/// What a kernel needs: registers of a thread, rounded up as they are given out, shared memory of a block, and bytes of
/// a thread that are spilled.
struct Needs {
  int registers = 0, shared_kb = 0, spilled = 0;
};
std::ostream &operator<<(std::ostream &stream, const Needs &needs) {
  return stream << needs.registers << ',' << needs.shared_kb << ',' << needs.spilled;
}

/// Those of budgets.csv, by target and name. HG_NEEDS=FILE: what there is now is written there in its form.
class Budgets {
 public:
  Budgets() {
    std::ifstream lines(HG_BUDGETS);
    std::string line;
    for (std::getline(lines, line); std::getline(lines, line);) {
      std::string target, name;
      Needs needs;
      char comma = 0;
      std::istringstream words(line);
      std::getline(words, target, ',');
      std::getline(words, name, ',');
      words >> needs.registers >> comma >> needs.shared_kb >> comma >> needs.spilled;
      budgets_[target + ',' + name] = needs;
    }
    const char *file = std::getenv("HG_NEEDS");
    if (file != nullptr) written_.open(file, std::ios::app);
    if (written_.is_open() && written_.tellp() == 0) written_ << "target,operator,registers,shared KB,bytes spilled\n";
  }
  void expect(const std::string &name, const Needs &needs) {
    if (written_.is_open()) written_ << name << ',' << needs << std::endl;
    const auto found = budgets_.find(name);
    ASSERT_NE(found, budgets_.end()) << name << " has no budget; it needs " << needs;
    const Needs &budget = found->second;
    EXPECT_TRUE(needs.registers <= budget.registers && needs.shared_kb <= budget.shared_kb &&
                needs.spilled <= budget.spilled)
        << name << " needs " << needs << "; its budget, by NVRTC 13.0 and hiprtc of ROCm 5.2, is " << budget;
  }
  bool have(const std::string &name) const { return budgets_.count(name) != 0; }

 private:
  std::map<std::string, Needs> budgets_;
  std::ofstream written_;
};

/// Operators and assemblies as one kernel, with what the compiler says of them. What has no budget is not one kernel.
class BudgetTest : public VendorTest {
 protected:
  void compile(CeedOperator op, gpu::Purpose purpose, const std::string &name, bool may_spill) {
    const std::string row = std::string(target().name) + ',' + name;
    const gpu::OperatorText text = text_of(op, target(), purpose);
    if (text.text.empty()) {
      std::printf("%s %s: not one kernel\n", target().name, name.c_str());
      EXPECT_FALSE(budgets_.have(row)) << name << " was one kernel; now it does not fit";
      return;
    }
    std::string log;
    const auto begin = std::chrono::steady_clock::now();
    const std::string code = compiler->compile(name, text.text, target().options, &log);
    const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - begin;
    const bool is_cuda = &target().vendor == &cuda::vendor;
    constexpr int word = 4;
    const auto registers = is_cuda ? number_before(" registers", log) : number_after(".vgpr_count", code);
    const auto spilled = is_cuda ? number_before(" bytes spill stores", log) : number_after(".vgpr_spill_count", code);
    ASSERT_TRUE(registers && spilled) << log;
    const Needs needs{.registers = (*registers + 7) / 8 * 8,
                      .shared_kb = static_cast<int>((text.shared_bytes + 1023) >> 10),
                      .spilled = *spilled * (is_cuda ? 1 : word)};
    std::printf("%s %s: %d x %d threads, %d KB, %d registers, %d bytes spilled, compiled in %.0f ms\n", target().name,
                name.c_str(), text.num_blocks, text.num_threads, needs.shared_kb, *registers, needs.spilled,
                took.count());
    budgets_.expect(row, needs);
    EXPECT_TRUE(may_spill || needs.spilled == 0) << name << " spills " << needs.spilled << " bytes";
  }

  const test::CeedHandle ceed{test::open("/cpu/self/ref")};

 private:
  const test::EmptyCache cache_;  // what is found in one says nothing
  Budgets budgets_;
};

/// The table of docs/performance/gpu.md.
TEST_P(BudgetTest, CompilesTheBakeoffProblems) {
  for (const CeedInt per_cell : {0, 27}) {
    for (const char *problem : {"bp1", "bp2", "bp3", "bp4", "bp5", "bp6"}) {
      const int number = problem[2] - '0';
      if (per_cell > 0 && number > 4) continue;
      for (CeedInt p = 1; p <= 8; p++) {
        const CeedInt num_comp = number % 2 == 0 ? 3 : 1, Q = number > 4 ? p + 1 : p + 2;
        const test::BakeoffOperator op(ceed, number > 2, num_comp, p + 1, Q, per_cell);
        compile(op, gpu::Purpose::apply,
                std::string(problem) + (per_cell > 0 ? " at points" : "") + " p=" + std::to_string(p), p > 4);
      }
    }
  }
}

/// Of mass and of 3-vector Poisson problems.
TEST_P(BudgetTest, CompilesAssemblies) {
  for (const CeedInt per_cell : {0, 27}) {
    for (const bool is_poisson : {false, true}) {
      for (const CeedInt p : {1, 2, 4}) {
        const test::BakeoffOperator op(ceed, is_poisson, is_poisson ? 3 : 1, p + 1, p + 2, per_cell);
        for (const auto &[purpose, called] :
             {std::pair(gpu::Purpose::qfunction, "QFunction"), std::pair(gpu::Purpose::matrix, "matrix"),
              std::pair(gpu::Purpose::diagonal, "diagonal"), std::pair(gpu::Purpose::point_blocks, "point blocks")}) {
          compile(op, purpose,
                  std::string(called) + (is_poisson ? " of BP4" : " of BP1") + (per_cell > 0 ? " at points" : "") +
                      " p=" + std::to_string(p),
                  false);
        }
      }
    }
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

/// Where a driver's library is installed, if only to link with, it has all that is asked of it.
class DriverLibrary : public testing::TestWithParam<std::string> {};

TEST_P(DriverLibrary, HasAllThatIsCalled) {
  const gpu::Vendor &vendor = GetParam() == cuda::vendor.name ? cuda::vendor : hip::vendor;
  std::vector<const char *> files(vendor.driver_files.begin(), vendor.driver_files.end());
  if (&vendor == &cuda::vendor) {
    files.push_back("/usr/local/cuda/lib64/stubs/libcuda.so");
    files.push_back("/usr/local/cuda/lib/stubs/libcuda.so");
  }
  std::optional<gpu::VendorLibrary> library;
  try {
    library.emplace(files);
  } catch (const gpu::DeviceError &error) {
    GTEST_SKIP() << vendor.name << "'s driver: " << error.what();
  }
  EXPECT_NO_THROW(library->calls<gpu::DriverCalls>(vendor.driver_names));
  EXPECT_NO_THROW(library->calls<gpu::GraphCalls>(vendor.graph_names));
}

INSTANTIATE_TEST_SUITE_P(Vendors, DriverLibrary, testing::Values(cuda::vendor.name, hip::vendor.name),
                         [](const auto &info) { return info.param; });

TEST(DeviceOptions, AreRead) {
  const gpu::Options usual = gpu::parse_options(""), both = gpu::parse_options("device_id=1,threads=128");
  EXPECT_EQ(usual.device_id, gpu::current_device);
  EXPECT_EQ(usual.tuning.threads, gpu::Tuning().threads);
  EXPECT_EQ(both.device_id, 1);
  EXPECT_EQ(both.tuning.threads, 128);
  const gpu::Options at_points = gpu::parse_options("lanes=8,slots=2");
  EXPECT_EQ(at_points.tuning.lanes, 8);
  EXPECT_EQ(at_points.tuning.slots, 2);
}

TEST(DeviceOptions, AreRefusedWithWhatWasExpected) {
  const std::pair<const char *, std::vector<const char *>> cases[] = {
      {"threads=16", {"'threads=16'", "32 to 1024"}},
      {"threads=", {"'threads='", "32 to 1024"}},
      {"threads=64x", {"'threads=64x'", "32 to 1024"}},
      {"device_id=-1", {"'device_id=-1'", "0 to"}},
      {"lanes=6", {"'lanes=6'", "a power of two from 1 to 64"}},
      {"slots=5", {"'slots=5'", "1 to 4"}},
      {"threads=64,colour=red", {"'colour=red'", "device_id=N", "threads=N"}}};
  for (const auto &[text, words] : cases) {
    try {
      gpu::parse_options(text);
      FAIL() << text << " was taken";
    } catch (const gpu::DeviceError &error) {
      for (const char *word : words) EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Targets, VendorTest, VendorTest::all(), VendorTest::name_of);
INSTANTIATE_TEST_SUITE_P(Targets, BudgetTest, BudgetTest::all(), BudgetTest::name_of);

}  // namespace
