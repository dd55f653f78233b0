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

/// A QFunction that was compiled.
class PointFunction {
 public:
  /// Throws jit::NoSource where it came without text, jit::NotCompiled or DeviceError where that cannot be compiled.
  PointFunction(Device &device, CeedQFunction qf);

  /// Brings to the device what it works with beside its fields, where that is not there.
  void prepare();
  /// Calls it at all points; see QFunctionJob. What it returned, 0 where it returns nothing else.
  int call(const Points &points, const std::vector<const CeedScalar *> &inputs,
           const std::vector<CeedScalar *> &outputs);

 private:
  PointFunction(Device &device, CeedQFunction qf, const FunctionText &function);

  Device *device_;
  FunctionState state_;
  std::unique_ptr<Module> module_;
  Kernel kernel_;
  CeedInt vector_length_ = 1;
  Buffer arrays_;
  std::vector<const void *> pointers_;  ///< what arrays_ holds
};

/// That of a QFunction, which keeps it; NULL where it has no text for the device: it runs on the host, which is told
/// once.
PointFunction *function_of(CeedQFunction qf);

}  // namespace hg::gpu
