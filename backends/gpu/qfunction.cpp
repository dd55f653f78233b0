#include "qfunction.hpp"

#include "../host/access.hpp"
#include "../jit/compiler.hpp"
#include "../jit/tell.hpp"
#include "tables.hpp"
#include "texts.hpp"

namespace hg::gpu {

using host::chk, host::wall;

namespace {

/// Sizes of a QFunction's fields, in braces.
std::string sizes(const CeedQFunctionField *fields, CeedInt count) {
  std::string list = "{";
  for (CeedInt i = 0; i < count; i++) {
    CeedInt size = 0;
    chk(CeedQFunctionFieldGetSize(fields[i], &size));
    list += std::to_string(size) + ", ";
  }
  return list + (count == 0 ? "1}" : "}");
}

std::string text_of(CeedQFunction qf, const FunctionText &function) {
  CeedInt num_inputs = 0, num_outputs = 0, vector_length = 1;
  CeedQFunctionField *inputs = nullptr, *outputs = nullptr;
  chk(CeedQFunctionGetFields(qf, &num_inputs, &inputs, &num_outputs, &outputs));
  chk(CeedQFunctionGetVectorLength(qf, &vector_length));
  return function.text + "#line 1 \"qfunction.hpp\"\n" + define("HG_VECTOR_LENGTH", std::to_string(vector_length)) +
         define("HG_NUM_INPUTS", std::to_string(num_inputs)) + define("HG_NUM_OUTPUTS", std::to_string(num_outputs)) +
         define("HG_INPUT_SIZES", sizes(inputs, num_inputs)) + define("HG_OUTPUT_SIZES", sizes(outputs, num_outputs)) +
         text("qfunction.hpp");
}

}  // namespace

std::string kernel_text(CeedQFunction qf) {
  return text_of(qf, FunctionText(qf));
}

PointFunction::PointFunction(Device &device, CeedQFunction qf) : PointFunction(device, qf, FunctionText(qf)) {}

PointFunction::PointFunction(Device &device, CeedQFunction qf, const FunctionText &function)
    : device_(&device), state_(device, qf, function.may_fail) {
  chk(CeedQFunctionGetVectorLength(qf, &vector_length_));
  module_ = device.driver().compile("QFunction " + function.name, text_of(qf, function));
  kernel_ = module_->kernel("hg_qfunction");
}

void PointFunction::prepare() {
  const auto one_thread = device_->lock();
  state_.context();
}

int PointFunction::call(const Points &points, const std::vector<const CeedScalar *> &inputs,
                        const std::vector<CeedScalar *> &outputs) {
  const auto one_thread = device_->lock();
  std::vector<const void *> pointers(inputs.begin(), inputs.end());
  pointers.insert(pointers.end(), outputs.begin(), outputs.end());
  if (pointers != pointers_) {
    arrays_ = device_->upload(pointers);
    pointers_ = std::move(pointers);
  }
  const QFunctionJob job{.points = points.facts(),
                         .inputs = arrays_.as<const CeedScalar *const>(),
                         .outputs = arrays_.as<CeedScalar *const>() + inputs.size(),
                         .context = state_.context(),
                         .failed = state_.clear_failed()};
  device_->run(kernel_, (points.facts().num_points + vector_length_ - 1) / vector_length_, job);
  return state_.returned();
}

namespace {

/// What a QFunction keeps: its function on the device, or that it has none.
struct Kept {
  std::unique_ptr<PointFunction> function;
};

int create(CeedQFunction qf) {
  return CeedQFunctionSetData(qf, nullptr);  // it is compiled when it is called
}

int destroy(CeedQFunction qf) {
  Kept *kept = nullptr;
  CeedCallBackend(CeedQFunctionGetData(qf, &kept));
  delete kept;
  return CEED_ERROR_SUCCESS;
}

/// How an output of Q points is written: what a longer vector has beyond them stays.
host::Writer::Mode mode_of(CeedVector vec, CeedQFunctionField field, CeedInt Q) {
  CeedInt size = 0;
  CeedSize length = 0;
  bool has_values = false;
  chk(CeedQFunctionFieldGetSize(field, &size));
  chk(CeedVectorGetLength(vec, &length));
  chk(CeedVectorHasValidArray(vec, &has_values));
  const bool is_longer = length > static_cast<CeedSize>(Q) * size;
  return is_longer && has_values ? host::Writer::read_write : host::Writer::write_only;
}

int apply(CeedQFunction qf, CeedInt Q, const CeedVector *u, const CeedVector *v) {
  return wall(CeedQFunctionReturnCeed(qf), [&] {
    PointFunction *function = function_of(qf);
    if (function == nullptr) return chk(parents_tables().qfunction.apply(qf, Q, u, v));
    CeedInt num_inputs = 0, num_outputs = 0;
    CeedQFunctionField *fields = nullptr;
    chk(CeedQFunctionGetFields(qf, &num_inputs, nullptr, &num_outputs, &fields));
    std::vector<std::unique_ptr<host::Reader>> readers;
    std::vector<std::unique_ptr<host::Writer>> writers;
    std::vector<const CeedScalar *> inputs;
    std::vector<CeedScalar *> outputs;
    for (CeedInt i = 0; i < num_inputs; i++) {
      readers.push_back(std::make_unique<host::Reader>(u[i], CEED_MEM_DEVICE));
      inputs.push_back(readers.back()->data());
    }
    for (CeedInt i = 0; i < num_outputs; i++) {
      writers.push_back(std::make_unique<host::Writer>(v[i], mode_of(v[i], fields[i], Q), CEED_MEM_DEVICE));
      outputs.push_back(writers.back()->data());
    }
    const int code = function->call(Points(1, Q), inputs, outputs);
    for (const auto &writer : writers) writer->release();
    for (const auto &reader : readers) reader->release();
    host::check_returned(qf, code);
  });
}

}  // namespace

PointFunction *function_of(CeedQFunction qf) {
  const Ceed ceed = CeedQFunctionReturnCeed(qf);
  Device &device = Device::of(ceed);
  const auto one_thread = device.lock();
  Kept *kept = nullptr;
  chk(CeedQFunctionGetData(qf, &kept));
  if (kept == nullptr) {
    auto made = std::make_unique<Kept>();
    try {
      made->function = std::make_unique<PointFunction>(device, qf);
    } catch (const jit::NoSource &reason) {
      const char *name = nullptr;
      chk(CeedQFunctionGetName(qf, &name));
      const std::string what = device.driver().properties().name + ": the QFunction '" + name + "' runs on the host: ";
      jit::tell_once(what, what + reason.what());
    }
    chk(CeedQFunctionSetData(qf, made.get()));
    kept = made.release();
  }
  return kept->function.get();
}

void fill_qfunction_ops(CeedQFunctionOps &ops) {
  ops = {
      .create = create, .destroy = destroy, .apply = apply, .set_cuda_function = nullptr, .set_hip_function = nullptr};
}

}  // namespace hg::gpu
