#include "qfunction.hpp"

#include <algorithm>
#include <numeric>

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

namespace {

/// A text that was compiled.
class CompiledFunction : public PointFunction {
 public:
  /// Throws jit::NoSource where there is none, jit::NotCompiled or DeviceError where it cannot be compiled.
  CompiledFunction(Device &device, CeedQFunction qf) : CompiledFunction(device, qf, FunctionText(qf)) {}
  int call(const Points &points, const std::vector<const CeedScalar *> &inputs,
           const std::vector<CeedScalar *> &outputs) override;

 private:
  CompiledFunction(Device &device, CeedQFunction qf, const FunctionText &function)
      : PointFunction(device, qf, function.may_fail) {
    chk(CeedQFunctionGetVectorLength(qf, &vector_length_));
    module_ = device.driver().compile("QFunction " + function.name, text_of(qf, function));
    kernel_ = module_->kernel("hg_qfunction");
  }

  std::unique_ptr<Module> module_;
  Kernel kernel_;
  CeedInt vector_length_ = 1;
  Buffer arrays_;
  std::vector<const void *> pointers_;  ///< what arrays_ holds
};

int CompiledFunction::call(const Points &points, const std::vector<const CeedScalar *> &inputs,
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

/// A kernel that the user has loaded. It wants the points of all elements component by component, and gets so many of
/// them at a time that copies of them are small beside what operators have.
class UserFunction : public PointFunction {
 public:
  /// Throws jit::NoSource where it has more fields than such kernels take.
  UserFunction(Device &device, CeedQFunction qf, void *kernel) : PointFunction(device, qf, false), kernel_(kernel) {
    CeedInt num_inputs = 0, num_outputs = 0;
    CeedQFunctionField *inputs = nullptr, *outputs = nullptr;
    chk(CeedQFunctionGetFields(qf, &num_inputs, &inputs, &num_outputs, &outputs));
    if (std::max(num_inputs, num_outputs) > UserFields::most) {
      throw jit::NoSource("its kernel was given without text, and takes up to " + std::to_string(UserFields::most) +
                          " inputs and outputs; it has " + std::to_string(num_inputs) + " and " +
                          std::to_string(num_outputs));
    }
    const auto sizes_of = [](const CeedQFunctionField *fields, CeedInt count) {
      std::vector<CeedInt> sizes(count);
      for (CeedInt i = 0; i < count; i++) chk(CeedQFunctionFieldGetSize(fields[i], &sizes[i]));
      return sizes;
    };
    input_sizes_ = sizes_of(inputs, num_inputs);
    output_sizes_ = sizes_of(outputs, num_outputs);
  }
  int call(const Points &points, const std::vector<const CeedScalar *> &inputs,
           const std::vector<CeedScalar *> &outputs) override;

 private:
  static constexpr CeedSize most_points = 1 << 20;  ///< at a time: enough to keep a device busy

  void *kernel_;
  std::vector<CeedInt> input_sizes_, output_sizes_;
  Buffer copies_;
};

int UserFunction::call(const Points &points, const std::vector<const CeedScalar *> &inputs,
                       const std::vector<CeedScalar *> &outputs) {
  const auto one_thread = device_->lock();
  const PointsOfElements &all = points.facts();
  void *context = state_.context();
  UserFields fields;
  if (all.starts == nullptr && all.num_points == all.num_qpts) {  // one element has its fields as the kernel wants them
    std::copy(inputs.begin(), inputs.end(), fields.inputs);
    std::copy(outputs.begin(), outputs.end(), fields.outputs);
    device_->driver().launch_user(kernel_, context, all.num_qpts, fields);
    return 0;
  }
  const CeedSize at_once = std::min(all.num_points, most_points);
  const CeedInt size = std::accumulate(input_sizes_.begin(), input_sizes_.end(), CeedInt{0}) +
                       std::accumulate(output_sizes_.begin(), output_sizes_.end(), CeedInt{0});
  const std::size_t bytes = at_once * size * sizeof(CeedScalar);
  if (copies_.num_bytes() < bytes) copies_ = device_->allocate(bytes);
  for (LayoutJob job{.points = all}; job.first < all.num_points; job.first += job.count) {
    job.count = std::min(at_once, all.num_points - job.first);
    CeedScalar *copy = copies_.as<CeedScalar>();
    job.is_to_user = true;
    for (std::size_t i = 0; i < inputs.size(); i++) {
      job.size = input_sizes_[i];
      job.from = inputs[i];
      fields.inputs[i] = job.to = copy;
      device_->run("hg_layout", job.count, job);
      copy += job.count * job.size;
    }
    for (std::size_t o = 0; o < outputs.size(); o++) {
      fields.outputs[o] = copy;
      copy += job.count * output_sizes_[o];
    }
    device_->driver().launch_user(kernel_, context, static_cast<CeedInt>(job.count), fields);
    job.is_to_user = false;
    for (std::size_t o = 0; o < outputs.size(); o++) {
      job.size = output_sizes_[o];
      job.from = fields.outputs[o];
      job.to = outputs[o];
      device_->run("hg_layout", job.count, job);
    }
  }
  return 0;
}

/// What a QFunction keeps.
struct Kept {
  void *user_kernel = nullptr;
  bool is_made = false;                     ///< what it runs as was found out
  std::unique_ptr<PointFunction> function;  ///< NULL: on the host
};

Kept &kept_of(CeedQFunction qf) {
  return kept_with<Kept>(qf, CeedQFunctionGetData, CeedQFunctionSetData);
}

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
  Device &device = Device::of(CeedQFunctionReturnCeed(qf));
  const auto one_thread = device.lock();
  Kept &kept = kept_of(qf);
  if (kept.is_made) return kept.function.get();
  try {
    try {
      kept.function = std::make_unique<CompiledFunction>(device, qf);
    } catch (const jit::NoSource &) {
      if (kept.user_kernel == nullptr) throw;
      kept.function = std::make_unique<UserFunction>(device, qf, kept.user_kernel);
    }
  } catch (const jit::NoSource &reason) {
    const char *name = nullptr;
    chk(CeedQFunctionGetName(qf, &name));
    const std::string what = device.driver().properties().name + ": the QFunction '" + name + "' runs on the host: ";
    jit::tell_once(what, what + reason.what());
  }
  kept.is_made = true;
  return kept.function.get();
}

namespace {

/// What the handle of a vendor's kernel points to is the driver's affair.
template <typename Handle>
int set_user_kernel(CeedQFunction qf, Handle *kernel) {
  const Ceed ceed = CeedQFunctionReturnCeed(qf);
  return wall(ceed, [&] {
    const auto one_thread = Device::of(ceed).lock();
    kept_of(qf) = {.user_kernel = kernel, .is_made = false, .function = nullptr};
  });
}

}  // namespace

void fill_qfunction_ops(CeedQFunctionOps &ops, UserKernels user_kernels) {
  ops = {.create = create,
         .destroy = destroy,
         .apply = apply,
         .set_cuda_function = user_kernels == UserKernels::hip ? nullptr : set_user_kernel<CUfunc_st>,
         .set_hip_function = user_kernels == UserKernels::cuda ? nullptr : set_user_kernel<ihipModuleSymbol_t>};
}

}  // namespace hg::gpu
