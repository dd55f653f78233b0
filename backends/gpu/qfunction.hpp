/// @file
/// A QFunction on a device.
#pragma once

#include <ceed/plugin.h>

#include <memory>
#include <string>
#include <vector>

#include "basis.hpp"
#include "device.hpp"
#include "function_text.hpp"

namespace hg::gpu {

/// The text of a QFunction's kernel, hg_qfunction, after what a driver says first. Throws jit::NoSource where it came
/// without text, jit::NotCompiled where that is not there.
std::string kernel_text(CeedQFunction qf);

/// A QFunction that runs on a device.
class PointFunction {
 public:
  PointFunction(Device &device, CeedQFunction qf, bool may_fail) : device_(&device), state_(device, qf, may_fail) {}
  virtual ~PointFunction() = default;

  /// Brings to the device what it works with beside its fields, where that is not there.
  void prepare() {
    const auto one_thread = device_->lock();
    state_.context();
  }
  /// Calls it at all points; see QFunctionJob. What it returned, 0 where it returns nothing else.
  virtual int call(const Points &points, const std::vector<const CeedScalar *> &inputs,
                   const std::vector<CeedScalar *> &outputs) = 0;

 protected:
  Device *device_;
  FunctionState state_;
};

/// That of a QFunction, which keeps it: its text, compiled, or else the user's kernel; NULL where it has neither: it
/// runs on the host, which is told once.
PointFunction *function_of(CeedQFunction qf);

}  // namespace hg::gpu
