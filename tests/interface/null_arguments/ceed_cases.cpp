// Ceed, CeedObject, plugins, sources, dense algebra.
#include "cases.hpp"

namespace hg::test {

std::vector<Case> ceed_cases() {
  return {
      HG_CASE(CeedObjectView, o.object(), o.stream),
      HG_CASE(CeedObjectSetNumViewTabs, o.object(), 1),
      HG_CASE(CeedObjectGetNumViewTabs, o.object(), &o.number),
      HG_CASE(CeedObjectGetCeed, o.object(), &o.made_ceed),
      HG_CASE(CeedObjectReturnCeed, o.object()),
      HG_CASE(CeedObjectDestroy, optional(reinterpret_cast<CeedObject *>(&o.x))),

      HG_CASE(CeedRegistryGetList, &o.count, optional(&o.names), optional(&o.rows)),
      HG_CASE(CeedInit, "/cpu/self/ref/serial", &o.made_ceed),
      HG_CASE_NULLS(CeedReference, o.ceed),
      HG_CASE(CeedReferenceCopy, o.ceed, &o.made_ceed),
      HG_CASE(CeedDestroy, optional(&o.ceed)),
      HG_CASE(CeedGetResource, o.ceed, &o.text),
      HG_CASE(CeedGetResourceRoot, optional(o.ceed), "/a:b", ":", &o.own_text),
      HG_CASE(CeedIsDeterministic, o.ceed, &o.flag),
      HG_CASE(CeedSetDeterministic, o.ceed, true),
      HG_CASE(CeedIsDebug, optional(o.ceed), &o.flag),
      HG_CASE(CeedSetNumViewTabs, o.ceed, 1),
      HG_CASE(CeedGetNumViewTabs, o.ceed, &o.number),
      HG_CASE(CeedView, o.ceed, o.stream),
      HG_CASE(CeedSetErrorHandler, o.ceed, CeedErrorStore),
      HG_CASE(CeedGetErrorMessage, optional(o.ceed), &o.text),
      HG_CASE(CeedResetErrorMessage, optional(o.ceed), &o.text),
      HG_CASE(CeedGetVersion, optional(&o.version[0]), optional(&o.version[1]), optional(&o.version[2]),
              optional(&o.flag)),
      HG_CASE(CeedGetGitVersion, &o.text),
      HG_CASE(CeedGetBuildConfiguration, &o.text),
      HG_CASE(CeedSetIsClang, o.ceed, true),
      HG_CASE(CeedGetIsClang, o.ceed, &o.flag),
      HG_CASE(CeedGetScalarType, &o.scalar_type),
      HG_CASE(CeedGetPreferredMemType, o.ceed, &o.mem_type),
      HG_CASE(CeedGetData, o.ceed, static_cast<void *>(&o.pointer)),
      HG_CASE(CeedSetData, o.ceed, optional(static_cast<void *>(o.matrix))),
      HG_CASE(CeedGetBackendOps, o.ceed, &o.ops),
      HG_CASE(CeedGetTransfers, o.ceed, &o.transfers),
      HG_CASE(CeedGetWorkVector, o.ceed, 3, &o.work_vector),
      HG_CASE_AFTER(CeedGetWorkVector(o.ceed, 3, &o.work_vector), CeedRestoreWorkVector, o.ceed, &o.work_vector),
      HG_CASE(CeedClearWorkVectors, o.ceed, 0),
      HG_CASE(CeedGetWorkVectorMemoryUsage, o.ceed, &o.scalar),
      // A registered plugin stays.
      HG_CASE_NULLS(CeedPluginRegister, &o.plugin),
      HG_CASE(CeedPluginGetList, &o.count, &o.plugins),

      HG_CASE(CeedAddJitSourceRoot, o.ceed, "/tmp"),
      HG_CASE(CeedAddJitDefine, o.ceed, "A=1"),
      HG_CASE(CeedAddRustSourceRoot, o.ceed, "/tmp"),
      HG_CASE(CeedGetJitSourceRoots, o.ceed, &o.number, &o.strings),
      HG_CASE(CeedGetRustSourceRoots, o.ceed, &o.number, &o.strings),
      HG_CASE(CeedGetJitDefines, o.ceed, &o.number, &o.strings),
      HG_CASE(CeedRestoreJitSourceRoots, optional(o.ceed), optional(&o.strings)),
      HG_CASE(CeedRestoreRustSourceRoots, optional(o.ceed), optional(&o.strings)),
      HG_CASE(CeedRestoreJitDefines, optional(o.ceed), optional(&o.strings)),
      HG_CASE(CeedCheckFilePath, optional(o.ceed), "cases.cpp:function", &o.flag),
      HG_CASE(CeedGetJitRelativePath, "/a/ceed/jit-source/b.h", &o.text),
      HG_CASE_AFTER(CeedAddJitSourceRoot(o.ceed, "/dev"), CeedGetJitAbsolutePath, o.ceed, "../proc/self/status",
                    &o.absolute_path),

      HG_CASE(CeedGaussQuadrature, 3, o.matrix, optional(o.tau)),
      HG_CASE(CeedLobattoQuadrature, 3, o.matrix, optional(o.tau)),
      HG_CASE(CeedMatrixMatrixMultiply, optional(o.ceed), o.matrix, o.other_matrix, o.third_matrix, 3, 3, 3),
      HG_CASE(CeedQRFactorization, optional(o.ceed), o.matrix, o.tau, 3, 3),
      HG_CASE(CeedHouseholderApplyQ, o.third_matrix, o.matrix, o.tau, CEED_NOTRANSPOSE, 3, 3, 3, 3, 1),
      HG_CASE(CeedMatrixPseudoinverse, optional(o.ceed), o.matrix, 3, 3, o.third_matrix),
      HG_CASE(CeedSymmetricSchurDecomposition, optional(o.ceed), o.matrix, o.tau, 3),
      HG_CASE(CeedSimultaneousDiagonalization, optional(o.ceed), o.matrix, o.other_matrix, o.third_matrix, o.tau, 3),
  };
}

}  // namespace hg::test
