/// Contexts: readers must leave the data as they got them.
#include <cstring>

#include "state.hpp"

namespace hg::memcheck {

namespace {

State &state_of(CeedQFunctionContext ctx) {
  return memcheck::state_of(CeedQFunctionContextReturnCeed(ctx));
}

int get_data_read(CeedQFunctionContext ctx, size_t size, const void *data) {
  State &state = state_of(ctx);
  const auto *bytes = static_cast<const unsigned char *>(data);
  const std::lock_guard lock(state.mutex);
  state.contexts[ctx].assign(bytes, bytes + size);
  return CEED_ERROR_SUCCESS;
}

int restore_data_read(CeedQFunctionContext ctx, size_t size, void *data) {
  State &state = state_of(ctx);
  bool is_same = true;
  {
    const std::lock_guard lock(state.mutex);
    const auto found = state.contexts.find(ctx);
    if (found == state.contexts.end() || found->second.size() != size || size == 0) return CEED_ERROR_SUCCESS;
    is_same = std::memcmp(found->second.data(), data, size) == 0;
    if (!is_same) std::memcpy(data, found->second.data(), size);
    state.contexts.erase(found);
  }
  CeedCheck(is_same, CeedQFunctionContextReturnCeed(ctx), CEED_ERROR_BACKEND,
            "Context data changed while accessed in read-only mode");
  return CEED_ERROR_SUCCESS;
}

}  // namespace

void fill_context_ops(CeedQFunctionContextOps &ops) {
  ops.get_data_read = get_data_read;
  ops.restore_data_read = restore_data_read;
}

}  // namespace hg::memcheck
