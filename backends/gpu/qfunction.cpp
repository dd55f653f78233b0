#include "qfunction.hpp"

#include <cctype>
#include <string>
#include <string_view>

#include "../host/access.hpp"
#include "../jit/compiler.hpp"
#include "../jit/flatten.hpp"
#include "../jit/source.hpp"
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

/// A text without its comments.
std::string without_comments(std::string_view text) {
  std::string code;
  for (std::size_t i = 0; i < text.size(); i++) {
    const std::string_view two = text.substr(i, 2);
    if (two != "//" && two != "/*") {
      code += text[i];
      continue;
    }
    const auto end = text.find(two == "//" ? "\n" : "*/", i + 2);
    if (end == std::string_view::npos) break;
    i = two == "//" ? end - 1 : end + 1;
  }
  return code;
}

/// Whether a QFunction returns other things than 0 and the name of success, by its text; so do those whose body is not
/// found.
bool may_fail(const std::string &text, const std::string &function) {
  const std::string code = without_comments(text);
  const auto name = code.find("CEED_QFUNCTION(" + function + ")");
  const auto begin = name == std::string::npos ? name : code.find('{', name);
  if (begin == std::string::npos) return true;
  auto end = begin;
  for (int depth = 0; end < code.size(); end++) {
    depth += code[end] == '{' ? 1 : code[end] == '}' ? -1 : 0;
    if (depth == 0) break;
  }
  const std::string_view body = std::string_view(code).substr(begin, end - begin), word = "return";
  for (auto at = body.find(word); at != std::string_view::npos; at = body.find(word, at + 1)) {
    std::string value(body.substr(at + word.size(), body.find(';', at) - at - word.size()));
    std::erase_if(value, [](unsigned char c) { return std::isspace(c) != 0; });
    if (value != "0" && value != "CEED_ERROR_SUCCESS") return true;
  }
  return false;
}

std::string text_of(CeedQFunction qf, const jit::Source &source, const std::string &function) {
  CeedInt num_inputs = 0, num_outputs = 0, vector_length = 1;
  CeedQFunctionField *inputs = nullptr, *outputs = nullptr;
  chk(CeedQFunctionGetFields(qf, &num_inputs, &inputs, &num_outputs, &outputs));
  chk(CeedQFunctionGetVectorLength(qf, &vector_length));
  const auto define = [](const char *name, const std::string &value) {
    return std::string("#define ") + name + ' ' + value + '\n';
  };
  const jit::Defines defines = jit::lines_of(source.defines);
  return define("CEED_Q_VLA", std::to_string(vector_length)) + first_text() + defines.begin + function + defines.end +
         "#line 1 \"qfunction.hpp\"\n" + define("HG_QFUNCTION", "::" + source.function) +
         define("HG_VECTOR_LENGTH", std::to_string(vector_length)) +
         define("HG_NUM_INPUTS", std::to_string(num_inputs)) + define("HG_NUM_OUTPUTS", std::to_string(num_outputs)) +
         define("HG_INPUT_SIZES", sizes(inputs, num_inputs)) + define("HG_OUTPUT_SIZES", sizes(outputs, num_outputs)) +
         text("qfunction.hpp");
}

}  // namespace

std::string kernel_text(CeedQFunction qf) {
  const jit::Source source = jit::Source::of(qf);
  return text_of(qf, source, jit::flatten(source));
}

PointFunction::PointFunction(Device &device, CeedQFunction qf) : device_(&device), qf_(qf) {
  const jit::Source source = jit::Source::of(qf);
  const std::string function = jit::flatten(source);
  may_fail_ = may_fail(function, source.function);
  chk(CeedQFunctionGetVectorLength(qf, &vector_length_));
  module_ = device.driver().compile("QFunction " + source.function, text_of(qf, source, function));
  kernel_ = module_->kernel("hg_qfunction");
}

/// The context's data on the device, as they are now.
void *PointFunction::context() {
  CeedQFunctionContext context = nullptr;
  chk(CeedQFunctionGetInnerContext(qf_, &context));
  if (context == nullptr) return nullptr;
  std::uint64_t state = 0;
  std::size_t size = 0;
  int code = CeedQFunctionContextGetState(context, &state);
  if (code == CEED_ERROR_SUCCESS) code = CeedQFunctionContextGetContextSize(context, &size);
  if (code == CEED_ERROR_SUCCESS && (!context_ || context != uploaded_ || state != context_state_)) {
    const void *data = nullptr;
    code = CeedQFunctionContextGetDataRead(context, CEED_MEM_HOST, &data);
    if (code == CEED_ERROR_SUCCESS) {
      if (!context_ || context_.num_bytes() != size) context_ = device_->allocate(size);
      device_->driver().copy_to_device(context_.as<void>(), data, size);
      context_state_ = state;
      uploaded_ = context;
      code = CeedQFunctionContextRestoreDataRead(context, &data);
    }
  }
  chk(CeedQFunctionContextDestroy(&context));
  chk(code);
  return context_.as<void>();
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
  int code = 0;
  if (may_fail_) {
    if (!failed_) failed_ = device_->allocate(sizeof code);
    device_->driver().copy_to_device(failed_.as<void>(), &code, sizeof code);
  }
  const QFunctionJob job{.points = points.facts(),
                         .inputs = arrays_.as<const CeedScalar *const>(),
                         .outputs = arrays_.as<CeedScalar *const>() + inputs.size(),
                         .context = context(),
                         .failed = may_fail_ ? failed_.as<int>() : nullptr};
  device_->run(kernel_, (points.facts().num_points + vector_length_ - 1) / vector_length_, job);
  if (may_fail_) device_->driver().copy_to_host(&code, failed_.as<void>(), sizeof code);
  return code;
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

int apply(CeedQFunction qf, CeedInt Q, const CeedVector *u, const CeedVector *v) {
  return wall(CeedQFunctionReturnCeed(qf), [&] {
    PointFunction *function = function_of(qf);
    if (function == nullptr) return chk(parents_tables().qfunction.apply(qf, Q, u, v));
    CeedInt num_inputs = 0, num_outputs = 0;
    chk(CeedQFunctionGetNumArgs(qf, &num_inputs, &num_outputs));
    std::vector<std::unique_ptr<host::Reader>> readers;
    std::vector<std::unique_ptr<host::Writer>> writers;
    std::vector<const CeedScalar *> inputs;
    std::vector<CeedScalar *> outputs;
    for (CeedInt i = 0; i < num_inputs; i++) {
      readers.push_back(std::make_unique<host::Reader>(u[i], CEED_MEM_DEVICE));
      inputs.push_back(readers.back()->data());
    }
    for (CeedInt i = 0; i < num_outputs; i++) {
      writers.push_back(std::make_unique<host::Writer>(v[i], host::Writer::write_only, CEED_MEM_DEVICE));
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
