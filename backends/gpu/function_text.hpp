/// @file
/// What kernels that call a QFunction share: its text, and what it is called with.
#pragma once

#include <ceed/plugin.h>

#include <cstdint>
#include <string>

#include "device.hpp"

namespace hg::gpu {

/// The text of a QFunction with all that it includes, after what every text begins with.
struct FunctionText {
  std::string name;  ///< of the function, which text has as HG_QFUNCTION
  std::string text;
  bool may_fail = true;  ///< it may return something else than 0

  /// Throws jit::NoSource where it came without text, jit::NotCompiled where that is not there.
  explicit FunctionText(CeedQFunction qf);
};

/// A line of text.
std::string define(const std::string &name, const std::string &value);

/// A QFunction's context on the device, and what it returned there. It may read its context; what it writes to it is
/// not seen on the host.
class FunctionState {
 public:
  FunctionState(Device &device, CeedQFunction qf, bool may_fail);
  FunctionState(const FunctionState &) = delete;
  FunctionState &operator=(const FunctionState &) = delete;
  ~FunctionState();

  /// The context's data as they are now, or NULL.
  void *context();
  /// Where kernels put what is not 0, for QFunctionJob::failed; NULL: it returns nothing else.
  int *clear_failed();
  /// What the QFunction has returned since then: waits for it where it may fail.
  int returned();

 private:
  Device *device_;
  CeedQFunction qf_;
  bool may_fail_;
  Buffer context_, failed_;
  bool is_clear_ = false;                    ///< failed_ is 0
  CeedQFunctionContext uploaded_ = nullptr;  ///< whose data context_ has; held
  std::uint64_t context_state_ = 0;
};

}  // namespace hg::gpu
