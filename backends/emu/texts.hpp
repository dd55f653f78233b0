/// @file
/// What the emulator says first of each text.
#pragma once

#include "../jit/texts.hpp"

namespace hg::emu {

extern const jit::Texts texts;

}  // namespace hg::emu
