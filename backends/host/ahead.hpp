/// @file
/// What kernels do with Ahead.
#pragma once

#include "kernels.hpp"

namespace hg::host::HG_HOST_ISA {

/// One step of Ahead.
[[gnu::always_inline]] inline void ask(Ahead &ahead) {
  for (CeedInt i = 0; i < ahead.lines; i++, ahead.next += Ahead::line) {
    __builtin_prefetch(reinterpret_cast<const void *>(ahead.next), 0, 2);
  }
}

}  // namespace hg::host::HG_HOST_ISA
