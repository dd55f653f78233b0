/// SIMD backends that need no compiler on the user's machine: the instruction set is chosen at run time.
#include <stdexcept>

#include "../host/operator.hpp"

namespace hg::avx {

namespace {

/// The tables of the reference, which does what is not taken here.
CeedBackendOps parents_tables;

/// NULL where it is the parent's.
host::Operator *operator_of(CeedOperator op) {
  host::Operator *own = nullptr;
  host::chk(CeedOperatorGetData(op, &own));
  return own;
}

template <bool is_blocked>
int create(CeedOperator op, const CeedProgram *program) {
  return host::wall(CeedOperatorReturnCeed(op), [&] {
    const char *reason = "";
    const host::Kernels *kernels = host::kernels(is_blocked, &reason);
    if (kernels == nullptr) throw std::runtime_error(reason);
    auto own = host::Operator::make(*kernels, *program);
    host::chk(CeedOperatorSetData(op, own.get()));
    own.release();
  });
}

int destroy(CeedOperator op) {
  return host::wall(CeedOperatorReturnCeed(op), [&] {
    delete operator_of(op);
    host::chk(CeedOperatorSetData(op, nullptr));
  });
}

int apply_add(CeedOperator op, const CeedProgram *program, CeedVector in, CeedVector out, CeedApplyMode mode) {
  return host::wall(CeedOperatorReturnCeed(op), [&] {
    host::Operator *own = operator_of(op);
    if (own == nullptr) return host::chk(parents_tables.op.apply_add(op, program, in, out, mode));
    own->follow(*program);
    own->apply_add(*program, in, out, mode);
  });
}

int linear_assemble_qfunction(CeedOperator op, const CeedProgram *program, CeedInt first_elem, CeedInt num_elem,
                              CeedVector values) {
  return host::wall(CeedOperatorReturnCeed(op), [&] {
    host::Operator *own = operator_of(op);
    if (own == nullptr) {
      return host::chk(parents_tables.op.linear_assemble_qfunction(op, program, first_elem, num_elem, values));
    }
    own->follow(*program);
    own->linear_assemble_qfunction(*program, first_elem, num_elem, values);
  });
}

int linear_assemble_elements(CeedOperator op, const CeedProgram *program, CeedInt source, CeedInt sink,
                             CeedAssembleKind kind, CeedInt first_elem, CeedInt num_elem, const CeedScalar *qfunction,
                             CeedScalar *entries, bool *is_done) {
  return host::wall(CeedOperatorReturnCeed(op), [&] {
    host::Operator *own = operator_of(op);
    *is_done = own != nullptr &&
               own->linear_assemble_elements(*program, source, sink, kind, first_elem, num_elem, qfunction, entries);
  });
}

int get_memory(CeedOperator op, CeedSize *bytes) {
  return host::wall(CeedOperatorReturnCeed(op), [&] {
    const host::Operator *own = operator_of(op);
    *bytes = own != nullptr ? static_cast<CeedSize>(own->num_bytes()) : 0;
  });
}

int score(const char **reason) {
  return host::kernels(true, reason) != nullptr ? 1 : 0;
}

template <bool is_blocked>
int init(Ceed, const char *, CeedBackendOps *ops) {
  if (parents_tables.size == 0) parents_tables = *ops;
  ops->op.create = create<is_blocked>;
  ops->op.destroy = destroy;
  ops->op.apply_add = apply_add;
  ops->op.linear_assemble_qfunction = linear_assemble_qfunction;
  ops->op.linear_assemble_elements = linear_assemble_elements;
  ops->op.get_memory = get_memory;
  return CEED_ERROR_SUCCESS;
}

constexpr CeedBackend backend(const char *resource, unsigned priority, decltype(CeedBackend::init) init) {
  return {.resource = resource,
          .parent = "/cpu/self/ref/serial",
          .priority = priority,
          .aliases = nullptr,
          .score = score,
          .init = init};
}
constexpr CeedBackend backends[] = {backend("/cpu/self/avx/blocked", 30, init<true>),
                                    backend("/cpu/self/avx/serial", 35, init<false>)};

constexpr CeedPlugin plugin{.size = sizeof(CeedPlugin),
                            .api_version = CEED_PLUGIN_API_VERSION,
                            .name = "avx",
                            .num_backends = 2,
                            .backends = backends};

}  // namespace

}  // namespace hg::avx

const CeedPlugin *ceed_plugin_v1() {
  return &hg::avx::plugin;
}
