/// The reference backend that also catches misuse of arrays, by the caller and by QFunctions: see docs/backends.md.
#include <new>

#include "state.hpp"

namespace hg::memcheck {

thread_local int InParent::depth = 0;

namespace {

CeedBackendOps parents_tables;

int destroy(Ceed ceed) {
  delete &state_of(ceed);
  return CEED_ERROR_SUCCESS;
}

int init(Ceed ceed, const char *, CeedBackendOps *ops) {
  auto *state = new (std::nothrow) State;
  CeedCheck(state != nullptr, ceed, CEED_ERROR_BACKEND, "Out of memory");
  CeedCallBackend(CeedSetData(ceed, state));
  if (parents_tables.size == 0) parents_tables = *ops;
  ops->ceed_destroy = destroy;
  fill_vector_ops(ops->vector);
  fill_restriction_ops(ops->restriction);
  fill_basis_ops(ops->basis);
  fill_context_ops(ops->context);
  fill_qfunction_ops(ops->qfunction);
  fill_operator_ops(ops->op);
  return CEED_ERROR_SUCCESS;
}

constexpr CeedBackend backend{.resource = "/cpu/self/memcheck/serial",
                              .parent = "/cpu/self/ref/serial",
                              .priority = 110,
                              .aliases = nullptr,
                              .score = nullptr,
                              .init = init};

constexpr CeedPlugin plugin{.size = sizeof(CeedPlugin),
                            .api_version = CEED_PLUGIN_API_VERSION,
                            .name = "memcheck",
                            .num_backends = 1,
                            .backends = &backend};

}  // namespace

State &state_of(Ceed ceed) {
  State *state = nullptr;
  CeedGetData(ceed, &state);
  return *state;
}

const CeedBackendOps &parent() {
  return parents_tables;
}

}  // namespace hg::memcheck

const CeedPlugin *ceed_plugin_v1() {
  return &hg::memcheck::plugin;
}
