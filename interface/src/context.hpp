/// @file
/// User data of QFunctions, with registered fields.
#pragma once

#include <cstdlib>
#include <deque>
#include <memory>
#include <string>
#include <vector>

#include "ceed.hpp"

struct CeedContextFieldLabel_private {
  std::string name, description;
  CeedContextFieldType type = CEED_CONTEXT_FIELD_DOUBLE;
  std::size_t offset = 0, num_values = 0, size = 0;
};

struct CeedQFunctionContext_private final : CeedObject_private {
  ~CeedQFunctionContext_private() override;
  void check_destroyable() const override;
  void view(FILE *stream) const override;
  Ceed owner() const override { return ceed.get(); }

  struct Free {
    void operator()(void *block) const noexcept { std::free(block); }
  };

  hg::Ref<Ceed_private> ceed;
  std::size_t size = 0;
  void *values = nullptr;                 ///< the data; NULL until set
  std::unique_ptr<void, Free> allocated;  ///< the data where the context frees it, else NULL: then it is borrowed
  CeedQFunctionContextDataDestroyUser data_destroy = nullptr;
  std::uint64_t state = 0;  ///< even: no writer; grows by 2 with every possible change
  std::uint64_t num_readers = 0;
  std::deque<CeedContextFieldLabel_private> labels;  ///< stable addresses
  std::vector<CeedContextFieldLabel> label_list;     ///< what GetAllFieldLabels hands out

  bool has_writer() const { return state % 2 == 1; }
  bool is_borrowed() const { return values != nullptr && !allocated; }
  /// Lets go of the data; the user's destroy function sees it first.
  void forget();
};
