/// @file
/// The pointwise function of an operator and its fields.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "ceed.hpp"
#include "context.hpp"

struct CeedQFunctionField_private {
  std::string name;
  CeedInt size = 0;
  CeedEvalMode eval_mode = CEED_EVAL_NONE;
};

struct CeedQFunction_private final : CeedObject_private {
  ~CeedQFunction_private() override;
  void view(FILE *stream) const override;
  Ceed owner() const override { return ceed.get(); }
  /// Its name in the gallery, or that of the user's function.
  const std::string &name() const { return gallery_name.empty() ? kernel_name : gallery_name; }

  hg::Ref<Ceed_private> ceed;
  CeedInt vec_length = 1;
  CeedQFunctionUser function = nullptr;
  std::string source_path;  ///< "" where none was given
  std::string kernel_name;
  std::string gallery_name;  ///< "" for user functions
  bool is_identity = false;
  bool counts_components = false;  ///< of the gallery: its context is one CeedInt, the size of its first input
  std::atomic<bool> is_immutable = false;  ///< used by an operator: takes no more fields
  bool is_context_writable = true;
  CeedSize user_flops = -1;  ///< a point; -1: not given
  std::vector<std::unique_ptr<CeedQFunctionField_private>> inputs, outputs;
  std::vector<CeedQFunctionField> input_list, output_list;  ///< what GetFields hands out
  hg::Ref<CeedQFunctionContext_private> context;
  void *data = nullptr;  ///< of the backend
};

namespace hg {

/// Index of the field with that name, or -1.
int find_field(const std::vector<CeedQFunctionField> &fields, std::string_view name);
/// Throws unless a QFunction of the gallery that leaves its fields to the user has those that it reads and writes.
void require_gallery_fields(const CeedQFunction_private &qf);

}  // namespace hg
