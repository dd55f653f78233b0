/// @file
/// Restrictions, bases and a QFunction, composed; or a sum of such operators.
#pragma once

#include <algorithm>
#include <deque>
#include <memory>
#include <string>
#include <vector>

#include "basis.hpp"
#include "program.hpp"
#include "qfunction.hpp"
#include "restriction.hpp"
#include "vector.hpp"

struct CeedOperatorField_private {
  CeedQFunctionField qf_field = nullptr;
  hg::Ref<CeedElemRestriction_private> rstr;
  hg::Ref<CeedBasis_private> basis;
  hg::Ref<CeedVector_private> vec;

  bool is_set() const { return static_cast<bool>(vec); }
  bool is_active() const { return vec.get() == CEED_VECTOR_ACTIVE; }
};

struct CeedOperator_private final : CeedObject_private {
  ~CeedOperator_private() override;
  void view(FILE *stream) const override { view(stream, true); }
  void view(FILE *stream, bool with_fields) const;
  /// What stands below the title: the fields of a single operator, the parts of a composite one.
  void view_fields(FILE *stream, CeedInt tabs) const;
  void view_parts(FILE *stream, CeedInt tabs, bool with_fields) const;
  Ceed owner() const override { return ceed.get(); }

  hg::Ref<Ceed_private> ceed;
  std::string name;  ///< as it was set; "" where it was not
  bool is_at_points = false, is_composite = false, is_sequential = false;
  bool is_immutable = false;  ///< used: takes no more fields or sub-operators

  // A single operator.
  hg::Ref<CeedQFunction_private> qf;
  std::vector<std::unique_ptr<CeedOperatorField_private>> inputs, outputs;  ///< as the QFunction orders them
  std::vector<CeedOperatorField> input_list, output_list;                   ///< what GetFields hands out
  CeedInt num_elem = -1, num_qpts = -1;                                     ///< -1: no field has told yet
  hg::Ref<CeedElemRestriction_private> points_rstr;
  hg::Ref<CeedVector_private> points;
  CeedSize points_epoch = 0;
  CeedSize checked_points = -1;  ///< the epoch in which points and fields were found to belong together
  std::unique_ptr<hg::Program> program;  ///< NULL until lowered
  bool is_program_stale = false;         ///< points or fields at points were set after lowering
  void *data = nullptr;                  ///< of the backend

  // A composite operator.
  std::vector<hg::Ref<CeedOperator_private>> subs;
  std::vector<CeedOperator> sub_list;               ///< what GetSubList hands out
  std::deque<CeedContextFieldLabel_private> labels;  ///< of fields that sub-operators share
  bool is_joined = false;  ///< the backend has applied its parts together, and may keep data for that

  // Assembly.
  bool reuses_assembly = false, assembly_needs_update = true;
  hg::Ref<CeedVector_private> assembled;
  hg::Ref<CeedElemRestriction_private> assembled_rstr;

  /// Whether there is no single operator in it: it is zero, for vectors of any length.
  bool is_empty() const {
    return is_composite && std::all_of(subs.begin(), subs.end(), [](const auto &sub) { return sub->is_empty(); });
  }
  /// Its name; without one, that of its QFunction; "" for a composite without one.
  const char *full_name() const { return (name.empty() && qf ? qf->name() : name).c_str(); }
  /// For messages.
  const char *shown_name() const { return *full_name() == '\0' ? "(no name)" : full_name(); }
};

namespace hg {

/// Throws unless every field is set and they fit together; sets is_immutable.
void check_ready(CeedOperator_private &op);
/// Throws (CEED_ERROR_INCOMPATIBLE) if the operator reads the vector that is to be written, as a passive input or as the
/// coordinates of points.
void require_not_read(CeedOperator_private &op, CeedVector vec, const char *what);
/// The program of a single operator, lowered on the first call (which checks that the operator is ready).
const CeedProgram &program_of(CeedOperator_private &op);
/// Calls f for the operator, or for each sub-operator in turn.
template <typename F>
void for_each_single(CeedOperator_private &op, F &&f) {
  if (!op.is_composite) return f(op);
  for (const auto &sub : op.subs) for_each_single(*sub, f);
}

}  // namespace hg
