/// @file
/// What the environment says, and what is said to people.
#pragma once

#include <string>

namespace hg::jit {

/// Whether a variable of the environment is there, and neither empty nor 0.
bool is_set(const char *variable);
/// Tells a text on standard error, once in a process for each key.
void tell_once(const std::string &key, const std::string &text);

}  // namespace hg::jit
