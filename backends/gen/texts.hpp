/// @file
/// Our own headers, which printed texts include.
#pragma once

#include "../jit/texts.hpp"

namespace hg::gen {

extern const jit::Texts texts;

}  // namespace hg::gen
