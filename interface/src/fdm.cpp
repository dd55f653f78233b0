/// Element-wise inverse by fast diagonalisation.
///
/// In one direction, with the matrices B and G of the basis and the weights w, M = B^T w B and K = G^T w G are
/// diagonalised together: X^T M X = I, X^T K X = diag(λ). An element operator with constant coefficients on a box,
///
///   A = c_0 M⊗M⊗M + c_1 M⊗M⊗K + c_2 M⊗K⊗M + c_3 K⊗M⊗M,
///
/// has then the inverse (X⊗X⊗X) diag(1 / (c_0 + c_1 λ_i + c_2 λ_j + c_3 λ_k)) (X⊗X⊗X)^T. For other elements c is the
/// mean over the element of the diagonal of the assembled QFunction, Σ_q D(q) / Σ_q w(q), for each component by itself.
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "dense.hpp"
#include "operator.hpp"

namespace {

using hg::require;
using hg::text;

/// Coefficients of the mass and of the stiffness in each direction.
using Coefficients = std::array<CeedScalar, 4>;

/// Where an active value enters the coefficients: its component, and 0 for the mass, 1 + d for direction d; -1:
/// nowhere.
struct Role {
  CeedInt coefficient = -1, comp = 0;
};

std::vector<Role> roles(const CeedProgramField *fields, CeedInt num_fields, CeedInt num_values, CeedInt num_comp) {
  std::vector<Role> result(num_values);
  for (CeedInt i = 0; i < num_fields; i++) {
    const CeedProgramField &field = fields[i];
    if (field.first_value < 0 || field.eval_mode == CEED_EVAL_NONE) continue;
    for (CeedInt k = 0; k < field.size; k++) {
      const CeedInt direction = field.eval_mode == CEED_EVAL_GRAD ? 1 + k / num_comp : 0;
      result[field.first_value + k] = {direction, k % num_comp};
    }
  }
  return result;
}

CeedBasis_private &require_basis(CeedOperator_private &op) {
  CeedBasis in = nullptr, out = nullptr;
  hg::check(CeedOperatorGetActiveBases(&op, &in, &out));
  const auto held_in = hg::Ref<CeedBasis_private>::adopt(in), held_out = hg::Ref<CeedBasis_private>::adopt(out);
  require(hg::equal(*in, *out), CEED_ERROR_INCOMPATIBLE, [&] {
    return text(
        "CeedOperator '%s': active input and output have different bases; only an operator from a space to "
        "itself has an inverse by fast diagonalisation",
        op.shown_name());
  });
  require(in->is_tensor, CEED_ERROR_UNSUPPORTED, [&] {
    return text("CeedOperator '%s': its active basis has no tensor product; fast diagonalisation needs one",
                op.shown_name());
  });
  require(in->Q_1d >= in->P_1d, CEED_ERROR_DIMENSION, [&] {
    return text("CeedOperator '%s': its active basis has %" CeedInt_FMT " nodes and %" CeedInt_FMT
                " quadrature points a direction; fast diagonalisation needs as many points as nodes, else the mass "
                "matrix is singular",
                op.shown_name(), in->P_1d, in->Q_1d);
  });
  return *in;  // the operator holds it
}

/// M = B^T w B for a table B, Q by P.
std::vector<CeedScalar> gram(const std::vector<CeedScalar> &table, const std::vector<CeedScalar> &w, CeedInt Q,
                             CeedInt P) {
  std::vector<CeedScalar> m(static_cast<std::size_t>(P) * P, 0.0);
  for (CeedInt q = 0; q < Q; q++) {
    for (CeedInt i = 0; i < P; i++) {
      for (CeedInt j = 0; j < P; j++) m[i * P + j] += table[q * P + i] * w[q] * table[q * P + j];
    }
  }
  return m;
}

/// The mean coefficients of each (component, element), component fastest.
std::vector<Coefficients> mean_coefficients(CeedOperator_private &op, const CeedBasis_private &basis) {
  const CeedProgram &program = hg::program_of(op);
  const CeedInt num_in = program.num_active_in, num_out = program.num_active_out, num_comp = basis.num_comp;
  const auto in_roles = roles(program.inputs, program.num_inputs, num_in, num_comp),
             out_roles = roles(program.outputs, program.num_outputs, num_out, num_comp);
  CeedVector assembled = nullptr;
  CeedElemRestriction rstr = nullptr;
  hg::check(CeedOperatorLinearAssembleQFunction(&op, &assembled, &rstr, CEED_REQUEST_IMMEDIATE));
  const auto held_vector = hg::Ref<CeedVector_private>::adopt(assembled);
  const auto held_rstr = hg::Ref<CeedElemRestriction_private>::adopt(rstr);
  const hg::ReadArray values(assembled);
  const CeedScalar one_d = std::accumulate(basis.q_weight.begin(), basis.q_weight.end(), CeedScalar{0});
  const CeedScalar volume = std::pow(one_d, basis.dim);
  std::vector<Coefficients> means(static_cast<std::size_t>(program.num_elem) * num_comp, Coefficients{});
  for (CeedInt i = 0; i < num_in; i++) {
    for (CeedInt o = 0; o < num_out; o++) {
      const Role role = in_roles[i];
      if (role.coefficient < 0 || role.coefficient != out_roles[o].coefficient || role.comp != out_roles[o].comp)
        continue;
      const CeedInt component = i * num_out + o;
      for (CeedInt e = 0; e < program.num_elem; e++) {
        CeedScalar sum = 0.0;
        for (CeedInt q = 0; q < rstr->num_nodes(e); q++) sum += values[rstr->place(e, q, component)];
        means[static_cast<std::size_t>(e) * num_comp + role.comp][role.coefficient] += sum / volume;
      }
    }
  }
  return means;
}

/// Eigenvalues below `null` of the largest are zero up to rounding, as that of the constants without mass; they count
/// as `moved` of the largest: small beside the others, and rounding grows by no more than 1 / moved.
constexpr CeedScalar null = 1e-12, moved = 1e-5;

/// 1 / (c_0 + Σ_d c_(1+d) λ_(n_d)) for the nodes n of an element.
void invert(const Coefficients &c, const std::vector<CeedScalar> &lambda, CeedInt dim, CeedInt P, CeedScalar *inverse) {
  const auto P_1d = static_cast<CeedInt>(lambda.size());
  CeedScalar largest = 0.0;
  for (CeedInt n = 0; n < P; n++) {
    inverse[n] = c[0];
    for (CeedInt d = 0, rest = n; d < dim; d++, rest /= P_1d) inverse[n] += c[1 + d] * lambda[rest % P_1d];
    largest = std::max(largest, std::abs(inverse[n]));
  }
  const CeedScalar sign = std::accumulate(inverse, inverse + P, CeedScalar{0}) < 0 ? -1.0 : 1.0;
  for (CeedInt n = 0; n < P; n++) {
    const CeedScalar eigenvalue = std::abs(inverse[n]) <= null * largest ? sign * moved * largest : inverse[n];
    inverse[n] = largest > 0.0 ? 1.0 / eigenvalue : 0.0;
  }
}

hg::Ref<CeedOperator_private> create_inverse(CeedOperator_private &op) {
  require(!op.is_composite, CEED_ERROR_UNSUPPORTED, [&] {
    return text("CeedOperator '%s' is composite; fast diagonalisation is for single operators", op.shown_name());
  });
  hg::check_ready(op);
  const CeedBasis_private &basis = require_basis(op);
  CeedElemRestriction active_in = nullptr, active_out = nullptr;
  hg::check(CeedOperatorGetActiveElemRestrictions(&op, &active_in, &active_out));
  const auto rstr_in = hg::Ref<CeedElemRestriction_private>::adopt(active_in),
             rstr_out = hg::Ref<CeedElemRestriction_private>::adopt(active_out);
  const CeedInt P_1d = basis.P_1d, P = basis.P, num_comp = basis.num_comp, num_elem = op.num_elem;
  const Ceed ceed = op.ceed.get();

  std::vector<CeedScalar> x(static_cast<std::size_t>(P_1d) * P_1d), lambda(P_1d);
  hg::simultaneous_diagonalize(gram(basis.grad_1d, basis.q_weight, basis.Q_1d, P_1d),
                               gram(basis.interp_1d, basis.q_weight, basis.Q_1d, P_1d), x.data(), lambda.data(), P_1d);
  const auto means = mean_coefficients(op, basis);
  std::vector<CeedScalar> scale(static_cast<std::size_t>(num_elem) * num_comp * P);
  for (std::size_t i = 0; i < means.size(); i++) invert(means[i], lambda, basis.dim, P, &scale[i * P]);

  // "Interpolation" is X^T ⊗ X^T ⊗ X^T: the eigenvectors stand for the quadrature points.
  std::vector<CeedScalar> x_t(x.size()), zeros(x.size(), 0.0);
  for (CeedInt i = 0; i < P_1d; i++) {
    for (CeedInt j = 0; j < P_1d; j++) x_t[j * P_1d + i] = x[i * P_1d + j];
  }
  CeedBasis created_basis = nullptr;
  hg::check(CeedBasisCreateTensorH1(ceed, basis.dim, num_comp, P_1d, P_1d, x_t.data(), zeros.data(), zeros.data(),
                                    zeros.data(), &created_basis));
  const auto eigen_basis = hg::Ref<CeedBasis_private>::adopt(created_basis);
  CeedVector created_vector = nullptr;
  hg::check(CeedVectorCreate(ceed, static_cast<CeedSize>(scale.size()), &created_vector));
  const auto scale_vector = hg::Ref<CeedVector_private>::adopt(created_vector);
  hg::check(CeedVectorSetArray(created_vector, CEED_MEM_HOST, CEED_COPY_VALUES, scale.data()));
  const CeedInt strides[3] = {1, P, P * num_comp};
  CeedElemRestriction created_rstr = nullptr;
  hg::check(CeedElemRestrictionCreateStrided(ceed, num_elem, P, num_comp, static_cast<CeedSize>(scale.size()), strides,
                                             &created_rstr));
  const auto scale_rstr = hg::Ref<CeedElemRestriction_private>::adopt(created_rstr);

  CeedQFunction created_qf = nullptr;
  hg::check(CeedQFunctionCreateInteriorByName(ceed, "Scale", &created_qf));
  const auto qf = hg::Ref<CeedQFunction_private>::adopt(created_qf);
  hg::check(CeedQFunctionAddInput(created_qf, "input", num_comp, CEED_EVAL_INTERP));
  hg::check(CeedQFunctionAddInput(created_qf, "scale", num_comp, CEED_EVAL_NONE));
  hg::check(CeedQFunctionAddOutput(created_qf, "output", num_comp, CEED_EVAL_INTERP));
  hg::check(CeedQFunctionSetUserFlopsEstimate(created_qf, num_comp));
  CeedOperator created = nullptr;
  hg::check(CeedOperatorCreate(ceed, created_qf, CEED_QFUNCTION_NONE, CEED_QFUNCTION_NONE, &created));
  auto inverse = hg::Ref<CeedOperator_private>::adopt(created);
  // The inverse takes what the operator gives, and gives what it takes.
  hg::check(CeedOperatorSetField(created, "input", rstr_out.get(), eigen_basis.get(), CEED_VECTOR_ACTIVE));
  hg::check(CeedOperatorSetField(created, "scale", scale_rstr.get(), CEED_BASIS_NONE, scale_vector.get()));
  hg::check(CeedOperatorSetField(created, "output", rstr_in.get(), eigen_basis.get(), CEED_VECTOR_ACTIVE));
  return inverse;
}

}  // namespace

int CeedOperatorCreateFDMElementInverse(CeedOperator op, CeedOperator *fdm_inv, CeedRequest *) {
  return hg::guard(hg::ceed_of(op), [&] {
    hg::deref(op, "CeedOperator");
    require(fdm_inv != nullptr, CEED_ERROR_INCOMPLETE, [&] {
      return text("CeedOperator '%s': fdm_inv is NULL; expected where the handle goes", op->shown_name());
    });
    *fdm_inv = create_inverse(*op).release();
  });
}
