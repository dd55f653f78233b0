/// @file
/// Headers that are compiled at run time, as text; filled in by CMake.
#pragma once

namespace hg::gen {

struct HostText {
  const char *name;  ///< as it is included
  const char *text;
};

extern const HostText host_texts[HG_NUM_HOST_TEXTS];

}  // namespace hg::gen
