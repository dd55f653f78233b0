/// Host backend whose operators are compiled at run time.
#include <stdexcept>

#include "operator.hpp"

namespace hg::gen {

namespace {

/// The tables of the parent, whose functions find in an operator of ours one of their own.
CeedBackendOps parents_tables;

/// NULL where it is the parent's.
Operator *operator_of(CeedOperator op) {
  host::Operator *own = nullptr;
  host::chk(CeedOperatorGetData(op, &own));
  return static_cast<Operator *>(own);
}

const host::Kernels &kernels() {
  const char *reason = "";
  const host::Kernels *kernels = host::kernels(true, &reason);
  if (kernels == nullptr) throw std::runtime_error(reason);
  return *kernels;
}

int create(CeedOperator op, const CeedProgram *program) {
  return host::wall(CeedOperatorReturnCeed(op), [&] {
    auto own = Operator::make(kernels(), *program);
    host::chk(CeedOperatorSetData(op, static_cast<host::Operator *>(own.get())));
    own.release();
  });
}

int destroy(CeedOperator op) {
  return host::wall(CeedOperatorReturnCeed(op), [&] {
    delete operator_of(op);
    host::chk(CeedOperatorSetData(op, nullptr));
  });
}

int prepare(CeedOperator op, const CeedProgram *program, CeedOperatorUse use) {
  return host::wall(CeedOperatorReturnCeed(op), [&] {
    Operator *own = operator_of(op);
    if (own == nullptr) return;
    if (use == CEED_USE_APPLY) {
      own->prepare(*program);
    } else {
      own->prepare_assembly(*program);
    }
  });
}

int apply_add(CeedOperator op, const CeedProgram *program, CeedVector in, CeedVector out, CeedApplyMode mode) {
  return host::wall(CeedOperatorReturnCeed(op), [&] {
    Operator *own = operator_of(op);
    if (own == nullptr) return host::chk(parents_tables.op.apply_add(op, program, in, out, mode));
    own->apply_add(*program, in, out, mode);
  });
}

int get_memory(CeedOperator op, CeedSize *bytes) {
  return host::wall(CeedOperatorReturnCeed(op), [&] {
    const Operator *own = operator_of(op);
    *bytes = own != nullptr ? static_cast<CeedSize>(own->num_bytes()) : 0;
  });
}

/// As the parent does, with the QFunction compiled.
int linear_assemble_qfunction(CeedOperator op, const CeedProgram *program, CeedInt first_elem, CeedInt num_elem,
                              CeedVector values) {
  return host::wall(CeedOperatorReturnCeed(op), [&] {
    if (Operator *own = operator_of(op); own != nullptr) own->prepare_assembly(*program);
    host::chk(parents_tables.op.linear_assemble_qfunction(op, program, first_elem, num_elem, values));
  });
}

int score(const char **reason) {
  return host::kernels(true, reason) != nullptr ? 1 : 0;
}

int init(Ceed, const char *, CeedBackendOps *ops) {
  if (parents_tables.size == 0) parents_tables = *ops;
  ops->op.create = create;
  ops->op.destroy = destroy;
  ops->op.prepare = prepare;
  ops->op.apply_add = apply_add;
  ops->op.get_memory = get_memory;
  ops->op.linear_assemble_qfunction = linear_assemble_qfunction;
  return CEED_ERROR_SUCCESS;
}

constexpr const char *aliases[] = {"/cpu/self/gen/blocked", "/cpu/self/gen/serial", nullptr};
constexpr CeedBackend backend{.resource = "/cpu/self/gen",
                              .parent = "/cpu/self/avx/blocked",
                              .priority = 40,
                              .aliases = aliases,
                              .score = score,
                              .init = init};

constexpr CeedPlugin plugin{.size = sizeof(CeedPlugin),
                            .api_version = CEED_PLUGIN_API_VERSION,
                            .name = "gen",
                            .num_backends = 1,
                            .backends = &backend};

}  // namespace

}  // namespace hg::gen

const CeedPlugin *ceed_plugin_v1() {
  return &hg::gen::plugin;
}
