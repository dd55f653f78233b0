// Levels of p-multigrid: the operator on a coarse space over the same points, and the maps between the spaces.
//
// With the restriction R and orientation T of elements, the interpolation I from coarse to fine nodes of an element,
// and the multiplicity m of entries of the fine L-vector, prolongation and restriction are
//
//   P = R_f^T T_f^T (I T_c R_c),  scaled by 1/m at each fine node,   and P^T:
//
// each element proposes a value for its fine nodes, and their mean is taken.
#include <algorithm>

#include "operator.hpp"

namespace {

using hg::check;
using hg::require;
using hg::text;

using BasisRef = hg::Ref<CeedBasis_private>;
using OperatorRef = hg::Ref<CeedOperator_private>;
using RestrictionRef = hg::Ref<CeedElemRestriction_private>;
using VectorRef = hg::Ref<CeedVector_private>;

/// The space of all active fields that have a basis.
struct Space {
  CeedElemRestriction_private *rstr = nullptr;
  CeedBasis_private *basis = nullptr;
};

bool is_in_space(const CeedOperatorField_private &field) {
  return field.is_active() && field.basis.get() != CEED_BASIS_NONE;
}

/// Throws unless there is one such space in the operator or in all its sub-operators.
Space active_space(CeedOperator_private &op) {
  Space space;
  hg::for_each_single(op, [&](CeedOperator_private &single) {
    for (const auto *list : {&single.input_list, &single.output_list}) {
      for (const CeedOperatorField field : *list) {
        if (!is_in_space(*field)) continue;
        if (space.rstr == nullptr) space = {field->rstr.get(), field->basis.get()};
        require(hg::equal(*space.rstr, *field->rstr) && hg::equal(*space.basis, *field->basis), CEED_ERROR_INCOMPATIBLE,
                [&] {
                  return text(
                      "CeedOperator '%s' field '%s': the active field has another restriction or basis than an "
                      "active field before it%s; a multigrid level replaces one space",
                      single.shown_name(), field->qf_field->name.c_str(),
                      op.is_composite ? ". Make a level of each sub-operator, with "
                                        "CeedOperatorCompositeGetMultiplicity(), and compose them"
                                      : "");
                });
      }
    }
  });
  require(space.rstr != nullptr, CEED_ERROR_INCOMPATIBLE, [&] {
    return text("CeedOperator '%s': no active field has a basis; a multigrid level replaces the space of active fields",
                op.shown_name());
  });
  return space;
}

/// Throws unless the coarse space can take the place of the fine one.
void check_coarse(CeedOperator_private &op, const Space &fine, const CeedElemRestriction_private &rstr,
                  const CeedBasis_private &basis) {
  const auto agree = [&](CeedInt got, CeedInt expected, const char *what) {
    require(got == expected, CEED_ERROR_DIMENSION, [&] {
      return text("CeedOperator '%s': %s is %" CeedInt_FMT "; expected %" CeedInt_FMT, op.shown_name(), what, got,
                  expected);
    });
  };
  require(!rstr.is_points(), CEED_ERROR_INCOMPATIBLE, [&] {
    return text("CeedOperator '%s': the coarse restriction is one at points; expected one with nodes", op.shown_name());
  });
  agree(rstr.num_elem, fine.rstr->num_elem, "the number of elements of the coarse restriction");
  agree(rstr.num_comp, fine.rstr->num_comp, "the number of components of the coarse restriction");
  agree(rstr.elem_size, basis.P, "the element size of the coarse restriction");
  agree(basis.num_comp, fine.basis->num_comp, "the number of components of the coarse basis");
  hg::for_each_single(op, [&](CeedOperator_private &single) {
    if (single.is_at_points) return;
    agree(basis.Q, fine.basis->Q, "the number of quadrature points of the coarse basis");
  });
}

/// The operator with the coarse space in place of the fine one; all other fields, and the points, are shared.
OperatorRef coarsen(CeedOperator_private &fine, const Space &coarse) {
  Ceed ceed = fine.ceed.get();
  CeedOperator created = nullptr;
  if (fine.is_composite) {
    check(CeedOperatorCreateComposite(ceed, &created));
    auto op = OperatorRef::adopt(created);
    op->is_sequential = fine.is_sequential;
    for (const auto &sub : fine.subs) check(CeedOperatorCompositeAddSub(created, coarsen(*sub, coarse).get()));
    op->name = fine.name;
    return op;
  }
  check((fine.is_at_points ? CeedOperatorCreateAtPoints : CeedOperatorCreate)(ceed, fine.qf.get(), CEED_QFUNCTION_NONE,
                                                                              CEED_QFUNCTION_NONE, &created));
  auto op = OperatorRef::adopt(created);
  for (const auto *list : {&fine.input_list, &fine.output_list}) {
    for (const CeedOperatorField field : *list) {
      const bool is_replaced = is_in_space(*field);
      check(CeedOperatorSetField(created, field->qf_field->name.c_str(), is_replaced ? coarse.rstr : field->rstr.get(),
                                 is_replaced ? coarse.basis : field->basis.get(), field->vec.get()));
    }
  }
  if (fine.is_at_points) check(CeedOperatorAtPointsSetPoints(created, fine.points_rstr.get(), fine.points.get()));
  op->name = fine.name;
  return op;
}

/// T^T must undo T, as it does for signs and permutations: a value proposed for a node of the element is then one for
/// its entry of the L-vector.
void require_orthogonal(const CeedOperator_private &op, const CeedElemRestriction_private &rstr) {
  if (rstr.num_bands <= 1) return;
  std::vector<CeedInt> square(static_cast<std::size_t>(rstr.elem_size) * 5);
  for (CeedInt e = 0; e < rstr.num_elem; e++) {
    // T^T T has five bands: entry (m, m + k - 2) at m*5 + k.
    std::fill(square.begin(), square.end(), 0);
    for (CeedInt n = 0; n < rstr.elem_size; n++) {
      rstr.for_each_turned(e, n, [&](CeedInt m, CeedInt8 a) {
        rstr.for_each_turned(e, n, [&](CeedInt k, CeedInt8 b) { square[m * 5 + k - m + 2] += a * b; });
      });
    }
    for (std::size_t i = 0; i < square.size(); i++) {
      require(square[i] == (i % 5 == 2 ? 1 : 0), CEED_ERROR_UNSUPPORTED, [&] {
        return text("CeedOperator '%s': the curl-orientation of element %" CeedInt_FMT
                    " is not orthogonal; prolongation takes signs and permutations of nodes",
                    op.shown_name(), e);
      });
    }
  }
}

/// 1/m for the entries of the fine L-vector: the elements that meet there, times what the user knows of others.
VectorRef scale_of(Ceed ceed, CeedElemRestriction_private &rstr, CeedVector p_mult_fine) {
  CeedVector created = nullptr;
  check(CeedElemRestrictionCreateVector(&rstr, &created, nullptr));
  auto scale = VectorRef::adopt(created);
  check(CeedVectorCreate(ceed, rstr.l_size, &created));
  const auto local = VectorRef::adopt(created);
  check(CeedElemRestrictionGetMultiplicity(&rstr, local.get()));
  check(CeedVectorPointwiseMult(scale.get(), local.get(), p_mult_fine));
  check(CeedVectorReciprocal(scale.get()));
  return scale;
}

/// One side of a map between spaces: nodes of the fine elements, or coarse nodes evaluated there.
struct Side {
  CeedEvalMode mode;
  CeedElemRestriction rstr;
  CeedBasis basis;
};

OperatorRef make_transfer(Ceed ceed, const std::string &name, const Side &in, const Side &out,
                          CeedElemRestriction scale_rstr, CeedVector scale) {
  CeedQFunction qf = nullptr;
  check(CeedQFunctionCreateInteriorByName(ceed, "Scale", &qf));
  const auto held = hg::Ref<CeedQFunction_private>::adopt(qf);
  const CeedInt num_comp = scale_rstr->num_comp;
  check(CeedQFunctionAddInput(qf, "input", num_comp, in.mode));
  check(CeedQFunctionAddInput(qf, "scale", num_comp, CEED_EVAL_NONE));
  check(CeedQFunctionAddOutput(qf, "output", num_comp, out.mode));
  CeedOperator op = nullptr;
  check(CeedOperatorCreate(ceed, qf, CEED_QFUNCTION_NONE, CEED_QFUNCTION_NONE, &op));
  auto transfer = OperatorRef::adopt(op);
  check(CeedOperatorSetField(op, "input", in.rstr, in.basis, CEED_VECTOR_ACTIVE));
  check(CeedOperatorSetField(op, "scale", scale_rstr, CEED_BASIS_NONE, scale));
  check(CeedOperatorSetField(op, "output", out.rstr, out.basis, CEED_VECTOR_ACTIVE));
  check(CeedOperatorSetName(op, name.c_str()));
  return transfer;
}

struct Transfers {
  OperatorRef prolong, restrict;
};

Transfers make_transfers(const CeedOperator_private &op, const Space &fine, const Space &coarse, CeedVector p_mult_fine,
                         CeedBasis coarse_to_fine) {
  Ceed ceed = op.ceed.get();
  require_orthogonal(op, *fine.rstr);
  const VectorRef scale = scale_of(ceed, *fine.rstr, p_mult_fine);
  // Counts have no orientation.
  CeedElemRestriction unsigned_copy = nullptr;
  check(CeedElemRestrictionCreateUnsignedCopy(fine.rstr, &unsigned_copy));
  const auto scale_rstr = RestrictionRef::adopt(unsigned_copy);
  const Side at_fine{CEED_EVAL_NONE, fine.rstr, CEED_BASIS_NONE},
      at_coarse{CEED_EVAL_INTERP, coarse.rstr, coarse_to_fine};
  const std::string of = op.name.empty() ? "" : " for " + op.name;
  return {make_transfer(ceed, "prolongation" + of, at_coarse, at_fine, scale_rstr.get(), scale.get()),
          make_transfer(ceed, "restriction" + of, at_fine, at_coarse, scale_rstr.get(), scale.get())};
}

/// Where the handles of a level go; each may be NULL.
struct Level {
  CeedOperator *coarse, *prolong, *restrict;
};

/// Body of the functions that create a level; make_basis(fine basis) makes the basis from coarse to fine nodes.
template <typename MakeBasis>
void create_level(CeedOperator op_fine, CeedVector p_mult_fine, CeedElemRestriction rstr_coarse, CeedBasis basis_coarse,
                  const Level &level, MakeBasis &&make_basis) {
  hg::check_ready(hg::deref(op_fine, "fine CeedOperator"));
  const Space coarse{&hg::deref_restriction(rstr_coarse), &hg::deref_basis(basis_coarse)};
  const Space fine = active_space(*op_fine);
  check_coarse(*op_fine, fine, *coarse.rstr, *coarse.basis);
  OperatorRef op_coarse;
  Transfers transfers;
  if (level.coarse != nullptr) op_coarse = coarsen(*op_fine, coarse);
  if (level.prolong != nullptr || level.restrict != nullptr) {
    hg::deref(p_mult_fine, "multiplicity of the fine L-vector (needed for prolongation and restriction)");
    require(p_mult_fine->length == fine.rstr->l_size, CEED_ERROR_DIMENSION, [&] {
      return text("CeedOperator '%s': the multiplicity has length %" CeedSize_FMT "; expected %" CeedSize_FMT
                  ", the length of the fine L-vector",
                  op_fine->shown_name(), p_mult_fine->length, fine.rstr->l_size);
    });
    const BasisRef coarse_to_fine = make_basis(*fine.basis);
    transfers = make_transfers(*op_fine, fine, coarse, p_mult_fine, coarse_to_fine.get());
  }
  if (level.coarse != nullptr) *level.coarse = op_coarse.release();
  if (level.prolong != nullptr) *level.prolong = transfers.prolong.release();
  if (level.restrict != nullptr) *level.restrict = transfers.restrict.release();
}

}  // namespace

int CeedOperatorMultigridLevelCreate(CeedOperator op_fine, CeedVector p_mult_fine, CeedElemRestriction rstr_coarse,
                                     CeedBasis basis_coarse, CeedOperator *op_coarse, CeedOperator *op_prolong,
                                     CeedOperator *op_restrict) {
  return hg::guard(hg::ceed_of(op_fine), [&] {
    create_level(op_fine, p_mult_fine, rstr_coarse, basis_coarse, {op_coarse, op_prolong, op_restrict},
                 [&](CeedBasis_private &fine) {
                   CeedBasis created = nullptr;
                   check(CeedBasisCreateProjection(basis_coarse, &fine, &created));
                   return BasisRef::adopt(created);
                 });
  });
}

int CeedOperatorMultigridLevelCreateTensorH1(CeedOperator op_fine, CeedVector p_mult_fine,
                                             CeedElemRestriction rstr_coarse, CeedBasis basis_coarse,
                                             const CeedScalar *interp_c_to_f, CeedOperator *op_coarse,
                                             CeedOperator *op_prolong, CeedOperator *op_restrict) {
  return hg::guard(hg::ceed_of(op_fine), [&] {
    create_level(op_fine, p_mult_fine, rstr_coarse, basis_coarse, {op_coarse, op_prolong, op_restrict},
                 [&](CeedBasis_private &fine) {
                   const CeedBasis_private &coarse = *basis_coarse;
                   hg::require_argument(interp_c_to_f, "interp_c_to_f (fine P_1d * coarse P_1d entries)");
                   hg::require_tensor(coarse, "interpolation from one dimension");
                   hg::require_tensor(fine, "interpolation from one dimension");
                   const CeedInt P = coarse.P_1d, Q = fine.P_1d;
                   const std::vector<CeedScalar> grad(static_cast<std::size_t>(P) * Q), points(Q);
                   CeedBasis created = nullptr;
                   check(CeedBasisCreateTensorH1(coarse.ceed.get(), coarse.dim, coarse.num_comp, P, Q, interp_c_to_f,
                                                 grad.data(), points.data(), points.data(), &created));
                   return BasisRef::adopt(created);
                 });
  });
}

int CeedOperatorMultigridLevelCreateH1(CeedOperator op_fine, CeedVector p_mult_fine, CeedElemRestriction rstr_coarse,
                                       CeedBasis basis_coarse, const CeedScalar *interp_c_to_f, CeedOperator *op_coarse,
                                       CeedOperator *op_prolong, CeedOperator *op_restrict) {
  return hg::guard(hg::ceed_of(op_fine), [&] {
    create_level(op_fine, p_mult_fine, rstr_coarse, basis_coarse, {op_coarse, op_prolong, op_restrict},
                 [&](CeedBasis_private &fine) {
                   const CeedBasis_private &coarse = *basis_coarse;
                   hg::require_argument(interp_c_to_f, "interp_c_to_f (fine nodes * coarse nodes entries)");
                   CeedBasis created = nullptr;
                   check(CeedBasisCreateH1(coarse.ceed.get(), coarse.topology, coarse.num_comp, coarse.P, fine.P,
                                           interp_c_to_f, nullptr, nullptr, nullptr, &created));
                   return BasisRef::adopt(created);
                 });
  });
}
