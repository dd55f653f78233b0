/// QFunctions and operators: the parent calls a stand-in, which calls the QFunction with guarded arrays.
#include <cstring>
#include <exception>
#include <string>
#include <utility>
#include <vector>

#include "state.hpp"

namespace hg::memcheck {

namespace {

struct Field {
  std::string name;
  CeedInt size = 0;
};

/// A QFunction while the parent works with its stand-in.
struct Call {
  std::string name;
  CeedQFunctionUser function = nullptr;
  std::vector<Field> inputs, outputs;
  std::size_t context_size = 0;
  bool is_context_writable = false;
  std::string failure;  ///< the first misuse

  void fail(std::string text) {
    if (failure.empty()) failure = "QFunction '" + name + "' " + std::move(text);
  }
};

thread_local Call *current = nullptr;

std::vector<GuardedArray> guard(const std::vector<Field> &fields, CeedInt Q, const CeedScalar *const *values) {
  std::vector<GuardedArray> arrays;
  for (std::size_t i = 0; i < fields.size(); i++) {
    arrays.emplace_back(values != nullptr ? values[i] : nullptr, static_cast<CeedSize>(fields[i].size) * Q);
  }
  return arrays;
}

std::string place(CeedSize entry, CeedInt Q) {
  return "component " + std::to_string(entry / Q) + " at point " + std::to_string(entry % Q) + " of " +
         std::to_string(Q);
}

/// What the QFunction did to its arguments.
void judge(Call &call, CeedInt Q, const std::vector<GuardedArray> &in, const CeedScalar *const *in_values,
           const std::vector<GuardedArray> &out) {
  for (std::size_t i = 0; i < in.size(); i++) {
    const CeedSize changed = in[i].first_difference(in_values[i]);
    if (changed >= 0) call.fail("changed its input '" + call.inputs[i].name + "': " + place(changed, Q));
    if (!in[i].is_sound()) call.fail("wrote beside its input '" + call.inputs[i].name + "'");
  }
  for (std::size_t i = 0; i < out.size(); i++) {
    const CeedSize unset = out[i].first_unset();
    if (unset >= 0) call.fail("left its output '" + call.outputs[i].name + "' unwritten: " + place(unset, Q));
    if (!out[i].is_sound()) call.fail("wrote beside its output '" + call.outputs[i].name + "'");
  }
}

/// The stand-in.
int stand_in(void *ctx, CeedInt Q, const CeedScalar *const *in, CeedScalar *const *out) {
  Call &call = *current;
  std::vector<GuardedArray> guarded_in = guard(call.inputs, Q, in), guarded_out = guard(call.outputs, Q, nullptr);
  std::vector<const CeedScalar *> inputs;
  std::vector<CeedScalar *> outputs;
  for (auto &array : guarded_in) inputs.push_back(array.data());
  for (auto &array : guarded_out) outputs.push_back(array.data());
  const auto *context = static_cast<const unsigned char *>(ctx);
  const std::vector<unsigned char> before(context, context + (context != nullptr ? call.context_size : 0));

  const int code = call.function(ctx, Q, inputs.data(), outputs.data());

  if (!call.is_context_writable && !before.empty() && std::memcmp(before.data(), ctx, before.size()) != 0) {
    call.fail("wrote to its context: Context data changed while accessed in read-only mode");
    std::memcpy(ctx, before.data(), before.size());
  }
  if (code == 0) judge(call, Q, guarded_in, in, guarded_out);
  for (std::size_t i = 0; i < guarded_out.size(); i++) {
    std::memcpy(out[i], guarded_out[i].data(), static_cast<std::size_t>(guarded_out[i].length()) * sizeof(CeedScalar));
  }
  return code;
}

/// A stand-in for `qf` with its fields and its context, for one call of the parent.
class StandIn {
 public:
  StandIn() : outer_(std::exchange(current, &call_)) {}
  StandIn(const StandIn &) = delete;
  StandIn &operator=(const StandIn &) = delete;
  ~StandIn() {
    current = outer_;
    CeedQFunctionDestroy(&qf_);
  }
  operator CeedQFunction() const { return qf_; }

  int create(CeedQFunction qf) {
    CeedInt vec_length = 1;
    const char *name = nullptr, *path = nullptr;
    CeedCallBackend(CeedQFunctionGetUserFunction(qf, &call_.function));
    CeedCallBackend(CeedQFunctionGetVectorLength(qf, &vec_length));
    CeedCallBackend(CeedQFunctionGetKernelName(qf, &name));
    CeedCallBackend(CeedQFunctionGetSourcePath(qf, &path));
    call_.name = name;
    const std::string source = (path != nullptr ? std::string(path) + ":" : "") + name;
    CeedCallBackend(
        CeedQFunctionCreateInterior(CeedQFunctionReturnCeed(qf), vec_length, stand_in, source.c_str(), &qf_));
    CeedInt num_in = 0, num_out = 0;
    CeedQFunctionField *inputs = nullptr, *outputs = nullptr;
    CeedCallBackend(CeedQFunctionGetFields(qf, &num_in, &inputs, &num_out, &outputs));
    for (CeedInt i = 0; i < num_in; i++) CeedCallBackend(add(inputs[i], call_.inputs, CeedQFunctionAddInput));
    for (CeedInt i = 0; i < num_out; i++) CeedCallBackend(add(outputs[i], call_.outputs, CeedQFunctionAddOutput));
    return set_context(qf);
  }

  /// Reports the first misuse; otherwise hands on what the parent returned.
  int finish(CeedQFunction qf, int code) {
    CeedCheck(call_.failure.empty(), CeedQFunctionReturnCeed(qf), CEED_ERROR_BACKEND, "%s", call_.failure.c_str());
    return code;
  }

 private:
  int add(CeedQFunctionField field, std::vector<Field> &list,
          int (*add_field)(CeedQFunction, const char *, CeedInt, CeedEvalMode)) {
    const char *name = nullptr;
    CeedInt size = 0;
    CeedEvalMode mode = CEED_EVAL_NONE;
    CeedCallBackend(CeedQFunctionFieldGetName(field, &name));
    CeedCallBackend(CeedQFunctionFieldGetSize(field, &size));
    CeedCallBackend(CeedQFunctionFieldGetEvalMode(field, &mode));
    list.push_back({name, size});
    return add_field(qf_, name, size, mode);
  }

  int set_context(CeedQFunction qf) {
    CeedQFunctionContext ctx = nullptr;
    CeedCallBackend(CeedQFunctionGetContext(qf, &ctx));
    if (ctx == nullptr) return CEED_ERROR_SUCCESS;
    CeedCallBackend(CeedQFunctionContextGetContextSize(ctx, &call_.context_size));
    CeedCallBackend(CeedQFunctionIsContextWritable(qf, &call_.is_context_writable));
    CeedCallBackend(CeedQFunctionSetContext(qf_, ctx));
    CeedCallBackend(CeedQFunctionSetContextWritable(qf_, call_.is_context_writable));
    return CeedQFunctionContextDestroy(&ctx);
  }

  Call call_;
  Call *outer_;
  CeedQFunction qf_ = nullptr;
};

/// Calls work(stand-in); exceptions of this file's containers become errors.
template <typename F>
int with_stand_in(CeedQFunction qf, F &&work) {
  try {
    StandIn checked;
    CeedCallBackend(checked.create(qf));
    const InParent in_parent;
    return checked.finish(qf, work(checked));
  } catch (const std::bad_alloc &) {
    return CeedError(CeedQFunctionReturnCeed(qf), CEED_ERROR_BACKEND, "Out of memory");
  } catch (const std::exception &error) {
    return CeedError(CeedQFunctionReturnCeed(qf), CEED_ERROR_BACKEND, "%s", error.what());
  }
}

int apply(CeedQFunction qf, CeedInt Q, const CeedVector *u, const CeedVector *v) {
  return with_stand_in(qf, [&](CeedQFunction checked) { return parent().qfunction.apply(checked, Q, u, v); });
}

/// Calls work(program) with the stand-in in the operator's program.
template <typename F>
int with_program(const CeedProgram *program, F &&work) {
  for (CeedInt i = 0; i < program->num_sources; i++) CeedCallBackend(check_restriction(program->sources[i].rstr));
  for (CeedInt i = 0; i < program->num_sinks; i++) CeedCallBackend(check_restriction(program->sinks[i].rstr));
  return with_stand_in(program->qf, [&](CeedQFunction checked) {
    CeedProgram copy = *program;
    copy.qf = checked;
    return work(&copy);
  });
}

int apply_add(CeedOperator op, const CeedProgram *program, CeedVector in, CeedVector out, CeedApplyMode mode) {
  return with_program(program, [&](const CeedProgram *checked) {
    return parent().op.apply_add(op, checked, in, out, mode);
  });
}

int linear_assemble_qfunction(CeedOperator op, const CeedProgram *program, CeedInt first_elem, CeedInt num_elem,
                              CeedVector values) {
  return with_program(program, [&](const CeedProgram *checked) {
    return parent().op.linear_assemble_qfunction(op, checked, first_elem, num_elem, values);
  });
}

}  // namespace

void fill_qfunction_ops(CeedQFunctionOps &ops) {
  ops.apply = apply;
}

void fill_operator_ops(CeedOperatorOps &ops) {
  ops.apply_add = apply_add;
  ops.linear_assemble_qfunction = linear_assemble_qfunction;
}

}  // namespace hg::memcheck
