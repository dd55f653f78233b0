// How often the entries of L-vectors are used: by the elements of a restriction, by the parts of a composite operator.
#include <algorithm>
#include <span>
#include <vector>

#include "operator.hpp"

namespace {

/// Calls f(i) for the entry i of the L-vector of each component of each node of each element.
template <typename F>
void for_each_entry(const CeedElemRestriction_private &r, F &&f) {
  for (CeedInt e = 0; e < r.num_elem; e++) {
    for (CeedInt n = 0; n < r.num_nodes(e); n++) {
      for (CeedInt c = 0; c < r.num_comp; c++) f(r.place(e, n, c));
    }
  }
}

/// Write access to multiplicities, set to zero.
class Counts {
 public:
  Counts(CeedVector mult, CeedSize needed, hg::Where where = hg::Where::current())
      : array_(require_length(mult, needed, where), hg::WriteArray::write_only) {
    std::fill_n(array_.data(), mult->length, 0.0);
  }
  CeedScalar &operator[](CeedSize i) const { return array_[i]; }

 private:
  static CeedVector require_length(CeedVector mult, CeedSize needed, hg::Where where) {
    const auto &vec = hg::deref_vector(mult, "CeedVector of multiplicities", where);
    hg::require(
        vec.length >= needed, CEED_ERROR_DIMENSION,
        [&] {
          return hg::text("CeedVector of multiplicities has %td entries; expected at least the L-vector size %td",
                          vec.length, needed);
        },
        where);
    return mult;
  }

  hg::WriteArray array_;
};

}  // namespace

int CeedElemRestrictionGetMultiplicity(CeedElemRestriction rstr, CeedVector mult) {
  return hg::guard(hg::ceed_of(rstr), [&] {
    const auto &r = hg::deref_restriction(rstr);
    const Counts counts(mult, r.l_size);
    for_each_entry(r, [&](CeedSize i) { counts[i] += 1; });
  });
}

int CeedOperatorCompositeGetMultiplicity(CeedOperator op, CeedInt num_skip_indices, CeedInt *skip_indices,
                                         CeedVector mult) {
  return hg::guard(hg::ceed_of(op), [&] {
    const auto &composite = hg::deref(op, "CeedOperator");
    hg::require(composite.is_composite, CEED_ERROR_MINOR,
                [&] { return hg::text("CeedOperator '%s' is not composite", composite.shown_name()); });
    hg::require(num_skip_indices == 0 || (num_skip_indices > 0 && skip_indices != nullptr), CEED_ERROR_MINOR, [&] {
      return hg::text("CeedOperatorCompositeGetMultiplicity: %" CeedInt_FMT
                      " indices to skip, in %s; expected 0, or an array of so many",
                      num_skip_indices, skip_indices == nullptr ? "an array that is NULL" : "an array");
    });
    std::vector<bool> is_skipped(composite.subs.size());
    for (const CeedInt index : std::span(skip_indices, static_cast<std::size_t>(num_skip_indices))) {
      hg::require(index >= 0 && index < static_cast<CeedInt>(is_skipped.size()), CEED_ERROR_DIMENSION, [&] {
        return hg::text("CeedOperatorCompositeGetMultiplicity: sub-operator to skip is %" CeedInt_FMT
                        "; expected one in [0, %zu)",
                        index, is_skipped.size());
      });
      is_skipped[index] = true;
    }
    CeedSize input_size = 0;
    hg::check(CeedOperatorGetActiveVectorLengths(op, &input_size, nullptr));
    const Counts counts(mult, input_size);
    std::vector<bool> is_used;
    for (std::size_t s = 0; s < composite.subs.size(); s++) {
      if (is_skipped[s]) continue;
      is_used.assign(static_cast<std::size_t>(std::max<CeedSize>(input_size, 0)), false);
      hg::for_each_single(*composite.subs[s], [&](CeedOperator_private &single) {
        for (const CeedOperatorField field : single.input_list) {
          if (field->is_active()) for_each_entry(*field->rstr, [&](CeedSize i) { is_used[i] = true; });
        }
      });
      for (CeedSize i = 0; i < input_size; i++) counts[i] += is_used[i] ? 1 : 0;
    }
  });
}
