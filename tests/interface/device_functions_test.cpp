// Kernels that a program has loaded on a device: the backend of that device gets them, others pass over them.
#include <ceed/cuda.h>
#include <ceed/hip.h>
#include <ceed/plugin.h>
#include <gtest/gtest.h>

#include "support/errors.hpp"
#include "support/handles.hpp"
#include "support/values.hpp"

namespace {

using namespace hg::test;

CeedQFunction told = nullptr;
CUfunc_st *cuda_function = nullptr;
ihipModuleSymbol_t *hip_function = nullptr;

int set_cuda_function(CeedQFunction qf, CUfunc_st *f) {
  told = qf;
  cuda_function = f;
  return CEED_ERROR_SUCCESS;
}
int set_hip_function(CeedQFunction qf, ihipModuleSymbol_t *f) {
  hip_function = f;
  return CeedError(CeedQFunctionReturnCeed(qf), CEED_ERROR_BACKEND, "no kernel of this device");
}
int init_cuda(Ceed, const char *, CeedBackendOps *ops) {
  ops->qfunction.set_cuda_function = set_cuda_function;
  return CEED_ERROR_SUCCESS;
}
int init_hip(Ceed, const char *, CeedBackendOps *ops) {
  ops->qfunction.set_hip_function = set_hip_function;
  return CEED_ERROR_SUCCESS;
}

class DeviceFunctions : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    static const CeedBackend backends[] = {
        {"/test/cuda", reference_resource, 1000, nullptr, nullptr, init_cuda},
        {"/test/hip", reference_resource, 1000, nullptr, nullptr, init_hip},
    };
    static const CeedPlugin plugin{sizeof(CeedPlugin), CEED_PLUGIN_API_VERSION, "devices", 2, backends};
    ASSERT_EQ(CeedPluginRegister(&plugin), CEED_ERROR_SUCCESS);
  }
  void SetUp() override {
    told = nullptr;
    cuda_function = nullptr;
    hip_function = nullptr;
  }
  static QFunction identity(Ceed ceed) {
    QFunction qf;
    ok(CeedQFunctionCreateIdentity(ceed, 1, CEED_EVAL_NONE, CEED_EVAL_NONE, qf.out()));
    return qf;
  }

  char module = 0;  ///< something to point to: what a kernel is, is the device's affair
  CUfunc_st *const cuda_kernel = reinterpret_cast<CUfunc_st *>(&module);
  ihipModuleSymbol_t *const hip_kernel = reinterpret_cast<ihipModuleSymbol_t *>(&module);
};

TEST_F(DeviceFunctions, ReachTheBackendOfTheirDevice) {
  const CeedHandle ceed{open("/test/cuda")};
  const QFunction qf = identity(ceed);
  ok(CeedQFunctionSetCUDAUserFunction(qf, cuda_kernel));
  EXPECT_EQ(told, static_cast<CeedQFunction>(qf));
  EXPECT_EQ(cuda_function, cuda_kernel);
  ok(CeedQFunctionSetHIPUserFunction(qf, hip_kernel));
  EXPECT_EQ(hip_function, nullptr);
}

TEST_F(DeviceFunctions, AreRefusedByTheBackendAlone) {
  const CeedHandle ceed{open("/test/hip")};
  const QFunction qf = identity(ceed);
  EXPECT_EQ(CeedQFunctionSetHIPUserFunction(qf, hip_kernel), CEED_ERROR_BACKEND);
  EXPECT_EQ(hip_function, hip_kernel);
  EXPECT_EQ(CeedQFunctionSetHIPUserFunction(qf, nullptr), CEED_ERROR_INCOMPLETE);
  EXPECT_EQ(CeedQFunctionSetHIPUserFunction(CEED_QFUNCTION_NONE, hip_kernel), CEED_ERROR_INCOMPATIBLE);
}

/// The C function serves.
TEST_F(DeviceFunctions, LeaveTheHostAsItIs) {
  const CeedHandle ceed{open(reference_resource)};
  const QFunction qf = identity(ceed);
  CeedQFunctionUser before = nullptr, after = nullptr;
  ok(CeedQFunctionGetUserFunction(qf, &before));
  ok(CeedQFunctionSetCUDAUserFunction(qf, cuda_kernel));
  ok(CeedQFunctionSetHIPUserFunction(qf, hip_kernel));
  ok(CeedQFunctionGetUserFunction(qf, &after));
  EXPECT_NE(before, nullptr);
  EXPECT_EQ(before, after);
}

}  // namespace
