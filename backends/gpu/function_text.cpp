#include "function_text.hpp"

#include <cctype>
#include <map>
#include <set>
#include <string_view>

#include "../host/access.hpp"
#include "../jit/compiler.hpp"
#include "../jit/flatten.hpp"
#include "../jit/source.hpp"
#include "texts.hpp"

namespace hg::gpu {

using host::chk;

namespace {

/// Where the line goes on after the backslash `at`, which may be followed by blanks; `at` where it does not.
std::size_t end_of_continuation(std::string_view text, std::size_t at) {
  const auto end = text.find_first_not_of(" \t\r", at + 1);
  return text[at] == '\\' && end != std::string_view::npos && text[end] == '\n' ? end : at;
}

/// A text without its comments, what literals say, and ends of lines that are continued.
std::string bare(std::string_view all) {
  std::string text, code;
  for (std::size_t i = 0; i < all.size(); i++) {
    const std::size_t end = end_of_continuation(all, i);
    if (end == i) text += all[i];
    i = end;
  }
  for (std::size_t i = 0; i < text.size(); i++) {
    const std::string_view two = std::string_view(text).substr(i, 2);
    const auto skip_to = [&](std::string_view end) {
      const auto found = text.find(end, i + 2);
      i = found == std::string::npos ? text.size() : found + end.size() - 1;
    };
    const bool is_separator = i > 0 && std::isdigit(static_cast<unsigned char>(text[i - 1])) != 0;  // 1'000
    if (two == "//") {
      skip_to("\n");
      code += '\n';
    } else if (two == "/*") {
      skip_to("*/");
      code += ' ';
    } else if (text[i] == '"' || (text[i] == '\'' && !is_separator)) {
      const char quote = text[i];
      for (i++; i < text.size() && text[i] != quote && text[i] != '\n'; i++) i += text[i] == '\\' ? 1 : 0;
      code += i < text.size() && text[i] == '\n' ? "0\n" : "0";
    } else {
      code += text[i];
    }
  }
  return code;
}

bool is_of_word(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

/// The words of a text that begin at `at` or later; empty at its end.
std::string_view next_word(std::string_view text, std::size_t &at) {
  while (at < text.size() && !is_of_word(text[at])) at++;
  const std::size_t begin = at;
  while (at < text.size() && is_of_word(text[at])) at++;
  return text.substr(begin, at - begin);
}

bool has_word(std::string_view text, const std::set<std::string, std::less<>> &words) {
  std::size_t at = 0;
  for (auto word = next_word(text, at); !word.empty(); word = next_word(text, at)) {
    if (words.contains(word)) return true;
  }
  return false;
}

/// The macros that return, by themselves or by others.
std::set<std::string, std::less<>> returning_macros(std::string_view code) {
  std::map<std::string, std::string, std::less<>> macros;  // all that a name stands for anywhere
  for (auto line = code.find("#"); line != std::string_view::npos; line = code.find("#", line + 1)) {
    std::size_t at = line;
    if (next_word(code, at) != "define") continue;
    const std::string name(next_word(code, at));
    macros[name] += ' ' + std::string(code.substr(at, code.find('\n', at) - at));
  }
  std::set<std::string, std::less<>> returning{"return"};
  for (std::size_t before = 0; before != returning.size();) {
    before = returning.size();
    for (const auto &[name, text] : macros) {
      if (has_word(text, returning)) returning.insert(name);
    }
  }
  returning.erase("return");
  return returning;
}

/// Whether a body, up to the brace that closes it, returns other things than 0 and the name of success.
bool body_may_fail(std::string_view code, const std::set<std::string, std::less<>> &macros) {
  std::size_t end = 0;
  for (int depth = 0; end < code.size(); end++) {
    depth += code[end] == '{' ? 1 : code[end] == '}' ? -1 : 0;
    if (depth == 0) break;
  }
  const std::string_view body = code.substr(0, end), word = "return";
  if (has_word(body, macros)) return true;
  for (auto at = body.find(word); at != std::string_view::npos; at = body.find(word, at + 1)) {
    std::string value(body.substr(at + word.size(), body.find(';', at) - at - word.size()));
    std::erase_if(value, [](unsigned char c) { return std::isspace(c) != 0; });
    if (value != "0" && value != "CEED_ERROR_SUCCESS") return true;
  }
  return false;
}

/// Whether a QFunction may return anything else than 0, by its text, which is not preprocessed: by any of its bodies,
/// or where none is found.
bool may_fail(const std::string &text, const std::string &function) {
  const std::string code = bare(text), head = "CEED_QFUNCTION(" + function + ")";
  const auto macros = returning_macros(code);
  bool is_found = false;
  for (auto name = code.find(head); name != std::string::npos; name = code.find(head, name + 1)) {
    const auto begin = code.find('{', name);
    if (begin == std::string::npos) break;
    is_found = true;
    if (body_may_fail(std::string_view(code).substr(begin), macros)) return true;
  }
  return !is_found;
}

}  // namespace

FunctionText::FunctionText(CeedQFunction qf) {
  jit::Source source;
  std::string function;
  try {
    source = jit::Source::of(qf);
    function = jit::flatten(source);
  } catch (const jit::NoSource &) {
    throw;
  } catch (const jit::NotCompiled &reason) {
    const char *qf_name = nullptr;
    chk(CeedQFunctionGetName(qf, &qf_name));
    throw jit::NotCompiled("the QFunction '" + std::string(qf_name) + "' is not compiled: " + reason.what());
  }
  const jit::Defines defines = jit::lines_of(source.defines);
  CeedInt vector_length = 1;
  chk(CeedQFunctionGetVectorLength(qf, &vector_length));
  name = source.function;
  may_fail = gpu::may_fail(defines.begin + function, source.function);
  text = define("CEED_Q_VLA", std::to_string(vector_length)) + first_text() + defines.begin + function + defines.end +
         define("HG_QFUNCTION", "::" + source.function);
}

std::string define(const std::string &name, const std::string &value) {
  return "#define " + name + ' ' + value + '\n';
}

FunctionState::FunctionState(Device &device, CeedQFunction qf, bool may_fail)
    : device_(&device), qf_(qf), may_fail_(may_fail) {}

FunctionState::~FunctionState() {
  CeedQFunctionContextDestroy(&uploaded_);
}

namespace {

/// A context that is held, and its data read, for a scope.
class HeldContext {
 public:
  explicit HeldContext(CeedQFunction qf) { chk(CeedQFunctionGetInnerContext(qf, &context_)); }
  HeldContext(const HeldContext &) = delete;
  HeldContext &operator=(const HeldContext &) = delete;
  ~HeldContext() {
    if (data_ != nullptr) CeedQFunctionContextRestoreDataRead(context_, &data_);
    CeedQFunctionContextDestroy(&context_);
  }
  CeedQFunctionContext get() const { return context_; }
  const void *read() {
    chk(CeedQFunctionContextGetDataRead(context_, CEED_MEM_HOST, &data_));
    return data_;
  }
  void release() { chk(CeedQFunctionContextRestoreDataRead(context_, &data_)); }

 private:
  CeedQFunctionContext context_ = nullptr;
  const void *data_ = nullptr;
};

}  // namespace

void *FunctionState::context() {
  HeldContext context(qf_);
  if (context.get() == nullptr) return nullptr;
  std::uint64_t state = 0;
  std::size_t size = 0;
  chk(CeedQFunctionContextGetState(context.get(), &state));
  chk(CeedQFunctionContextGetContextSize(context.get(), &size));
  if (context_ && context.get() == uploaded_ && state == context_state_) return context_.as<void>();
  const void *data = context.read();
  if (!context_ || context_.num_bytes() != size) context_ = device_->allocate(size);
  device_->driver().copy_to_device(context_.as<void>(), data, size);
  context.release();
  chk(CeedQFunctionContextReferenceCopy(context.get(), &uploaded_));
  context_state_ = state;
  return context_.as<void>();
}

int *FunctionState::clear_failed() {
  if (!may_fail_) return nullptr;
  if (!failed_) failed_ = device_->allocate(sizeof(int));
  if (!is_clear_) device_->driver().clear(failed_.as<void>(), sizeof(int));
  is_clear_ = false;  // whatever comes between now and returned()
  return failed_.as<int>();
}

int FunctionState::returned() {
  int code = 0;
  if (may_fail_) device_->driver().copy_to_host(&code, failed_.as<void>(), sizeof code);
  is_clear_ = code == 0;
  return code;
}

}  // namespace hg::gpu
