#include "backend_tables.hpp"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <iterator>

namespace hg::info {

namespace {

/// Pointers to functions have one size, whatever the functions.
using AnyFunction = void (*)();

struct Entry {
  const char *name;
  std::size_t offset;
};

constexpr Entry all_entries[] = {
    {"ceed.destroy", offsetof(CeedBackendOps, ceed_destroy)},
    {"ceed.set_stream", offsetof(CeedBackendOps, ceed_set_stream)},
    {"ceed.get_transfers", offsetof(CeedBackendOps, ceed_get_transfers)},
    {"vector.create", offsetof(CeedBackendOps, vector.create)},
    {"vector.destroy", offsetof(CeedBackendOps, vector.destroy)},
    {"vector.set_array", offsetof(CeedBackendOps, vector.set_array)},
    {"vector.take_array", offsetof(CeedBackendOps, vector.take_array)},
    {"vector.sync_array", offsetof(CeedBackendOps, vector.sync_array)},
    {"vector.get_array", offsetof(CeedBackendOps, vector.get_array)},
    {"vector.get_array_read", offsetof(CeedBackendOps, vector.get_array_read)},
    {"vector.get_array_write", offsetof(CeedBackendOps, vector.get_array_write)},
    {"vector.has_valid_array", offsetof(CeedBackendOps, vector.has_valid_array)},
    {"vector.has_borrowed_array", offsetof(CeedBackendOps, vector.has_borrowed_array)},
    {"vector.restore_array", offsetof(CeedBackendOps, vector.restore_array)},
    {"vector.restore_array_read", offsetof(CeedBackendOps, vector.restore_array_read)},
    {"vector.set_value", offsetof(CeedBackendOps, vector.set_value)},
    {"vector.norm", offsetof(CeedBackendOps, vector.norm)},
    {"vector.scale", offsetof(CeedBackendOps, vector.scale)},
    {"vector.axpy", offsetof(CeedBackendOps, vector.axpy)},
    {"vector.axpby", offsetof(CeedBackendOps, vector.axpby)},
    {"vector.pointwise_mult", offsetof(CeedBackendOps, vector.pointwise_mult)},
    {"vector.reciprocal", offsetof(CeedBackendOps, vector.reciprocal)},
    {"vector.filter", offsetof(CeedBackendOps, vector.filter)},
    {"vector.copy", offsetof(CeedBackendOps, vector.copy)},
    {"vector.copy_strided", offsetof(CeedBackendOps, vector.copy_strided)},
    {"vector.set_value_strided", offsetof(CeedBackendOps, vector.set_value_strided)},
    {"restriction.create", offsetof(CeedBackendOps, restriction.create)},
    {"restriction.destroy", offsetof(CeedBackendOps, restriction.destroy)},
    {"restriction.apply", offsetof(CeedBackendOps, restriction.apply)},
    {"basis.create", offsetof(CeedBackendOps, basis.create)},
    {"basis.destroy", offsetof(CeedBackendOps, basis.destroy)},
    {"basis.apply", offsetof(CeedBackendOps, basis.apply)},
    {"basis.apply_at_points", offsetof(CeedBackendOps, basis.apply_at_points)},
    {"qfunction.create", offsetof(CeedBackendOps, qfunction.create)},
    {"qfunction.destroy", offsetof(CeedBackendOps, qfunction.destroy)},
    {"qfunction.apply", offsetof(CeedBackendOps, qfunction.apply)},
    {"qfunction.set_cuda_function", offsetof(CeedBackendOps, qfunction.set_cuda_function)},
    {"qfunction.set_hip_function", offsetof(CeedBackendOps, qfunction.set_hip_function)},
    {"op.create", offsetof(CeedBackendOps, op.create)},
    {"op.destroy", offsetof(CeedBackendOps, op.destroy)},
    {"op.prepare", offsetof(CeedBackendOps, op.prepare)},
    {"op.apply_add", offsetof(CeedBackendOps, op.apply_add)},
    {"op.apply_add_parts", offsetof(CeedBackendOps, op.apply_add_parts)},
    {"op.linear_assemble_qfunction", offsetof(CeedBackendOps, op.linear_assemble_qfunction)},
    {"op.linear_assemble", offsetof(CeedBackendOps, op.linear_assemble)},
    {"op.linear_assemble_elements", offsetof(CeedBackendOps, op.linear_assemble_elements)},
    {"op.get_memory", offsetof(CeedBackendOps, op.get_memory)},
    {"context.get_data_read", offsetof(CeedBackendOps, context.get_data_read)},
    {"context.restore_data_read", offsetof(CeedBackendOps, context.restore_data_read)},
};

AnyFunction function_at(const CeedBackendOps &ops, std::size_t offset) {
  AnyFunction function = nullptr;
  std::memcpy(&function, reinterpret_cast<const char *>(&ops) + offset, sizeof function);
  return function;
}

std::string name_at(std::size_t offset) {
  const auto entry = std::find_if(std::begin(all_entries), std::end(all_entries),
                                  [&](const Entry &candidate) { return candidate.offset == offset; });
  return entry != std::end(all_entries) ? entry->name : "unnamed.byte " + std::to_string(offset);
}

std::string group_of(const std::string &entry) {
  return entry.substr(0, entry.find('.'));
}

std::ptrdiff_t size_of_group(const std::string &group) {
  return std::count_if(std::begin(all_entries), std::end(all_entries),
                       [&](const Entry &entry) { return group_of(entry.name) == group; });
}

}  // namespace

std::vector<std::string> changed_entries(const CeedBackendOps &ops, const CeedBackendOps &parent) {
  // From the first function to the end there is nothing but functions.
  std::vector<std::string> changed;
  for (std::size_t offset = all_entries[0].offset; offset < sizeof(CeedBackendOps); offset += sizeof(AnyFunction)) {
    if (function_at(ops, offset) != function_at(parent, offset)) changed.push_back(name_at(offset));
  }
  return changed;
}

std::string in_short(const std::vector<std::string> &entries) {
  std::string text;
  for (auto first = entries.begin(); first != entries.end();) {
    const std::string group = group_of(*first);
    const auto last = std::find_if(first, entries.end(), [&](const auto &entry) { return group_of(entry) != group; });
    const auto count = last - first;
    if (!text.empty()) text += ", ";
    if (count == size_of_group(group)) {
      text += group;
    } else if (count > 2) {
      text += group + " (" + std::to_string(count) + " of " + std::to_string(size_of_group(group)) + ")";
    } else {
      text += *first + (count == 2 ? ", " + *std::next(first) : "");
    }
    first = last;
  }
  return text;
}

}  // namespace hg::info
