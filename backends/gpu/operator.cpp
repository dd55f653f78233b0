/// The tables of operators: in stages, or as one kernel where that is possible.
#include <algorithm>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "../host/access.hpp"
#include "../jit/compiler.hpp"
#include "../jit/tell.hpp"
#include "fused.hpp"
#include "staged.hpp"
#include "tables.hpp"

namespace hg::gpu {

using host::chk, host::wall;

namespace {

/// What an operator keeps once it was used.
struct Kept {
  std::unique_ptr<Calls> parts;  ///< of a composite
  std::unique_ptr<StagedOperator> staged;
  std::map<Purpose, std::unique_ptr<FusedOperator>> fused;  ///< that were tried; NULL: it is not taken
  bool core_contracts = false;                              ///< an assembly was left to it, which begins now
};

/// NULL where it was not used yet.
Kept *kept_of(CeedOperator op) {
  Kept *kept = nullptr;
  chk(CeedOperatorGetData(op, &kept));
  return kept;
}

Kept &own_kept_of(CeedOperator op) {
  return kept_with<Kept>(op, CeedOperatorGetData, CeedOperatorSetData);
}

int create(CeedOperator op, const CeedProgram *) {
  return CeedOperatorSetData(op, nullptr);  // memory is for those that are used
}

int destroy(CeedOperator op) {
  return wall(CeedOperatorReturnCeed(op), [&] {
    delete kept_of(op);
    chk(CeedOperatorSetData(op, nullptr));
  });
}

StagedOperator &staged_of(CeedOperator op, const CeedProgram &program) {
  auto &staged = own_kept_of(op).staged;
  if (staged == nullptr) {
    staged = std::make_unique<StagedOperator>(Device::of(CeedOperatorReturnCeed(op)), program);
  }
  return *staged;
}

void prepare_staged(CeedOperator op, const CeedProgram &program) {
  PointFunction *function = function_of(program.qf);
  if (function == nullptr) return;
  function->prepare();
  staged_of(op, program);
}

/// What is the same for both: vectors that an operator has, and kernels of the library.
void prepare_device(CeedOperator op, const CeedProgram &program) {
  Device::of(CeedOperatorReturnCeed(op)).prepare();
  const auto bring = [](CeedVector vec) {
    bool has_values = false;
    chk(CeedVectorHasValidArray(vec, &has_values));
    if (has_values) chk(CeedVectorSyncArray(vec, CEED_MEM_DEVICE));
  };
  for (CeedInt s = 0; s < program.num_sources; s++) {
    if (!program.sources[s].is_active) bring(program.sources[s].vec);
  }
  if (program.at_points) bring(program.points);
}

void apply_staged(CeedOperator op, const CeedProgram &program, CeedVector in, CeedVector out, CeedApplyMode mode) {
  PointFunction *function = function_of(program.qf);
  if (function == nullptr) return chk(parents_tables().op.apply_add(op, &program, in, out, mode));
  staged_of(op, program).apply_add(program, *function, in, out, mode);
}

int prepare_in_stages(CeedOperator op, const CeedProgram *program, CeedOperatorUse use) {
  if (use != CEED_USE_APPLY) return CEED_ERROR_SUCCESS;  // the reference assembles it, on the host
  return wall(CeedOperatorReturnCeed(op), [&] {
    prepare_device(op, *program);
    prepare_staged(op, *program);
  });
}

int apply_add_staged(CeedOperator op, const CeedProgram *program, CeedVector in, CeedVector out, CeedApplyMode mode) {
  return wall(CeedOperatorReturnCeed(op), [&] { apply_staged(op, *program, in, out, mode); });
}

/// Says where CEED_DEBUG asks for it that something is done in another way than as one kernel, as docs/backends.md has
/// it.
void tell_that_not_taken(CeedOperator op, Purpose purpose) {
  bool is_debug = false;
  const char *name = nullptr;
  chk(CeedIsDebug(CeedOperatorReturnCeed(op), &is_debug));
  if (!is_debug) return;
  chk(CeedOperatorGetName(op, &name));
  const std::string what = std::string("CeedOperator '") + name + "' is not one kernel: ";
  const char *how = purpose == Purpose::apply ? "it runs in stages" : "it is assembled on the host";
  jit::tell_once(what + how, what + how);
}

/// NULL where it is not taken.
FusedOperator *fused_of(CeedOperator op, const CeedProgram &program, Purpose purpose) {
  auto &fused = own_kept_of(op).fused;
  if (const auto found = fused.find(purpose); found != fused.end()) return found->second.get();
  std::unique_ptr<FusedOperator> made;
  try {
    made = FusedOperator::make(Device::of(CeedOperatorReturnCeed(op)), program, purpose);
    if (made == nullptr) tell_that_not_taken(op, purpose);
  } catch (const jit::NoSource &) {
    // Where the QFunction runs on the host, that is told there.
    if (purpose == Purpose::apply && function_of(program.qf) != nullptr) tell_that_not_taken(op, purpose);
  }
  return fused.emplace(purpose, std::move(made)).first->second.get();
}

Purpose purpose_of(CeedOperatorUse use) {
  switch (use) {
    case CEED_USE_ASSEMBLE_QFUNCTION:
      return Purpose::qfunction;
    case CEED_USE_ASSEMBLE:
      return Purpose::matrix;
    case CEED_USE_ASSEMBLE_DIAGONAL:
      return Purpose::diagonal;
    case CEED_USE_ASSEMBLE_POINT_BLOCKS:
      return Purpose::point_blocks;
    case CEED_USE_APPLY:
      break;
  }
  return Purpose::apply;
}

int prepare_fused(CeedOperator op, const CeedProgram *program, CeedOperatorUse use) {
  return wall(CeedOperatorReturnCeed(op), [&] {
    FusedOperator *fused = fused_of(op, *program, purpose_of(use));
    if (fused == nullptr && use != CEED_USE_APPLY) return;  // as above
    prepare_device(op, *program);
    if (fused != nullptr) {
      fused->prepare(*program);
    } else {
      prepare_staged(op, *program);
    }
  });
}

int apply_add_fused(CeedOperator op, const CeedProgram *program, CeedVector in, CeedVector out, CeedApplyMode mode) {
  return wall(CeedOperatorReturnCeed(op), [&] {
    if (FusedOperator *fused = fused_of(op, *program, Purpose::apply)) {
      fused->apply_add(*program, in, out, mode);
    } else {
      apply_staged(op, *program, in, out, mode);
    }
  });
}

/// Whether a program may be applied while others add to the same entries.
bool adds_atomically(const CeedProgram &program) {
  return std::all_of(program.outputs, program.outputs + program.num_outputs, is_evaluated);
}

/// Parts that are one kernel each are launched as one. Those that are not come first, so that no array changes its
/// place or is copied between the making of a call and its launch.
int apply_add_parts(CeedOperator composite, CeedInt num_parts, const CeedOperator *parts,
                    const CeedProgram *const *programs, const CeedVector *in, const CeedVector *out) {
  const Ceed ceed = CeedOperatorReturnCeed(composite);
  return wall(ceed, [&] {
    std::vector<std::pair<FusedOperator *, CeedInt>> joined;  // and the parts' numbers
    for (CeedInt i = 0; i < num_parts; i++) {
      FusedOperator *fused = fused_of(parts[i], *programs[i], Purpose::apply);
      if (fused == nullptr) {
        apply_staged(parts[i], *programs[i], in[i], out[i], CEED_APPLY_ADD_ALL);
      } else if (adds_atomically(*programs[i])) {
        joined.emplace_back(fused, i);
      } else {
        fused->apply_add(*programs[i], in[i], out[i], CEED_APPLY_ADD_ALL);
      }
    }
    std::vector<Call> calls;
    for (const auto &[fused, i] : joined) {
      calls.push_back(fused->call_of(*programs[i], in[i], out[i], CEED_APPLY_ADD_ALL));
      if (calls.back().launch.num_blocks == 0) calls.pop_back();
    }
    Device &device = Device::of(ceed);
    const auto one_thread = device.lock();
    auto &kept = own_kept_of(composite).parts;
    if (kept == nullptr) kept = device.driver().make_calls();
    if (!calls.empty()) kept->launch(calls);
    for (const auto &[fused, i] : joined) fused->check(*programs[i]);
  });
}

/// All elements. Where the core contracts them itself, on the host and some elements at a time, they are the
/// reference's.
int linear_assemble_qfunction(CeedOperator op, const CeedProgram *program, CeedInt first_elem, CeedInt num_elem,
                              CeedVector values) {
  return wall(CeedOperatorReturnCeed(op), [&] {
    const bool is_contracted = std::exchange(own_kept_of(op).core_contracts, false);
    const bool is_whole = first_elem == 0 && num_elem == program->num_elem && !is_contracted;
    FusedOperator *fused = is_whole ? fused_of(op, *program, Purpose::qfunction) : nullptr;
    if (fused != nullptr) return fused->assemble(*program, 0, values);
    chk(parents_tables().op.linear_assemble_qfunction(op, program, first_elem, num_elem, values));
  });
}

Purpose purpose_of(CeedAssembleKind kind) {
  switch (kind) {
    case CEED_ASSEMBLE_MATRIX:
      return Purpose::matrix;
    case CEED_ASSEMBLE_DIAGONAL:
      return Purpose::diagonal;
    case CEED_ASSEMBLE_POINT_BLOCKS:
      break;
  }
  return Purpose::point_blocks;
}

int linear_assemble(CeedOperator op, const CeedProgram *program, CeedAssembleKind kind, CeedSize offset,
                    CeedVector values, bool *is_done) {
  return wall(CeedOperatorReturnCeed(op), [&] {
    FusedOperator *fused = fused_of(op, *program, purpose_of(kind));
    if (fused != nullptr) fused->assemble(*program, offset, values);
    *is_done = fused != nullptr;
    own_kept_of(op).core_contracts = fused == nullptr;
  });
}

int get_memory(CeedOperator op, CeedSize *bytes) {
  return wall(CeedOperatorReturnCeed(op), [&] {
    *bytes = 0;
    const Kept *kept = kept_of(op);
    if (kept == nullptr) return;
    *bytes = sizeof *kept;
    if (kept->parts != nullptr) *bytes += static_cast<CeedSize>(kept->parts->num_bytes());
    if (kept->staged != nullptr) *bytes += static_cast<CeedSize>(kept->staged->num_bytes());
    for (const auto &[purpose, fused] : kept->fused) {
      if (fused != nullptr) *bytes += static_cast<CeedSize>(fused->num_bytes());
    }
  });
}

}  // namespace

// In stages all is assembled by the reference, on the host.
void fill_operator_ops(CeedOperatorOps &ops, bool is_fused) {
  ops.create = create;
  ops.destroy = destroy;
  ops.prepare = is_fused ? prepare_fused : prepare_in_stages;
  ops.apply_add = is_fused ? apply_add_fused : apply_add_staged;
  if (is_fused) ops.apply_add_parts = apply_add_parts;
  if (is_fused) ops.linear_assemble_qfunction = linear_assemble_qfunction;
  if (is_fused) ops.linear_assemble = linear_assemble;
  ops.get_memory = get_memory;
}

}  // namespace hg::gpu
