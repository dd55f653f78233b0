/// @file
/// A backend with its tables.
#pragma once

#include <ceed/plugin.h>

#include <string>
#include <vector>

#include "object.hpp"

struct Ceed_private final : CeedObject_private {
  ~Ceed_private() override;
  void view(FILE *stream) const override;
  Ceed owner() const override { return const_cast<Ceed>(this); }

  std::string resource;
  CeedBackendOps ops{};
  void *data = nullptr;  ///< of the backend
  bool is_deterministic = false;
  bool is_clang = false;
  CeedErrorHandler error_handler = nullptr;
  std::string error_message;  ///< kept by CeedErrorStore
  std::vector<std::string> jit_source_roots;
  std::vector<std::string> jit_defines;
};

namespace hg {

/// Checks that a memory type may be used with the Ceed's backend.
void require_mem_type(const Ceed_private &ceed, CeedMemType mem_type, const char *what);

}  // namespace hg
