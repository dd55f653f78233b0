#include "elliptic.hpp"

namespace hg::test {

EllipticOperator::EllipticOperator(Ceed ceed_, const Box &mesh, Elliptic kind, CeedInt num_comp, CeedInt Q_1d,
                                   CeedQuadMode quad_mode)
    : ceed(ceed_), l_size(static_cast<CeedSize>(mesh.num_nodes) * num_comp) {
  const CeedInt dim = mesh.dim, Q = CeedIntPow(Q_1d, dim);
  const bool is_mass = kind == Elliptic::mass;
  const CeedInt q_size = is_mass ? 1 : dim * (dim + 1) / 2;
  rstr_x = mesh.restriction(ceed, dim);
  rstr_u = mesh.restriction(ceed, num_comp);
  ok(CeedElemRestrictionCreateStrided(ceed, mesh.num_elem, Q, q_size, static_cast<CeedSize>(mesh.num_elem) * Q * q_size,
                                      CEED_STRIDES_BACKEND, rstr_q.out()));
  ok(CeedBasisCreateTensorH1Lagrange(ceed, dim, dim, mesh.P_1d, Q_1d, quad_mode, basis_x.out()));
  ok(CeedBasisCreateTensorH1Lagrange(ceed, dim, num_comp, mesh.P_1d, Q_1d, quad_mode, basis_u.out()));
  x = make_vector(ceed, mesh.coordinates);
  ok(CeedElemRestrictionCreateVector(rstr_q, q_data.out(), nullptr));

  const std::string d = std::to_string(dim) + "D", name = is_mass ? "Mass" : "Poisson";
  ok(CeedQFunctionCreateInteriorByName(ceed, (name + d + "Build").c_str(), qf_build.out()));
  ok(CeedOperatorCreate(ceed, qf_build, CEED_QFUNCTION_NONE, CEED_QFUNCTION_NONE, op_build.out()));
  ok(CeedOperatorSetField(op_build, "dx", rstr_x, basis_x, CEED_VECTOR_ACTIVE));
  ok(CeedOperatorSetField(op_build, "weights", CEED_ELEMRESTRICTION_NONE, basis_x, CEED_VECTOR_NONE));
  ok(CeedOperatorSetField(op_build, "qdata", rstr_q, CEED_BASIS_NONE, CEED_VECTOR_ACTIVE));
  ok(CeedOperatorApply(op_build, x, q_data, CEED_REQUEST_IMMEDIATE));

  const std::string applied = (num_comp == 3 ? "Vector3" : "") + name + (is_mass ? "" : d) + "Apply";
  ok(CeedQFunctionCreateInteriorByName(ceed, applied.c_str(), qf_apply.out()));
  ok(CeedOperatorCreate(ceed, qf_apply, CEED_QFUNCTION_NONE, CEED_QFUNCTION_NONE, op.out()));
  ok(CeedOperatorSetField(op, is_mass ? "u" : "du", rstr_u, basis_u, CEED_VECTOR_ACTIVE));
  ok(CeedOperatorSetField(op, "qdata", rstr_q, CEED_BASIS_NONE, q_data));
  ok(CeedOperatorSetField(op, is_mass ? "v" : "dv", rstr_u, basis_u, CEED_VECTOR_ACTIVE));
}

Values EllipticOperator::apply(const Values &in) const {
  const Vector u = make_vector(ceed, in), v = make_vector(ceed, l_size, 1e30);
  ok(CeedOperatorApply(op, u, v, CEED_REQUEST_IMMEDIATE));
  return values_of(v);
}

}  // namespace hg::test
