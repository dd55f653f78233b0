#include "texts.hpp"

namespace hg::gpu {

std::string text(std::string_view name) {
  return jit::text_of(texts, name);
}

namespace {

/// ceed/types.h with the header that it includes in its place.
std::string types() {
  const std::string_view include = "#include \"ceed-f64.h\"";
  std::string types = text("ceed/types.h");
  return types.replace(types.find(include), include.size(), text("ceed/ceed-f64.h"));
}

}  // namespace

std::string first_text() {
  return "#define HG_GPU_TEXT\n" + types() + text("jobs.hpp") + text("points.hpp");
}

std::string library_text() {
  return first_text() + text("vector.hpp") + text("restriction.hpp") + text("basis.hpp") + text("layout.hpp");
}

}  // namespace hg::gpu
