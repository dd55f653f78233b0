/// Fields: set, checked, asked for.
#include <algorithm>

#include "operator.hpp"

namespace {

using hg::require;
using hg::text;

/// The numbers of elements and points that a field implies are those of the operator, or set them.
void agree(CeedInt &known, CeedInt value, const CeedOperator_private &op, const char *field, const char *what) {
  require(known < 0 || known == value, CEED_ERROR_DIMENSION, [&] {
    return text("CeedOperator '%s' field '%s' has %" CeedInt_FMT " %s; the fields set before have %" CeedInt_FMT,
                op.shown_name(), field, value, what, known);
  });
  known = value;
}

void check_weight_field(const CeedOperator_private &op, const char *name, CeedElemRestriction rstr, CeedBasis basis,
                        CeedVector vec) {
  require(rstr == CEED_ELEMRESTRICTION_NONE && basis != CEED_BASIS_NONE && vec == CEED_VECTOR_NONE,
          CEED_ERROR_INCOMPATIBLE, [&] {
            return text("CeedOperator '%s' field '%s' of mode CEED_EVAL_WEIGHT takes CEED_ELEMRESTRICTION_NONE, a "
                        "basis and CEED_VECTOR_NONE",
                        op.shown_name(), name);
          });
}

void check_none_field(const CeedOperator_private &op, const char *name, CeedInt size, const CeedElemRestriction_private &rstr,
                      CeedBasis basis) {
  require(basis == CEED_BASIS_NONE, CEED_ERROR_INCOMPATIBLE, [&] {
    return text("CeedOperator '%s' field '%s' of mode CEED_EVAL_NONE takes CEED_BASIS_NONE", op.shown_name(), name);
  });
  require(rstr.num_comp == size, CEED_ERROR_DIMENSION, [&] {
    return text("CeedOperator '%s' field '%s' has size %" CeedInt_FMT "; its restriction has %" CeedInt_FMT
                " components",
                op.shown_name(), name, size, rstr.num_comp);
  });
  require(rstr.is_points() == op.is_at_points, CEED_ERROR_INCOMPATIBLE, [&] {
    return text("CeedOperator '%s' field '%s' of mode CEED_EVAL_NONE: expected a restriction %s", op.shown_name(), name,
                op.is_at_points ? "at points (CeedElemRestrictionCreateAtPoints)" : "at quadrature points, not at points");
  });
}

void check_basis_field(const CeedOperator_private &op, const char *name, CeedInt size, CeedEvalMode mode,
                       const CeedElemRestriction_private &rstr, CeedBasis basis) {
  require(basis != CEED_BASIS_NONE, CEED_ERROR_INCOMPATIBLE, [&] {
    return text("CeedOperator '%s' field '%s' of mode %s takes a basis, not CEED_BASIS_NONE", op.shown_name(), name,
                CeedEvalModes[mode]);
  });
  require(!rstr.is_points(), CEED_ERROR_INCOMPATIBLE, [&] {
    return text("CeedOperator '%s' field '%s' of mode %s: expected a restriction at nodes, not at points",
                op.shown_name(), name, CeedEvalModes[mode]);
  });
  require(rstr.elem_size == basis->P, CEED_ERROR_DIMENSION, [&] {
    return text("CeedOperator '%s' field '%s': the restriction has %" CeedInt_FMT
                " nodes an element; the basis has %" CeedInt_FMT,
                op.shown_name(), name, rstr.elem_size, basis->P);
  });
  require(rstr.num_comp == basis->num_comp, CEED_ERROR_DIMENSION, [&] {
    return text("CeedOperator '%s' field '%s': the restriction has %" CeedInt_FMT
                " components; the basis has %" CeedInt_FMT,
                op.shown_name(), name, rstr.num_comp, basis->num_comp);
  });
  require(mode == CEED_EVAL_INTERP || mode == hg::derivative_mode(basis->fe_space), CEED_ERROR_UNSUPPORTED, [&] {
    return text("CeedOperator '%s' field '%s' of mode %s: the basis is in a %s, which has %s and %s", op.shown_name(),
                name, CeedEvalModes[mode], CeedFESpaces[basis->fe_space], CeedEvalModes[CEED_EVAL_INTERP],
                CeedEvalModes[hg::derivative_mode(basis->fe_space)]);
  });
  require(mode == CEED_EVAL_INTERP || basis->is_tensor || !basis->derivative.empty(), CEED_ERROR_UNSUPPORTED, [&] {
    return text("CeedOperator '%s' field '%s' of mode %s: the basis was made without a matrix for it", op.shown_name(),
                name, CeedEvalModes[mode]);
  });
  const CeedInt expected = basis->num_comp * hg::q_components(*basis, mode);
  require(size == expected, CEED_ERROR_DIMENSION, [&] {
    return text("CeedOperator '%s' field '%s' of mode %s: the QFunction gives size %" CeedInt_FMT
                "; the basis has %" CeedInt_FMT " values a point",
                op.shown_name(), name, CeedEvalModes[mode], size, expected);
  });
}

/// Two Ceeds may share objects that are of the same backend, and on the same device.
void require_same_family(const CeedOperator_private &op, const CeedObject_private *object, const char *field) {
  if (object->is_sentinel) return;
  const Ceed other = object->owner();
  require(other == op.ceed.get() || other->resource == op.ceed->resource, CEED_ERROR_INCOMPATIBLE, [&] {
    return text("CeedOperator '%s' of backend %s, field '%s': an object of backend %s", op.shown_name(),
                op.ceed->resource.c_str(), field, other->resource.c_str());
  });
  require(other->ops.device_id == op.ceed->ops.device_id, CEED_ERROR_INCOMPATIBLE, [&] {
    return text("CeedOperator '%s' of backend %s on device %d, field '%s': an object on device %d", op.shown_name(),
                op.ceed->resource.c_str(), op.ceed->ops.device_id, field, other->ops.device_id);
  });
}

/// Number of points that a set field implies, or -1.
CeedInt implied_points(const CeedOperator_private &op, const CeedOperatorField_private &field) {
  if (op.is_at_points || !field.is_set()) return -1;
  return field.basis.get() != CEED_BASIS_NONE ? field.basis->Q : field.rstr->elem_size;
}

/// Once an epoch: the lists of points are compared.
void check_points(CeedOperator_private &op) {
  if (op.checked_points == op.points_epoch) return;
  require(static_cast<bool>(op.points_rstr), CEED_ERROR_INCOMPLETE, [&] {
    return text("CeedOperator '%s' is at points, but has none; call CeedOperatorAtPointsSetPoints()", op.shown_name());
  });
  for (const auto *list : {&op.input_list, &op.output_list}) {
    for (const CeedOperatorField field : *list) {
      const CeedBasis basis = field->basis.get();
      require(basis == CEED_BASIS_NONE || basis->dim == op.points_rstr->num_comp, CEED_ERROR_DIMENSION, [&] {
        return text("CeedOperator '%s' field '%s': the basis has dimension %" CeedInt_FMT
                    "; the points have %" CeedInt_FMT " coordinates each",
                    op.shown_name(), field->qf_field->name.c_str(), basis->dim, op.points_rstr->num_comp);
      });
      if (!field->rstr->is_points()) continue;
      bool are_compatible = false;
      hg::check(CeedElemRestrictionAtPointsAreCompatible(op.points_rstr.get(), field->rstr.get(), &are_compatible));
      require(are_compatible, CEED_ERROR_INCOMPATIBLE, [&] {
        return text("CeedOperator '%s' field '%s' is stored at other points than those of the operator; set it again "
                    "after CeedOperatorAtPointsSetPoints()",
                    op.shown_name(), field->qf_field->name.c_str());
      });
    }
  }
  op.checked_points = op.points_epoch;
}

template <typename Pick>
void get_active(CeedOperator op, bool from_inputs, const char *what, Pick &&pick) {
  hg::deref(op, "CeedOperator");
  require(!op->is_composite, CEED_ERROR_MINOR, [&] {
    return text("CeedOperator '%s' is composite; ask its sub-operators for the active %s", op->shown_name(), what);
  });
  for (const CeedOperatorField field : from_inputs ? op->input_list : op->output_list) {
    if (field->is_active()) pick(*field);
  }
}

/// The one object of the active fields of a list; an error where there are several or none.
template <typename T>
T *single_active(CeedOperator op, bool from_inputs, hg::Ref<T> CeedOperatorField_private::*member, const char *what) {
  T *found = nullptr;
  get_active(op, from_inputs, what, [&](const CeedOperatorField_private &field) {
    T *candidate = (field.*member).get();
    if (candidate->is_sentinel) return;
    require(found == nullptr || found == candidate, CEED_ERROR_MINOR,
            [&] { return text("CeedOperator '%s' has several active %s objects", op->shown_name(), what); });
    found = candidate;
  });
  require(found != nullptr, CEED_ERROR_INCOMPLETE,
          [&] { return text("CeedOperator '%s' has no active %s", op->shown_name(), what); });
  return found;
}

/// The ones of the inputs and of the outputs, where they are asked for: both, or none where one is missing.
template <typename T>
void hand_out_active(CeedOperator op, hg::Ref<T> CeedOperatorField_private::*member, const char *what, T **input,
                     T **output) {
  hg::Ref<T> of_inputs, of_outputs;
  if (input != nullptr) of_inputs = hg::Ref<T>(single_active(op, true, member, what));
  if (output != nullptr) of_outputs = hg::Ref<T>(single_active(op, false, member, what));
  if (input != nullptr) *input = of_inputs.release();
  if (output != nullptr) *output = of_outputs.release();
}

const CeedOperatorField_private &deref(CeedOperatorField op_field, hg::Where where = hg::Where::current()) {
  require(op_field != nullptr, CEED_ERROR_INCOMPLETE, "CeedOperatorField is NULL; expected a field of an operator",
          where);
  return *op_field;
}

/// Body of the getters of a field's objects; `function` is the getter.
template <typename T>
int get(CeedOperatorField op_field, hg::Ref<T> CeedOperatorField_private::*member, T **handle, const char *name,
        const char *function = __builtin_FUNCTION()) {
  return hg::guard(
      nullptr,
      [&] {
        hg::hand_out((deref(op_field).*member).get(), handle, name);
      },
      function);
}

}  // namespace

namespace hg {

void check_ready(CeedOperator_private &op) {
  if (op.is_composite) {
    CeedSize in = -1, out = -1;
    for (const auto &sub : op.subs) {
      check_ready(*sub);
      if (sub->is_empty()) continue;
      CeedSize sub_in = -1, sub_out = -1;
      check(CeedOperatorGetActiveVectorLengths(sub.get(), &sub_in, &sub_out));
      const auto agree = [&](CeedSize &known, CeedSize value, const char *what) {
        require(known < 0 || value < 0 || known == value, CEED_ERROR_MAJOR, [&] {
          return text("Composite CeedOperator '%s': sub-operator '%s' has an active %s of length %" CeedSize_FMT
                      "; those before have %" CeedSize_FMT,
                      op.shown_name(), sub->shown_name(), what, value, known);
        });
        known = std::max(known, value);
      };
      agree(in, sub_in, "input");
      agree(out, sub_out, "output");
    }
    op.is_immutable = true;
    return;
  }
  for (const auto *list : {&op.input_list, &op.output_list}) {
    for (const CeedOperatorField field : *list) {
      require(field->is_set(), CEED_ERROR_INCOMPLETE, [&] {
        return text("CeedOperator '%s': field '%s' of its QFunction is not set", op.shown_name(),
                    field->qf_field->name.c_str());
      });
    }
  }
  require(!op.input_list.empty() || !op.output_list.empty(), CEED_ERROR_INCOMPLETE, [&] {
    return text("CeedOperator '%s': its QFunction '%s' has no fields", op.shown_name(), op.qf->kernel_name.c_str());
  });
  require(op.num_elem >= 0, CEED_ERROR_INCOMPLETE,
          [&] { return text("CeedOperator '%s': no field has a restriction", op.shown_name()); });
  if (op.is_at_points) check_points(op);
  require(op.num_qpts >= 0, CEED_ERROR_INCOMPLETE,
          [&] { return text("CeedOperator '%s': no field tells the number of points", op.shown_name()); });
  op.is_immutable = true;
}

void require_not_read(CeedOperator_private &op, CeedVector vec, const char *what) {
  if (vec->is_sentinel) return;
  for_each_single(op, [&](CeedOperator_private &single) {
    for (const CeedOperatorField field : single.input_list) {
      require(field->vec.get() != vec, CEED_ERROR_INCOMPATIBLE, [&] {
        return text("CeedOperator '%s': the vector of its passive input '%s' is its %s too; expected another one",
                    single.shown_name(), field->qf_field->name.c_str(), what);
      });
    }
    require(single.points.get() != vec, CEED_ERROR_INCOMPATIBLE, [&] {
      return text("CeedOperator '%s': the vector of its points is its %s too; expected another one",
                  single.shown_name(), what);
    });
  });
}

const CeedProgram &program_of(CeedOperator_private &op) {
  require(!op.is_composite, CEED_ERROR_MINOR, [&] {
    return text("CeedOperator '%s' is composite; only its sub-operators have programs", op.shown_name());
  });
  if (op.program == nullptr || op.is_program_stale) {
    check_ready(op);
    auto lowered = std::make_unique<Program>(op);
    const CeedOperatorOps &ops = op.ceed->ops.op;
    if (op.is_known_to_backend && !lowered->has_shape_of(*op.program)) {
      op.is_known_to_backend = false;
      if (ops.destroy != nullptr) check(ops.destroy(&op));
    }
    op.program = std::move(lowered);
    op.is_program_stale = true;  // until the backend has taken it: where it fails, the next use tries again
    if (!op.is_known_to_backend && ops.create != nullptr) check(ops.create(&op, &op.program->view()));
    op.is_known_to_backend = true;
    op.is_program_stale = false;
  }
  return op.program->view();
}

}  // namespace hg

int CeedOperatorSetField(CeedOperator op, const char *field_name, CeedElemRestriction rstr, CeedBasis basis,
                         CeedVector vec) {
  return hg::guard(hg::ceed_of(op), [&] {
    hg::deref(op, "CeedOperator");
    require(field_name != nullptr, CEED_ERROR_MINOR,
            "Name of the operator field is NULL; expected that of a field of the QFunction");
    require(!op->is_composite, CEED_ERROR_INCOMPATIBLE, [&] {
      return text("CeedOperator '%s' is composite and has no field '%s'; set it in a sub-operator", op->shown_name(),
                  field_name);
    });
    CeedOperatorField field = nullptr;
    for (const auto *list : {&op->input_list, &op->output_list}) {
      for (const CeedOperatorField candidate : *list) {
        if (candidate->qf_field->name == field_name) field = candidate;
      }
    }
    require(field != nullptr, CEED_ERROR_INCOMPLETE, [&] {
      return text("CeedOperator '%s': its QFunction '%s' has no knowledge of field '%s'", op->shown_name(),
                  op->qf->kernel_name.c_str(), field_name);
    });
    hg::deref(rstr, "restriction of an operator field (CEED_ELEMRESTRICTION_NONE for weights)");
    hg::deref(basis, "basis of an operator field (CEED_BASIS_NONE for mode CEED_EVAL_NONE)");
    hg::deref(vec, "vector of an operator field (CEED_VECTOR_NONE for weights)");
    const bool moves = field->is_set() && op->is_at_points && field->rstr->is_points() && rstr->is_points();
    require(!field->is_set() || moves, CEED_ERROR_MINOR, [&] {
      return text("CeedOperator '%s': field '%s' is set already; only fields stored at points may be set again",
                  op->shown_name(), field_name);
    });
    for (const CeedObject_private *object : {static_cast<CeedObject_private *>(rstr),
                                             static_cast<CeedObject_private *>(basis),
                                             static_cast<CeedObject_private *>(vec)}) {
      require_same_family(*op, object, field_name);
    }
    const CeedInt size = field->qf_field->size;
    const CeedEvalMode mode = field->qf_field->eval_mode;
    if (mode == CEED_EVAL_WEIGHT) {
      check_weight_field(*op, field_name, rstr, basis, vec);
    } else {
      require(rstr != CEED_ELEMRESTRICTION_NONE && vec != CEED_VECTOR_NONE, CEED_ERROR_INCOMPATIBLE, [&] {
        return text("CeedOperator '%s' field '%s' of mode %s takes a restriction and a vector", op->shown_name(),
                    field_name, CeedEvalModes[mode]);
      });
      if (mode == CEED_EVAL_NONE) {
        check_none_field(*op, field_name, size, *rstr, basis);
      } else {
        check_basis_field(*op, field_name, size, mode, *rstr, basis);
      }
      require(vec == CEED_VECTOR_ACTIVE || vec->length >= rstr->l_size, CEED_ERROR_DIMENSION, [&] {
        return text("CeedOperator '%s' field '%s': the vector has length %" CeedSize_FMT
                    "; the restriction expects %" CeedSize_FMT " or more",
                    op->shown_name(), field_name, vec->length, rstr->l_size);
      });
    }
    require(!op->is_at_points || basis == CEED_BASIS_NONE || basis->is_tensor, CEED_ERROR_UNSUPPORTED, [&] {
      return text("CeedOperator '%s' field '%s': operators at points take tensor-product bases", op->shown_name(),
                  field_name);
    });
    if (op->is_at_points && (mode == CEED_EVAL_INTERP || mode == CEED_EVAL_GRAD)) hg::require_polynomial(*basis);
    CeedInt num_elem = op->num_elem, num_qpts = op->num_qpts;
    if (rstr != CEED_ELEMRESTRICTION_NONE) agree(num_elem, rstr->num_elem, *op, field_name, "elements");
    CeedOperatorField_private candidate{field->qf_field, hg::Ref(rstr), hg::Ref(basis), hg::Ref(vec)};
    if (const CeedInt implied = implied_points(*op, candidate); implied >= 0) {
      agree(num_qpts, implied, *op, field_name, "points an element");
    }
    op->num_elem = num_elem;
    op->num_qpts = num_qpts;
    *field = std::move(candidate);
    if (moves) {
      op->points_epoch++;
      op->is_program_stale = true;
      op->assembly_needs_update = true;
    }
  });
}

int CeedOperatorAtPointsSetPoints(CeedOperator op, CeedElemRestriction rstr_points, CeedVector point_coords) {
  return hg::guard(hg::ceed_of(op), [&] {
    hg::deref(op, "CeedOperator");
    hg::deref_restriction(rstr_points);
    hg::deref_vector(point_coords, "vector of the points");
    require(op->is_at_points, CEED_ERROR_MINOR, [&] {
      return text("CeedOperator '%s' is not at points; create it with CeedOperatorCreateAtPoints()", op->shown_name());
    });
    require(rstr_points->is_points(), CEED_ERROR_INCOMPATIBLE, [&] {
      return text("CeedOperator '%s': the restriction of the points is not one at points", op->shown_name());
    });
    require(point_coords->length >= rstr_points->l_size, CEED_ERROR_DIMENSION, [&] {
      return text("CeedOperator '%s': the vector of the points has length %" CeedSize_FMT
                  "; the restriction expects %" CeedSize_FMT " or more",
                  op->shown_name(), point_coords->length, rstr_points->l_size);
    });
    require_same_family(*op, rstr_points, "points");
    require_same_family(*op, point_coords, "points");
    agree(op->num_elem, rstr_points->num_elem, *op, "points", "elements");
    op->points_rstr = hg::Ref(rstr_points);
    op->points = hg::Ref(point_coords);
    op->num_qpts = rstr_points->elem_size;
    op->points_epoch++;
    op->is_program_stale = true;
    op->assembly_needs_update = true;
  });
}

int CeedOperatorAtPointsGetPoints(CeedOperator op, CeedElemRestriction *rstr_points, CeedVector *point_coords) {
  return hg::guard(hg::ceed_of(op), [&] {
    require(hg::deref(op, "CeedOperator").is_at_points, CEED_ERROR_MINOR,
            [&] { return text("CeedOperator '%s' is not at points", op->shown_name()); });
    if (rstr_points != nullptr) *rstr_points = hg::Ref(op->points_rstr).release();
    if (point_coords != nullptr) *point_coords = hg::Ref(op->points).release();
  });
}

int CeedOperatorGetFields(CeedOperator op, CeedInt *num_input_fields, CeedOperatorField **input_fields,
                          CeedInt *num_output_fields, CeedOperatorField **output_fields) {
  return hg::guard(hg::ceed_of(op), [&] {
    require(!hg::deref(op, "CeedOperator").is_composite, CEED_ERROR_MINOR, [&] {
      return text("CeedOperator '%s' is composite; ask its sub-operators for their fields", op->shown_name());
    });
    hg::check_ready(*op);
    if (num_input_fields != nullptr) *num_input_fields = static_cast<CeedInt>(op->input_list.size());
    if (input_fields != nullptr) *input_fields = op->input_list.data();
    if (num_output_fields != nullptr) *num_output_fields = static_cast<CeedInt>(op->output_list.size());
    if (output_fields != nullptr) *output_fields = op->output_list.data();
  });
}

int CeedOperatorGetFieldByName(CeedOperator op, const char *field_name, CeedOperatorField *op_field) {
  return hg::guard(hg::ceed_of(op), [&] {
    hg::deref(op, "CeedOperator");
    require(field_name != nullptr, CEED_ERROR_MINOR, [&] {
      return text("CeedOperator '%s': the name of the field is NULL; expected text", op->shown_name());
    });
    hg::result(op_field, "op_field") = nullptr;
    for (const auto *list : {&op->input_list, &op->output_list}) {
      for (const CeedOperatorField field : *list) {
        if (field->qf_field->name == field_name) *op_field = field;
      }
    }
  });
}

int CeedOperatorCheckReady(CeedOperator op) {
  return hg::guard(hg::ceed_of(op), [&] { hg::check_ready(hg::deref(op, "CeedOperator")); });
}

int CeedOperatorGetActiveVectorLengths(CeedOperator op, CeedSize *input_size, CeedSize *output_size) {
  return hg::guard(hg::ceed_of(op), [&] {
    CeedSize in = -1, out = -1;
    // A composite without sub-operators, as a process without elements makes, is zero for vectors of any length.
    if (hg::deref(op, "CeedOperator").is_empty()) in = out = 0;
    hg::for_each_single(*op, [&](CeedOperator_private &single) {
      const auto length = [&](const std::vector<CeedOperatorField> &fields, CeedSize &known, const char *what) {
        for (const CeedOperatorField field : fields) {
          if (!field->is_active()) continue;
          require(known < 0 || known == field->rstr->l_size, CEED_ERROR_INCOMPATIBLE, [&] {
            return text("CeedOperator '%s' field '%s': the active %s has length %" CeedSize_FMT
                        "; fields before it have %" CeedSize_FMT,
                        single.shown_name(), field->qf_field->name.c_str(), what, field->rstr->l_size, known);
          });
          known = field->rstr->l_size;
        }
      };
      length(single.input_list, in, "input");
      length(single.output_list, out, "output");
    });
    if (input_size != nullptr) *input_size = in;
    if (output_size != nullptr) *output_size = out;
  });
}

int CeedOperatorGetNumArgs(CeedOperator op, CeedInt *num_args) {
  return hg::guard(hg::ceed_of(op), [&] {
    hg::result(num_args, "num_args") =
        static_cast<CeedInt>(hg::deref(op, "CeedOperator").inputs.size() + op->outputs.size());
  });
}

int CeedOperatorHasTensorBases(CeedOperator op, bool *has_tensor_bases) {
  return hg::guard(hg::ceed_of(op), [&] {
    hg::deref(op, "CeedOperator");
    hg::result(has_tensor_bases, "has_tensor_bases") = true;
    for (const auto *list : {&op->input_list, &op->output_list}) {
      for (const CeedOperatorField field : *list) {
        if (field->is_set() && field->basis.get() != CEED_BASIS_NONE && !field->basis->is_tensor) {
          *has_tensor_bases = false;
        }
      }
    }
  });
}

int CeedOperatorGetActiveBases(CeedOperator op, CeedBasis *active_input_basis, CeedBasis *active_output_basis) {
  return hg::guard(hg::ceed_of(op), [&] {
    hand_out_active(op, &CeedOperatorField_private::basis, "basis", active_input_basis, active_output_basis);
  });
}

int CeedOperatorGetActiveBasis(CeedOperator op, CeedBasis *active_basis) {
  return hg::guard(hg::ceed_of(op), [&] {
    hg::hand_out(single_active(op, true, &CeedOperatorField_private::basis, "basis"), active_basis, "active_basis");
  });
}

int CeedOperatorGetActiveElemRestrictions(CeedOperator op, CeedElemRestriction *active_input_rstr,
                                          CeedElemRestriction *active_output_rstr) {
  return hg::guard(hg::ceed_of(op), [&] {
    hand_out_active(op, &CeedOperatorField_private::rstr, "restriction", active_input_rstr, active_output_rstr);
  });
}

int CeedOperatorGetActiveElemRestriction(CeedOperator op, CeedElemRestriction *active_rstr) {
  return hg::guard(hg::ceed_of(op), [&] {
    hg::hand_out(single_active(op, true, &CeedOperatorField_private::rstr, "restriction"), active_rstr, "active_rstr");
  });
}

int CeedOperatorFieldGetName(CeedOperatorField op_field, const char **field_name) {
  return hg::guard(nullptr, [&] { hg::result(field_name, "field_name") = deref(op_field).qf_field->name.c_str(); });
}

int CeedOperatorFieldGetElemRestriction(CeedOperatorField op_field, CeedElemRestriction *rstr) {
  return get(op_field, &CeedOperatorField_private::rstr, rstr, "rstr");
}

int CeedOperatorFieldGetBasis(CeedOperatorField op_field, CeedBasis *basis) {
  return get(op_field, &CeedOperatorField_private::basis, basis, "basis");
}

int CeedOperatorFieldGetVector(CeedOperatorField op_field, CeedVector *vec) {
  return get(op_field, &CeedOperatorField_private::vec, vec, "vec");
}

int CeedOperatorFieldGetData(CeedOperatorField op_field, const char **field_name, CeedElemRestriction *rstr,
                             CeedBasis *basis, CeedVector *vec) {
  return hg::guard(nullptr, [&] {
    const auto &field = deref(op_field);
    if (field_name != nullptr) *field_name = field.qf_field->name.c_str();
    if (rstr != nullptr) *rstr = hg::Ref(field.rstr).release();
    if (basis != nullptr) *basis = hg::Ref(field.basis).release();
    if (vec != nullptr) *vec = hg::Ref(field.vec).release();
  });
}
