/// What operators hold.
#include <mutex>
#include <set>

#include "operator.hpp"

namespace {

/// Counts each array once, however many objects and operators share it.
class Counter {
 public:
  void add(CeedOperator_private &op) {
    if (!seen_.insert(&op).second) return;
    const CeedProgram &program = hg::program_of(op);
    memory_.program +=
        static_cast<CeedSize>(sizeof op + op.program->num_bytes()) +
        static_cast<CeedSize>(sizeof(CeedOperatorField_private)) * (program.num_inputs + program.num_outputs);
    if (op.qf->context) add(memory_.program, op.qf->context->values, static_cast<CeedSize>(op.qf->context->size));
    const auto add_sides = [&](const CeedProgramSide *sides, CeedInt count) {
      for (CeedInt i = 0; i < count; i++) {
        add(memory_.restrictions, *sides[i].rstr);
        add(memory_.vectors, *sides[i].vec);
      }
    };
    add_sides(program.sources, program.num_sources);
    add_sides(program.sinks, program.num_sinks);
    for (CeedInt i = 0; i < program.num_spaces; i++) add(*program.spaces[i].basis);
    if (program.at_points) {
      add(memory_.restrictions, *program.points_rstr);
      add(memory_.vectors, *program.points);
    }
    if (op.assembled) {
      add(memory_.assembly, *op.assembled);
      add(memory_.assembly, *op.assembled_rstr);
    }
    add_backend(op);
  }
  /// What the backend keeps, also for a composite whose parts it applied together.
  void add_backend(CeedOperator_private &op) {
    if (op.ceed->ops.op.get_memory == nullptr) return;
    CeedSize bytes = 0;
    hg::check(op.ceed->ops.op.get_memory(&op, &bytes));
    memory_.backend += bytes;
  }

  CeedOperatorMemory memory() const {
    CeedOperatorMemory memory = memory_;
    memory.total =
        memory.program + memory.restrictions + memory.bases + memory.vectors + memory.assembly + memory.backend;
    return memory;
  }

 private:
  void add(CeedSize &sum, const void *array, CeedSize bytes) {
    if (array != nullptr && bytes > 0 && seen_.insert(array).second) sum += bytes;
  }
  void add(CeedSize &sum, const CeedElemRestriction_private &rstr) {
    add(sum, rstr.offsets, rstr.num_offsets() * static_cast<CeedSize>(sizeof(CeedInt)));
    add(sum, rstr.bands, rstr.table_size(static_cast<CeedSize>(rstr.num_bands) * rstr.elem_size));
    add(sum, rstr.orients.data(), rstr.table_size(rstr.elem_size) * static_cast<CeedSize>(sizeof(bool)));
  }
  void add(CeedSize &sum, const CeedVector_private &vec) {
    if (!vec.is_sentinel) add(sum, &vec, vec.length * static_cast<CeedSize>(sizeof(CeedScalar)));
  }
  void add(CeedBasis_private &basis) {
    const std::lock_guard lock(basis.matrix_mutex);
    for (const auto *matrix : {&basis.q_ref, &basis.q_weight, &basis.interp_1d, &basis.grad_1d, &basis.interp,
                               &basis.derivative, &basis.chebyshev_1d}) {
      add(memory_.bases, matrix->data(), static_cast<CeedSize>(matrix->size() * sizeof(CeedScalar)));
    }
  }

  CeedOperatorMemory memory_{};
  std::set<const void *> seen_;
};

}  // namespace

int CeedOperatorGetMemory(CeedOperator op, CeedOperatorMemory *memory) {
  return hg::guard(hg::ceed_of(op), [&] {
    hg::check_ready(hg::deref(op, "CeedOperator"));
    CeedOperatorMemory &result = hg::result(memory, "memory");
    Counter counter;
    hg::for_each_single(*op, [&](CeedOperator_private &single) { counter.add(single); });
    if (op->is_joined) counter.add_backend(*op);
    result = counter.memory();
  });
}
