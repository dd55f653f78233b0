/// @file
/// A backend with its tables.
#pragma once

#include <ceed/plugin.h>

#include <mutex>
#include <string>
#include <vector>

#include "object.hpp"

namespace hg {

/// A vector kept for scratch work. The Ceed holds a reference; while the vector is idle it holds none to the Ceed, which
/// would else live for ever.
struct WorkVector {
  CeedVector vec;
  CeedSize length;
  bool is_idle;
};

}  // namespace hg

struct Ceed_private final : CeedObject_private {
  ~Ceed_private() override;
  void view(FILE *stream) const override;
  Ceed owner() const override { return const_cast<Ceed>(this); }

  std::string resource;
  CeedBackendOps ops{};
  void *data = nullptr;  ///< of the backend
  bool is_deterministic = false;
  bool is_clang = false;
  std::atomic<CeedErrorHandler> error_handler = nullptr;
  hg::ErrorStore errors;
  std::vector<std::string> jit_source_roots;
  std::vector<std::string> jit_defines;
  std::vector<std::string> rust_source_roots;
  std::mutex work_mutex;  ///< of work_vectors
  std::vector<hg::WorkVector> work_vectors;
};

namespace hg {

/// Destroys the work vectors of a Ceed that is being destroyed.
void destroy_work_vectors(Ceed_private &ceed) noexcept;
/// Checks that a memory type may be used with the Ceed's backend.
void require_mem_type(const Ceed_private &ceed, CeedMemType mem_type, const char *what);
void require_transpose_mode(CeedTransposeMode t_mode, const char *what, Where where = Where::current());

}  // namespace hg
