/// SIMD backends that need no compiler on the user's machine: the instruction set is chosen at run time.
#include <memory>
#include <stdexcept>
#include <variant>

#include "block_operator.hpp"
#include "point_operator.hpp"

namespace hg::avx {

namespace {

/// The tables of the reference, which does what is not taken here.
CeedBackendOps parents_tables;

using AnyOperator = std::variant<BlockOperator, PointOperator>;

/// NULL where it is the parent's.
AnyOperator *operator_of(CeedOperator op) {
  AnyOperator *any = nullptr;
  host::chk(CeedOperatorGetData(op, &any));
  return any;
}

std::unique_ptr<AnyOperator> make(const host::Kernels &kernels, const CeedProgram &program) {
  if (PointOperator::takes(kernels, program)) return std::make_unique<AnyOperator>(PointOperator(kernels, program));
  if (BlockOperator::takes(kernels, program)) return std::make_unique<AnyOperator>(BlockOperator(kernels, program));
  return nullptr;
}

template <bool is_blocked>
int create(CeedOperator op, const CeedProgram *program) {
  return host::wall(CeedOperatorReturnCeed(op), [&] {
    const char *reason = "";
    const host::Kernels *kernels = host::kernels(is_blocked, &reason);
    if (kernels == nullptr) throw std::runtime_error(reason);
    auto any = make(*kernels, *program);
    host::chk(CeedOperatorSetData(op, any.get()));
    any.release();
  });
}

int destroy(CeedOperator op) {
  return host::wall(CeedOperatorReturnCeed(op), [&] {
    delete operator_of(op);
    host::chk(CeedOperatorSetData(op, nullptr));
  });
}

/// Calls f(operator), or f(nullptr) where it is the parent's; one at points first follows them where they have moved.
template <typename F>
int visit(CeedOperator op, const CeedProgram &program, F &&f) {
  return host::wall(CeedOperatorReturnCeed(op), [&] {
    AnyOperator *any = operator_of(op);
    if (any == nullptr) return f(static_cast<BlockOperator *>(nullptr));
    if (auto *at_points = std::get_if<PointOperator>(any)) {
      if (at_points->points_epoch() != program.points_epoch) {
        *any = at_points->followed(program);
      }
    }
    std::visit([&](auto &own) { f(&own); }, *any);
  });
}

int apply_add(CeedOperator op, const CeedProgram *program, CeedVector in, CeedVector out, CeedApplyMode mode) {
  return visit(op, *program, [&](auto *own) {
    if (own == nullptr) return host::chk(parents_tables.op.apply_add(op, program, in, out, mode));
    own->apply_add(*program, in, out, mode);
  });
}

int linear_assemble_qfunction(CeedOperator op, const CeedProgram *program, CeedInt first_elem, CeedInt num_elem,
                              CeedVector values) {
  return visit(op, *program, [&](auto *own) {
    if (own == nullptr) {
      return host::chk(parents_tables.op.linear_assemble_qfunction(op, program, first_elem, num_elem, values));
    }
    own->linear_assemble_qfunction(*program, first_elem, num_elem, values);
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
