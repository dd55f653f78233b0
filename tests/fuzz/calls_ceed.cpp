// Calls on a Ceed, and on nothing: registry, quadrature, dense helpers, work vectors.
#include <cstdlib>

#include "objects.hpp"

namespace hg::fuzz {
namespace {

const Call calls[] = {
    {"CeedInit", false,
     [](Objects &o) {
       static const char *const resources[] = {nullptr,     "",   "/", "/cpu", "/cpu/self", "/cpu/self/ref/serial:x=1",
                                               "/gpu/none", "cpu"};
       Ceed ceed = nullptr;
       const char *resource = resources[o.bytes.next_byte() % std::size(resources)];
       o.took_nothing = true;
       const int code = CeedInit(resource, &ceed);
       if (code != CEED_ERROR_SUCCESS) return code;
       return CeedDestroy(&ceed);
     }},
    {"CeedReferenceCopy", false,
     [](Objects &o) {
       Ceed copy = nullptr;
       const int code = CeedReferenceCopy(o.ceed(), &copy);
       return code != CEED_ERROR_SUCCESS ? code : CeedDestroy(&copy);
     }},
    {"CeedGetResource", false,
     [](Objects &o) {
       const char *resource = nullptr;
       return CeedGetResource(o.ceed(), &resource);
     }},
    {"CeedIsDeterministic", false,
     [](Objects &o) {
       bool is = false;
       return CeedIsDeterministic(o.ceed(), &is);
     }},
    {"CeedGetPreferredMemType", false,
     [](Objects &o) {
       CeedMemType type;
       return CeedGetPreferredMemType(o.ceed(), &type);
     }},
    {"CeedAddJitSourceRoot", false, [](Objects &o) { return CeedAddJitSourceRoot(o.ceed(), o.name()); }},
    {"CeedAddJitDefine", false, [](Objects &o) { return CeedAddJitDefine(o.ceed(), o.name()); }},
    {"CeedGetJitSourceRoots", false,
     [](Objects &o) {
       CeedInt num = 0;
       const char **roots = nullptr;
       const Ceed ceed = o.ceed();
       const int code = CeedGetJitSourceRoots(ceed, &num, &roots);
       return code != CEED_ERROR_SUCCESS ? code : CeedRestoreJitSourceRoots(ceed, &roots);
     }},
    {"CeedGetJitDefines", false,
     [](Objects &o) {
       CeedInt num = 0;
       const char **defines = nullptr;
       const Ceed ceed = o.ceed();
       const int code = CeedGetJitDefines(ceed, &num, &defines);
       return code != CEED_ERROR_SUCCESS ? code : CeedRestoreJitDefines(ceed, &defines);
     }},
    {"CeedSetNumViewTabs", false, [](Objects &o) { return CeedSetNumViewTabs(o.ceed(), o.count()); }},
    {"CeedView", false, [](Objects &o) { return CeedView(o.ceed(), o.stream()); }},
    {"CeedSetStream", false, [](Objects &o) { return CeedSetStream(o.ceed(), nullptr); }},
    {"CeedGetErrorMessage", false,
     [](Objects &o) {
       const char *message = nullptr;
       return CeedGetErrorMessage(o.ceed(), &message);
     }},
    {"CeedRegistryGetList", false,
     [](Objects &) {
       std::size_t n = 0;
       char **names = nullptr;
       CeedInt *priorities = nullptr;
       const int code = CeedRegistryGetList(&n, &names, &priorities);
       std::free(names);
       std::free(priorities);
       return code;
     }},
    {"CeedGaussQuadrature", false,
     [](Objects &o) {
       CeedScalar x[64], w[64];
       const bool has_weights = o.flag();
       o.took_nothing = true;
       return CeedGaussQuadrature(o.count(), x, has_weights ? w : nullptr);
     }},
    {"CeedLobattoQuadrature", false,
     [](Objects &o) {
       CeedScalar x[64], w[64];
       const bool has_weights = o.flag();
       o.took_nothing = true;
       return CeedLobattoQuadrature(o.count(), x, has_weights ? w : nullptr);
     }},
    {"CeedQRFactorization", false,
     [](Objects &o) {
       const Ceed ceed = o.ceed();
       CeedScalar *a = o.scalars(64), tau[16];
       if (o.flag()) a[o.slot()] = o.scalar();
       const CeedInt m = o.few(), n = o.few();
       return CeedQRFactorization(ceed, a, tau, m, n);
     }},
    {"CeedMatrixPseudoinverse", false,
     [](Objects &o) {
       const Ceed ceed = o.ceed();
       CeedScalar *a = o.scalars(64), *b = o.scalars(64);
       if (o.flag()) a[o.slot()] = o.scalar();
       const CeedInt m = o.few(), n = o.few();
       return CeedMatrixPseudoinverse(ceed, a, m, n, b);
     }},
    {"CeedMatrixMatrixMultiply", false,
     [](Objects &o) {
       const Ceed ceed = o.ceed();
       CeedScalar *a = o.scalars(64), *b = o.scalars(64), *c = o.scalars(64);
       const CeedInt m = o.few(), n = o.few(), k = o.few();
       return CeedMatrixMatrixMultiply(ceed, a, b, c, m, n, k);
     }},
    {"CeedSymmetricSchurDecomposition", false,
     [](Objects &o) {
       const Ceed ceed = o.ceed();
       CeedScalar *a = o.scalars(64), lambda[16];
       if (o.flag()) a[o.slot()] = o.scalar();
       const CeedInt n = o.few();
       return CeedSymmetricSchurDecomposition(ceed, a, lambda, n);
     }},
    {"CeedSimultaneousDiagonalization", false,
     [](Objects &o) {
       const Ceed ceed = o.ceed();
       CeedScalar *a = o.scalars(64), *b = o.scalars(64), x[64], lambda[16];
       const CeedInt n = o.few();
       for (int i = 0; i < n; i++) b[i * n + i] += o.flag() ? 20 : 0;
       return CeedSimultaneousDiagonalization(ceed, a, b, x, lambda, n);
     }},
    {"CeedGetWorkVector", false,
     [](Objects &o) {
       CeedVector vec = nullptr;
       const Ceed ceed = o.ceed();
       const int code = CeedGetWorkVector(ceed, o.length(), &vec);
       if (code == CEED_ERROR_SUCCESS) o.work_vectors.push_back(vec);
       return code;
     }},
    {"CeedRestoreWorkVector", true,
     [](Objects &o) {
       const Ceed ceed = o.ceed();
       if (o.work_vectors.empty()) {
         CeedVector vec = o.vector();
         return CeedRestoreWorkVector(ceed, &vec);
       }
       CeedVector vec = o.work_vectors.front();
       const int code = CeedRestoreWorkVector(ceed, &vec);
       if (code == CEED_ERROR_SUCCESS) o.work_vectors.erase(o.work_vectors.begin());
       return code;
     }},
    {"CeedClearWorkVectors", false,
     [](Objects &o) {
       const Ceed ceed = o.ceed();
       return CeedClearWorkVectors(ceed, o.length());
     }},
    {"CeedGetWorkVectorMemoryUsage", false,
     [](Objects &o) {
       CeedScalar megabytes = 0;
       return CeedGetWorkVectorMemoryUsage(o.ceed(), &megabytes);
     }},
    {"CeedObjectView", false,
     [](Objects &o) {
       switch (o.slot()) {
         case 0:
           return CeedObjectView(reinterpret_cast<CeedObject>(o.vector()), o.stream());
         case 1:
           return CeedObjectView(reinterpret_cast<CeedObject>(o.restriction()), o.stream());
         case 2:
           return CeedObjectView(reinterpret_cast<CeedObject>(o.basis()), o.stream());
         case 3:
           return CeedObjectView(reinterpret_cast<CeedObject>(o.qfunction()), o.stream());
         case 4:
           return CeedObjectView(reinterpret_cast<CeedObject>(o.context()), o.stream());
         default:
           return CeedObjectView(reinterpret_cast<CeedObject>(o.op()), o.stream());
       }
     }},
    {"CeedObjectGetCeed", false,
     [](Objects &o) {
       Ceed ceed = nullptr;
       const int code = CeedObjectGetCeed(reinterpret_cast<CeedObject>(o.vector()), &ceed);
       return code != CEED_ERROR_SUCCESS ? code : CeedDestroy(&ceed);
     }},
    {"CeedRequestWait", false,
     [](Objects &o) {
       CeedRequest request = nullptr;
       o.took_nothing = true;
       return CeedRequestWait(o.flag() ? &request : nullptr);
     }},
};

}  // namespace

std::span<const Call> ceed_calls() {
  return calls;
}

}  // namespace hg::fuzz
