/// Context fields of an operator, through composites.
#include <algorithm>
#include <cstdint>

#include "operator.hpp"

namespace {

using hg::require;
using hg::text;

/// The label of the field, or NULL; a composite operator makes one with its first use.
CeedContextFieldLabel find_label(CeedOperator_private &op, const std::string &name);

/// The labels of the field in the sub-operators as they are now, NULL where one lacks it. They agree in type and number
/// of values.
std::vector<CeedContextFieldLabel> labels_of_parts(CeedOperator_private &op, const std::string &name) {
  std::vector<CeedContextFieldLabel> labels;
  CeedContextFieldLabel first = nullptr;
  for (const auto &sub : op.subs) {
    const CeedContextFieldLabel label = find_label(*sub, name);
    labels.push_back(label);
    if (label == nullptr) continue;
    if (first == nullptr) first = label;
    require(label->type == first->type && label->num_values == first->num_values, CEED_ERROR_INCOMPATIBLE, [&] {
      return text(
          "Composite CeedOperator '%s': sub-operators register the context field '%s' with different types "
          "or numbers of values",
          op.shown_name(), name.c_str());
    });
  }
  return labels;
}

CeedContextFieldLabel find_label(CeedOperator_private &op, const std::string &name) {
  if (!op.is_composite) {
    CeedContextFieldLabel label = nullptr;
    if (op.qf->context) hg::check(CeedQFunctionContextGetFieldLabel(op.qf->context.get(), name.c_str(), &label));
    return label;
  }
  const auto parts = labels_of_parts(op, name);
  const auto any = std::find_if(parts.begin(), parts.end(), [](auto label) { return label != nullptr; });
  if (any == parts.end()) return nullptr;
  const CeedContextFieldLabel_private &first = **any;
  CeedContextFieldLabel_private shared;
  shared.name = first.name;
  shared.description = first.description;
  shared.type = first.type;
  shared.num_values = first.num_values;
  shared.size = first.size;
  shared.offset = SIZE_MAX;  // it has one in each sub-operator, none of its own
  // A label that was handed out stays where it is.
  const auto known = std::find_if(op.labels.begin(), op.labels.end(), [&](auto &label) { return label.name == name; });
  if (known == op.labels.end()) return &op.labels.emplace_back(std::move(shared));
  *known = std::move(shared);
  return &*known;
}

/// Calls f(context, label) for the operator, or for each sub-operator that has the field now.
template <typename F>
void for_each_context(CeedOperator_private &op, CeedContextFieldLabel label, F &&f) {
  require(label != nullptr, CEED_ERROR_UNSUPPORTED, [&] {
    return text(
        "CeedOperator '%s': the context field label is NULL; expected one from "
        "CeedOperatorGetContextFieldLabel()",
        op.shown_name());
  });
  if (!op.is_composite) {
    require(static_cast<bool>(op.qf->context), CEED_ERROR_UNSUPPORTED,
            [&] { return text("CeedOperator '%s': its QFunction has no context", op.shown_name()); });
    f(op.qf->context.get(), label);
    return;
  }
  const bool is_own = std::any_of(op.labels.begin(), op.labels.end(), [&](auto &own) { return &own == label; });
  require(is_own, CEED_ERROR_UNSUPPORTED, [&] {
    return text("CeedOperator '%s': label '%s' is not of this composite operator", op.shown_name(),
                label->name.c_str());
  });
  const auto parts = labels_of_parts(op, label->name);
  for (std::size_t i = 0; i < parts.size(); i++) {
    if (parts[i] != nullptr) for_each_context(*op.subs[i], parts[i], f);
  }
}

template <typename T, typename Set>
int set_values(CeedOperator op, CeedContextFieldLabel label, T *values, Set set,
               const char *function = __builtin_FUNCTION()) {
  return hg::guard(
      hg::ceed_of(op),
      [&] {
        hg::deref(op, "CeedOperator");
        hg::require_argument(values, "values (as many as the field has)");
        for_each_context(*op, label, [&](CeedQFunctionContext context, CeedContextFieldLabel own) {
          hg::check(set(context, own, values));
        });
        hg::for_each_single(*op, [](CeedOperator_private &single) { single.assembly_needs_update = true; });
      },
      function);
}

/// Calls f for the first context that has the field: its values stand for all.
template <typename F>
void with_first_context(CeedOperator op, CeedContextFieldLabel label, F &&f) {
  bool is_first = true;
  for_each_context(hg::deref(op, "CeedOperator"), label, [&](CeedQFunctionContext context, CeedContextFieldLabel own) {
    if (std::exchange(is_first, false)) hg::check(f(context, own));
  });
}

template <typename T, typename Get>
int get_values(CeedOperator op, CeedContextFieldLabel label, std::size_t *num_values, const T **values, Get get,
               const char *function = __builtin_FUNCTION()) {
  return hg::guard(
      hg::ceed_of(op),
      [&] {
        hg::deref(op, "CeedOperator");
        hg::require_argument(values, "values (where the address of the values goes)");
        with_first_context(op, label, [&](CeedQFunctionContext context, CeedContextFieldLabel own) {
          return get(context, own, num_values, values);
        });
      },
      function);
}

template <typename T, typename Restore>
int restore_values(CeedOperator op, CeedContextFieldLabel label, const T **values, Restore restore,
                   const char *function = __builtin_FUNCTION()) {
  return hg::guard(
      hg::ceed_of(op),
      [&] {
        with_first_context(op, label, [&](CeedQFunctionContext context, CeedContextFieldLabel own) {
          return restore(context, own, values);
        });
      },
      function);
}

}  // namespace

int CeedOperatorGetContext(CeedOperator op, CeedQFunctionContext *ctx) {
  return hg::guard(hg::ceed_of(op), [&] {
    require(!hg::deref(op, "CeedOperator").is_composite, CEED_ERROR_INCOMPATIBLE, [&] {
      return text("CeedOperator '%s' is composite; ask its sub-operators for their contexts", op->shown_name());
    });
    hg::hand_out(op->qf->context.get(), ctx, "ctx");
  });
}

int CeedOperatorGetContextFieldLabel(CeedOperator op, const char *field_name, CeedContextFieldLabel *field_label) {
  return hg::guard(hg::ceed_of(op), [&] {
    hg::deref(op, "CeedOperator");
    require(field_name != nullptr, CEED_ERROR_MINOR, [&] {
      return text("CeedOperator '%s': the name of the context field is NULL; expected text", op->shown_name());
    });
    hg::result(field_label, "field_label") = find_label(*op, field_name);
  });
}

int CeedOperatorSetContextDouble(CeedOperator op, CeedContextFieldLabel field_label, double *values) {
  return set_values(op, field_label, values, CeedQFunctionContextSetDouble);
}

int CeedOperatorGetContextDoubleRead(CeedOperator op, CeedContextFieldLabel field_label, size_t *num_values,
                                     const double **values) {
  return get_values(op, field_label, num_values, values, CeedQFunctionContextGetDoubleRead);
}

int CeedOperatorRestoreContextDoubleRead(CeedOperator op, CeedContextFieldLabel field_label, const double **values) {
  return restore_values(op, field_label, values, CeedQFunctionContextRestoreDoubleRead);
}

int CeedOperatorSetContextInt32(CeedOperator op, CeedContextFieldLabel field_label, int32_t *values) {
  return set_values(op, field_label, values, CeedQFunctionContextSetInt32);
}

int CeedOperatorGetContextInt32Read(CeedOperator op, CeedContextFieldLabel field_label, size_t *num_values,
                                    const int32_t **values) {
  return get_values(op, field_label, num_values, values, CeedQFunctionContextGetInt32Read);
}

int CeedOperatorRestoreContextInt32Read(CeedOperator op, CeedContextFieldLabel field_label, const int32_t **values) {
  return restore_values(op, field_label, values, CeedQFunctionContextRestoreInt32Read);
}

int CeedOperatorSetContextBoolean(CeedOperator op, CeedContextFieldLabel field_label, bool *values) {
  return set_values(op, field_label, values, CeedQFunctionContextSetBoolean);
}

int CeedOperatorGetContextBooleanRead(CeedOperator op, CeedContextFieldLabel field_label, size_t *num_values,
                                      const bool **values) {
  return get_values(op, field_label, num_values, values, CeedQFunctionContextGetBooleanRead);
}

int CeedOperatorRestoreContextBooleanRead(CeedOperator op, CeedContextFieldLabel field_label, const bool **values) {
  return restore_values(op, field_label, values, CeedQFunctionContextRestoreBooleanRead);
}
