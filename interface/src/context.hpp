/// @file
/// User data of QFunctions, with registered fields.
#pragma once

#include <deque>
#include <string>
#include <vector>

#include "ceed.hpp"

struct CeedContextFieldLabel_private {
  std::string name, description;
  CeedContextFieldType type = CEED_CONTEXT_FIELD_DOUBLE;
  std::size_t offset = 0, num_values = 0, size = 0;
  /// For composite operators: the label in each sub-operator, NULL where it lacks the field.
  std::vector<CeedContextFieldLabel> sub_labels;
};

struct CeedQFunctionContext_private final : CeedObject_private {
  ~CeedQFunctionContext_private() override;
  void check_destroyable() const override;
  void view(FILE *stream) const override;
  Ceed owner() const override { return ceed.get(); }

  hg::Ref<Ceed_private> ceed;
  std::size_t size = 0;
  void *values = nullptr;    ///< the data; NULL until set
  void *allocated = nullptr; ///< what the context frees with free(), or NULL
  bool is_borrowed = false;
  CeedQFunctionContextDataDestroyUser data_destroy = nullptr;
  CeedMemType data_destroy_mem_type = CEED_MEM_HOST;
  std::uint64_t state = 0;
  std::uint64_t num_readers = 0;
  std::deque<CeedContextFieldLabel_private> labels;  ///< stable addresses
  std::vector<CeedContextFieldLabel> label_list;     ///< what GetAllFieldLabels hands out
};
