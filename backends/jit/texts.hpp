/// @file
/// Files that travel in a plugin as text, because they are compiled at run time.
#pragma once

#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

namespace hg::jit {

struct Text {
  const char *name;  ///< under which it is included
  const char *text;
};
/// Made by hg_embed_texts() in CMake.
using Texts = std::span<const Text>;

/// The text that is included under a name.
inline std::string text_of(Texts texts, std::string_view name) {
  for (const Text &text : texts) {
    if (text.name == name) return text.text;
  }
  throw std::logic_error("there is no text '" + std::string(name) + "'");
}

}  // namespace hg::jit
