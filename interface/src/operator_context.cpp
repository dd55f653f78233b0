/// Context fields of an operator, through composites.
#include <cstdint>

#include "operator.hpp"

namespace {

using hg::require;
using hg::text;

/// The label in the operator's own context, or NULL.
CeedContextFieldLabel own_label(const CeedOperator_private &op, const char *name) {
  CeedContextFieldLabel label = nullptr;
  if (op.qf->context) hg::check(CeedQFunctionContextGetFieldLabel(op.qf->context.get(), name, &label));
  return label;
}

/// Calls f(context, label) for the operator, or for each sub-operator that has the field.
template <typename F>
void for_each_context(CeedOperator op, CeedContextFieldLabel label, F &&f) {
  hg::deref(op, "CeedOperator");
  require(label != nullptr, CEED_ERROR_UNSUPPORTED,
          [&] { return text("CeedOperator '%s': the context field label is NULL", op->shown_name()); });
  if (!op->is_composite) {
    require(static_cast<bool>(op->qf->context), CEED_ERROR_UNSUPPORTED,
            [&] { return text("CeedOperator '%s': its QFunction has no context", op->shown_name()); });
    f(op->qf->context.get(), label);
    return;
  }
  require(label->sub_labels.size() == op->subs.size(), CEED_ERROR_UNSUPPORTED, [&] {
    return text("CeedOperator '%s': label '%s' is not of this composite operator", op->shown_name(),
                label->name.c_str());
  });
  for (std::size_t i = 0; i < op->subs.size(); i++) {
    if (label->sub_labels[i] != nullptr) for_each_context(op->subs[i].get(), label->sub_labels[i], f);
  }
}

template <typename T, typename Set>
int set_values(CeedOperator op, CeedContextFieldLabel label, T *values, Set set) {
  return hg::guard(hg::ceed_of(op), [&] {
    for_each_context(op, label, [&](CeedQFunctionContext context, CeedContextFieldLabel own) {
      hg::check(set(context, own, values));
    });
    hg::for_each_single(*op, [](CeedOperator_private &single) { single.assembly_needs_update = true; });
  });
}

/// Calls f for the first context that has the field: its values stand for all.
template <typename F>
int with_first_context(CeedOperator op, CeedContextFieldLabel label, F &&f) {
  return hg::guard(hg::ceed_of(op), [&] {
    bool is_first = true;
    for_each_context(op, label, [&](CeedQFunctionContext context, CeedContextFieldLabel own) {
      if (std::exchange(is_first, false)) hg::check(f(context, own));
    });
  });
}

}  // namespace

int CeedOperatorGetContext(CeedOperator op, CeedQFunctionContext *ctx) {
  return hg::guard(hg::ceed_of(op), [&] {
    require(!hg::deref(op, "CeedOperator").is_composite, CEED_ERROR_INCOMPATIBLE, [&] {
      return text("CeedOperator '%s' is composite; ask its sub-operators for their contexts", op->shown_name());
    });
    *ctx = hg::Ref(op->qf->context).release();
  });
}

int CeedOperatorGetContextFieldLabel(CeedOperator op, const char *field_name, CeedContextFieldLabel *field_label) {
  return hg::guard(hg::ceed_of(op), [&] {
    hg::deref(op, "CeedOperator");
    require(field_name != nullptr, CEED_ERROR_MINOR, [&] {
      return text("CeedOperator '%s': the name of the context field is NULL; expected text", op->shown_name());
    });
    if (!op->is_composite) {
      *field_label = own_label(*op, field_name);
      return;
    }
    for (auto &label : op->labels) {
      if (label.name == field_name && label.sub_labels.size() == op->subs.size()) {
        *field_label = &label;
        return;
      }
    }
    CeedContextFieldLabel_private shared;
    CeedContextFieldLabel first = nullptr;
    for (const auto &sub : op->subs) {
      CeedContextFieldLabel label = nullptr;
      hg::check(CeedOperatorGetContextFieldLabel(sub.get(), field_name, &label));
      shared.sub_labels.push_back(label);
      if (label == nullptr) continue;
      if (first == nullptr) first = label;
      require(label->type == first->type && label->num_values == first->num_values, CEED_ERROR_INCOMPATIBLE, [&] {
        return text("Composite CeedOperator '%s': sub-operators register the context field '%s' with different types "
                    "or numbers of values",
                    op->shown_name(), field_name);
      });
    }
    *field_label = nullptr;
    if (first == nullptr) return;
    shared.name = first->name;
    shared.description = first->description;
    shared.type = first->type;
    shared.num_values = first->num_values;
    shared.size = first->size;
    shared.offset = SIZE_MAX;  // it has one in each sub-operator, none of its own
    op->labels.push_back(std::move(shared));
    *field_label = &op->labels.back();
  });
}

int CeedOperatorSetContextDouble(CeedOperator op, CeedContextFieldLabel field_label, double *values) {
  return set_values(op, field_label, values, CeedQFunctionContextSetDouble);
}

int CeedOperatorGetContextDoubleRead(CeedOperator op, CeedContextFieldLabel field_label, size_t *num_values,
                                     const double **values) {
  return with_first_context(op, field_label, [&](CeedQFunctionContext context, CeedContextFieldLabel label) {
    return CeedQFunctionContextGetDoubleRead(context, label, num_values, values);
  });
}

int CeedOperatorRestoreContextDoubleRead(CeedOperator op, CeedContextFieldLabel field_label, const double **values) {
  return with_first_context(op, field_label, [&](CeedQFunctionContext context, CeedContextFieldLabel label) {
    return CeedQFunctionContextRestoreDoubleRead(context, label, values);
  });
}

int CeedOperatorSetContextInt32(CeedOperator op, CeedContextFieldLabel field_label, int32_t *values) {
  return set_values(op, field_label, values, CeedQFunctionContextSetInt32);
}

int CeedOperatorGetContextInt32Read(CeedOperator op, CeedContextFieldLabel field_label, size_t *num_values,
                                    const int32_t **values) {
  return with_first_context(op, field_label, [&](CeedQFunctionContext context, CeedContextFieldLabel label) {
    return CeedQFunctionContextGetInt32Read(context, label, num_values, values);
  });
}

int CeedOperatorRestoreContextInt32Read(CeedOperator op, CeedContextFieldLabel field_label, const int32_t **values) {
  return with_first_context(op, field_label, [&](CeedQFunctionContext context, CeedContextFieldLabel label) {
    return CeedQFunctionContextRestoreInt32Read(context, label, values);
  });
}

int CeedOperatorSetContextBoolean(CeedOperator op, CeedContextFieldLabel field_label, bool *values) {
  return set_values(op, field_label, values, CeedQFunctionContextSetBoolean);
}

int CeedOperatorGetContextBooleanRead(CeedOperator op, CeedContextFieldLabel field_label, size_t *num_values,
                                      const bool **values) {
  return with_first_context(op, field_label, [&](CeedQFunctionContext context, CeedContextFieldLabel label) {
    return CeedQFunctionContextGetBooleanRead(context, label, num_values, values);
  });
}

int CeedOperatorRestoreContextBooleanRead(CeedOperator op, CeedContextFieldLabel field_label, const bool **values) {
  return with_first_context(op, field_label, [&](CeedQFunctionContext context, CeedContextFieldLabel label) {
    return CeedQFunctionContextRestoreBooleanRead(context, label, values);
  });
}
