/// The tables of operators: in stages, or as one kernel where that is possible.
#include <memory>

#include "../host/access.hpp"
#include "../jit/compiler.hpp"
#include "fused.hpp"
#include "staged.hpp"
#include "tables.hpp"

namespace hg::gpu {

using host::chk, host::wall;

namespace {

/// What an operator keeps once it was applied.
struct Kept {
  std::unique_ptr<StagedOperator> staged;
  std::unique_ptr<FusedOperator> fused;
  bool is_fused_tried = false;
};

/// NULL where it was not applied yet, or is the parent's.
Kept *kept_of(CeedOperator op) {
  Kept *kept = nullptr;
  chk(CeedOperatorGetData(op, &kept));
  return kept;
}

Kept &own_kept_of(CeedOperator op) {
  if (Kept *kept = kept_of(op)) return *kept;
  auto made = std::make_unique<Kept>();
  chk(CeedOperatorSetData(op, made.get()));
  return *made.release();
}

int create(CeedOperator op, const CeedProgram *) {
  return CeedOperatorSetData(op, nullptr);  // memory is for those that are applied
}

int destroy(CeedOperator op) {
  return wall(CeedOperatorReturnCeed(op), [&] {
    delete kept_of(op);
    chk(CeedOperatorSetData(op, nullptr));
  });
}

void apply_staged(CeedOperator op, const CeedProgram &program, CeedVector in, CeedVector out, CeedApplyMode mode) {
  PointFunction *function = function_of(program.qf);
  if (function == nullptr) return chk(parents_tables().op.apply_add(op, &program, in, out, mode));
  auto &staged = own_kept_of(op).staged;
  if (staged == nullptr) {
    staged = std::make_unique<StagedOperator>(Device::of(CeedOperatorReturnCeed(op)), program);
  }
  staged->apply_add(program, *function, in, out, mode);
}

int apply_add_staged(CeedOperator op, const CeedProgram *program, CeedVector in, CeedVector out, CeedApplyMode mode) {
  return wall(CeedOperatorReturnCeed(op), [&] { apply_staged(op, *program, in, out, mode); });
}

int apply_add_fused(CeedOperator op, const CeedProgram *program, CeedVector in, CeedVector out, CeedApplyMode mode) {
  return wall(CeedOperatorReturnCeed(op), [&] {
    Kept &kept = own_kept_of(op);
    if (!kept.is_fused_tried) {
      try {
        kept.fused = FusedOperator::make(Device::of(CeedOperatorReturnCeed(op)), *program);
      } catch (const jit::NoSource &) {
        // It runs on the host, which is told there.
      }
      kept.is_fused_tried = true;
    }
    if (kept.fused != nullptr) {
      kept.fused->apply_add(*program, in, out, mode);
    } else {
      apply_staged(op, *program, in, out, mode);
    }
  });
}

int get_memory(CeedOperator op, CeedSize *bytes) {
  return wall(CeedOperatorReturnCeed(op), [&] {
    *bytes = 0;
    const Kept *kept = kept_of(op);
    if (kept == nullptr) return;
    *bytes = sizeof *kept;
    if (kept->staged != nullptr) *bytes += static_cast<CeedSize>(kept->staged->num_bytes());
    if (kept->fused != nullptr) *bytes += static_cast<CeedSize>(kept->fused->num_bytes());
  });
}

}  // namespace

// What is assembled is assembled by the reference, on the host.
void fill_operator_ops(CeedOperatorOps &ops, bool is_fused) {
  ops.create = create;
  ops.destroy = destroy;
  ops.apply_add = is_fused ? apply_add_fused : apply_add_staged;
  ops.get_memory = get_memory;
}

}  // namespace hg::gpu
