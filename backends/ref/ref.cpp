/// The reference backend: naive, independent of every other, always there. All others are compared with it.
#include "basis.hpp"
#include "operator.hpp"
#include "restriction.hpp"
#include "vector.hpp"

namespace hg::ref {

namespace {

int init(Ceed, const char *, CeedBackendOps *ops) {
  ops->preferred_mem_type = CEED_MEM_HOST;
  ops->is_deterministic = true;
  ops->host_memory_only = true;
  fill_vector_ops(ops->vector);
  fill_restriction_ops(ops->restriction);
  fill_basis_ops(ops->basis);
  fill_qfunction_ops(ops->qfunction);
  fill_operator_ops(ops->op);
  return CEED_ERROR_SUCCESS;
}

constexpr CeedBackend backend{.resource = "/cpu/self/ref/serial",
                              .parent = nullptr,
                              .priority = 50,
                              .aliases = nullptr,
                              .score = nullptr,
                              .init = init};

constexpr CeedPlugin plugin{.size = sizeof(CeedPlugin),
                            .api_version = CEED_PLUGIN_API_VERSION,
                            .name = "ref",
                            .num_backends = 1,
                            .backends = &backend};

}  // namespace

}  // namespace hg::ref

const CeedPlugin *ceed_plugin_ref() { return &hg::ref::plugin; }
