#include "device.hpp"

#include "../host/access.hpp"
#include "texts.hpp"

namespace hg::gpu {

Device &Device::of(Ceed ceed) {
  Device *device = nullptr;
  host::chk(CeedGetData(ceed, &device));
  if (device == nullptr) throw DeviceError("this Ceed has no device");
  return *device;
}

Module &Device::library() {
  const auto one_thread = lock();
  if (!library_) library_ = driver_->compile("library", library_text());
  return *library_;
}

Kernel Device::library_kernel(const char *name) {
  const auto one_thread = lock();
  if (const auto found = kernels_.find(name); found != kernels_.end()) return found->second;
  const Kernel kernel = library().kernel(name);
  kernels_.emplace(name, kernel);
  return kernel;
}

}  // namespace hg::gpu
