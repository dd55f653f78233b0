#include "failure_scenarios.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <iterator>

#include "support/handles.hpp"

namespace hg::test {
namespace {

void must(int code) {
  if (code != CEED_ERROR_SUCCESS) throw Refused{code};
}

void expect(bool condition, const char *what) {
  if (!condition) throw Wrong{what};
}

FILE *nowhere() {
  static FILE *const stream = std::fopen("/dev/null", "w");
  return stream;
}

/// What malloc() gave.
template <typename T>
struct Freed {
  T *array = nullptr;
  Freed() = default;
  Freed(const Freed &) = delete;
  Freed &operator=(const Freed &) = delete;
  ~Freed() { std::free(array); }
};

void fill(Ceed ceed, Vector &vec, CeedSize length, CeedScalar value) {
  must(CeedVectorCreate(ceed, length, vec.out()));
  must(CeedVectorSetValue(vec, value));
}

void expect_all(CeedVector vec, CeedScalar value, const char *what) {
  const CeedScalar *array = nullptr;
  CeedSize length = 0;
  must(CeedVectorGetLength(vec, &length));
  must(CeedVectorGetArrayRead(vec, CEED_MEM_HOST, &array));
  const bool is_right = std::all_of(array, array + length, [&](CeedScalar x) { return std::abs(x - value) < 1e-12; });
  must(CeedVectorRestoreArrayRead(vec, &array));
  expect(is_right, what);
}

CeedScalar sum_of(CeedVector vec) {
  const CeedScalar *array = nullptr;
  CeedSize length = 0;
  must(CeedVectorGetLength(vec, &length));
  must(CeedVectorGetArrayRead(vec, CEED_MEM_HOST, &array));
  CeedScalar sum = 0;
  for (CeedSize i = 0; i < length; i++) sum += array[i];
  must(CeedVectorRestoreArrayRead(vec, &array));
  return sum;
}

void use_vectors(Ceed ceed) {
  Vector x, y, z, copy;
  fill(ceed, x, 5, 2);
  fill(ceed, y, 5, 3);
  must(CeedVectorCreate(ceed, 5, z.out()));
  must(CeedVectorPointwiseMult(z, x, y));
  must(CeedVectorAXPY(z, 2, x));
  must(CeedVectorAXPBY(z, 1, 0.5, y));
  expect_all(z, 8, "arithmetic of vectors");
  must(CeedVectorCopy(z, x));
  must(CeedVectorCopyStrided(y, 0, -1, 2, x));
  must(CeedVectorSetValueStrided(x, 1, -1, 2, 3));
  must(CeedVectorScale(x, 2));
  must(CeedVectorReciprocal(x));
  must(CeedVectorFilter(x, 1e-3));
  expect_all(x, 1. / 6, "more arithmetic of vectors");
  CeedScalar norm = 0;
  must(CeedVectorNorm(x, CEED_NORM_MAX, &norm));
  CeedScalar values[5] = {1, 2, 3, 4, 5}, *array = nullptr;
  must(CeedVectorSetArray(y, CEED_MEM_HOST, CEED_COPY_VALUES, values));
  must(CeedVectorSetArray(x, CEED_MEM_HOST, CEED_USE_POINTER, values));
  must(CeedVectorTakeArray(x, CEED_MEM_HOST, &array));
  must(CeedVectorReferenceCopy(y, copy.address()));
  must(CeedVectorView(copy, "%g", nowhere()));
  expect(sum_of(copy) == 15, "values of a vector");
  Vector work;
  must(CeedGetWorkVector(ceed, 4, work.address()));
  must(CeedRestoreWorkVector(ceed, work.address()));
}

void use_restrictions(Ceed ceed) {
  constexpr CeedInt offsets[6] = {0, 1, 2, 2, 3, 4};
  constexpr bool signs[6] = {true, false, true, false, true, false};
  constexpr CeedInt8 bands[18] = {0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0};
  constexpr CeedInt points[] = {3, 5, 6, 0, 2, 1};
  Restriction plain, oriented, turned, strided, blocked, blocked_turned, at_points, unsigned_copy, unoriented;
  must(CeedElemRestrictionCreate(ceed, 2, 3, 1, 1, 5, CEED_MEM_HOST, CEED_COPY_VALUES, offsets, plain.out()));
  must(CeedElemRestrictionCreateOriented(ceed, 2, 3, 1, 1, 5, CEED_MEM_HOST, CEED_COPY_VALUES, offsets, signs,
                                         oriented.out()));
  must(CeedElemRestrictionCreateCurlOriented(ceed, 2, 3, 1, 1, 5, CEED_MEM_HOST, CEED_USE_POINTER, offsets, bands,
                                             turned.out()));
  must(CeedElemRestrictionCreateStrided(ceed, 2, 3, 1, 6, CEED_STRIDES_BACKEND, strided.out()));
  must(CeedElemRestrictionCreateBlocked(ceed, 2, 3, 4, 1, 1, 5, CEED_MEM_HOST, CEED_COPY_VALUES, offsets,
                                        blocked.out()));
  must(CeedElemRestrictionCreateBlockedCurlOriented(ceed, 2, 3, 4, 1, 1, 5, CEED_MEM_HOST, CEED_COPY_VALUES, offsets,
                                                    bands, blocked_turned.out()));
  must(CeedElemRestrictionCreateAtPoints(ceed, 2, 3, 1, 3, CEED_MEM_HOST, CEED_COPY_VALUES, points, at_points.out()));
  must(CeedElemRestrictionCreateUnsignedCopy(oriented, unsigned_copy.out()));
  must(CeedElemRestrictionCreateUnorientedCopy(turned, unoriented.out()));
  for (CeedElemRestriction rstr : {plain.get(), oriented.get(), turned.get(), strided.get(), blocked.get(),
                                   blocked_turned.get(), at_points.get(), unsigned_copy.get(), unoriented.get()}) {
    Vector l, e, multiplicity;
    must(CeedElemRestrictionCreateVector(rstr, l.out(), e.out()));
    must(CeedVectorSetValue(l, 1));
    must(CeedElemRestrictionApply(rstr, CEED_NOTRANSPOSE, l, e, CEED_REQUEST_IMMEDIATE));
    must(CeedVectorSetValue(l, 0));
    must(CeedElemRestrictionApply(rstr, CEED_TRANSPOSE, e, l, CEED_REQUEST_IMMEDIATE));
    expect(sum_of(l) == (rstr == at_points ? 3 : 6), "a restriction and its transpose");
    must(CeedElemRestrictionCreateVector(rstr, multiplicity.out(), nullptr));
    must(CeedElemRestrictionGetMultiplicity(rstr, multiplicity));
    must(CeedElemRestrictionView(rstr, nowhere()));
  }
}

void use_bases(Ceed ceed) {
  Basis linear, quadratic, given, projection, tabulated, hdiv, hcurl;
  must(CeedBasisCreateTensorH1Lagrange(ceed, 2, 1, 2, 3, CEED_GAUSS, linear.out()));
  must(CeedBasisCreateTensorH1Lagrange(ceed, 2, 1, 3, 3, CEED_GAUSS, quadratic.out()));
  must(CeedBasisCreateProjection(linear, quadratic, projection.out()));
  const CeedScalar *interp_1d = nullptr, *grad_1d = nullptr, *q_ref = nullptr, *q_weight = nullptr, *matrix = nullptr;
  must(CeedBasisGetInterp1D(linear, &interp_1d));
  must(CeedBasisGetGrad1D(linear, &grad_1d));
  must(CeedBasisGetQRef(linear, &q_ref));
  must(CeedBasisGetQWeights(linear, &q_weight));
  must(CeedBasisCreateTensorH1(ceed, 2, 1, 2, 3, interp_1d, grad_1d, q_ref, q_weight, given.out()));
  must(CeedBasisGetInterp(given, &matrix));
  must(CeedBasisGetGrad(given, &matrix));
  CeedInt num_coeff = 0;
  must(CeedBasisGetChebyshevCoefficients1D(given, &num_coeff, &matrix));
  CeedScalar numbers[48];
  for (int i = 0; i < 48; i++) numbers[i] = 0.25 * (i % 5);
  must(CeedBasisCreateH1(ceed, CEED_TOPOLOGY_TRIANGLE, 1, 3, 4, numbers, numbers, numbers, numbers, tabulated.out()));
  must(CeedBasisCreateHdiv(ceed, CEED_TOPOLOGY_QUAD, 1, 4, 4, numbers, numbers, numbers, numbers, hdiv.out()));
  must(CeedBasisCreateHcurl(ceed, CEED_TOPOLOGY_QUAD, 1, 4, 4, numbers, numbers, numbers, numbers, hcurl.out()));
  for (CeedBasis basis : {linear.get(), quadratic.get(), given.get(), projection.get(), tabulated.get(), hdiv.get()}) {
    CeedInt P = 0, Q = 0, q_comp = 0;
    must(CeedBasisGetNumNodes(basis, &P));
    must(CeedBasisGetNumQuadraturePoints(basis, &Q));
    must(CeedBasisGetNumQuadratureComponents(basis, CEED_EVAL_INTERP, &q_comp));
    Vector u, v;
    fill(ceed, u, 2 * P, 1);
    must(CeedVectorCreate(ceed, CeedSize{2} * Q * q_comp, v.out()));
    must(CeedBasisApply(basis, 2, CEED_NOTRANSPOSE, CEED_EVAL_INTERP, u, v));
    if (basis == linear || basis == quadratic) expect_all(v, 1, "interpolation of 1");
    must(CeedBasisApplyAdd(basis, 2, CEED_TRANSPOSE, CEED_EVAL_INTERP, v, u));
    must(CeedBasisView(basis, nowhere()));
  }
  constexpr CeedInt num_points[2] = {2, 1};
  Vector x, u, v;
  fill(ceed, x, 6, 0.3);
  fill(ceed, u, 8, 1);
  must(CeedVectorCreate(ceed, 3, v.out()));
  must(CeedBasisApplyAtPoints(linear, 2, num_points, CEED_NOTRANSPOSE, CEED_EVAL_INTERP, x, u, v));
  expect_all(v, 1, "interpolation of 1 at points");
}

/// v = c u for each value, c from the context.
int multiplied(void *ctx, CeedInt Q, const CeedScalar *const *in, CeedScalar *const *out) {
  for (CeedInt q = 0; q < Q; q++) out[0][q] = *static_cast<const double *>(ctx) * in[0][q];
  return 0;
}

/// With a context of three fields, a double, an integer and a flag.
void make_context(Ceed ceed, Context &context) {
  struct {
    double factor;
    std::int32_t number;
    bool flag;
  } values{2, 3, true};
  must(CeedQFunctionContextCreate(ceed, context.out()));
  must(CeedQFunctionContextSetData(context, CEED_MEM_HOST, CEED_COPY_VALUES, sizeof values, &values));
  must(CeedQFunctionContextRegisterDouble(context, "factor", 0, 1, "what values are multiplied with, in words"));
  must(CeedQFunctionContextRegisterInt32(context, "number", 8, 1, "a number that nobody looks at, in words"));
  must(CeedQFunctionContextRegisterBoolean(context, "flag", 12, 1, "a flag that nobody looks at, in words"));
}

void use_contexts(Ceed ceed) {
  Context context, copy;
  make_context(ceed, context);
  must(CeedQFunctionContextReferenceCopy(context, copy.address()));
  const CeedContextFieldLabel *labels = nullptr;
  CeedInt num_labels = 0;
  must(CeedQFunctionContextGetAllFieldLabels(context, &labels, &num_labels));
  expect(num_labels == 3, "number of labels");
  double factor = 4;
  must(CeedQFunctionContextSetDouble(context, labels[0], &factor));
  const double *read = nullptr;
  std::size_t num_values = 0;
  must(CeedQFunctionContextGetDoubleRead(context, labels[0], &num_values, &read));
  const bool is_right = *read == 4 && num_values == 1;
  must(CeedQFunctionContextRestoreDoubleRead(context, labels[0], &read));
  expect(is_right, "value of a label");
  must(CeedQFunctionContextView(context, nowhere()));
  static double lent = 1;
  double *taken = nullptr;
  must(CeedQFunctionContextSetData(context, CEED_MEM_HOST, CEED_USE_POINTER, sizeof lent, &lent));
  must(CeedQFunctionContextTakeData(context, CEED_MEM_HOST, &taken));
}

void make_qfunction(Ceed ceed, CeedEvalMode mode, Context &context, QFunction &qf) {
  make_context(ceed, context);
  must(CeedQFunctionCreateInterior(ceed, 1, multiplied, "a/folder/with_a_long_name/scenarios.h:multiplied", qf.out()));
  must(CeedQFunctionAddInput(qf, "the input of the function", 1, mode));
  must(CeedQFunctionAddOutput(qf, "the output of the function", 1, mode));
  must(CeedQFunctionSetContext(qf, context));
  must(CeedQFunctionSetUserFlopsEstimate(qf, 1));
}

void use_qfunctions(Ceed ceed) {
  Context context;
  QFunction qf, identity, named;
  make_qfunction(ceed, CEED_EVAL_NONE, context, qf);
  Vector u, v;
  fill(ceed, u, 4, 3);
  must(CeedVectorCreate(ceed, 4, v.out()));
  CeedVector in[] = {u}, out[] = {v};
  must(CeedQFunctionApply(qf, 4, in, out));
  expect_all(v, 6, "a QFunction");
  must(CeedQFunctionView(qf, nowhere()));
  must(CeedQFunctionCreateIdentity(ceed, 1, CEED_EVAL_NONE, CEED_EVAL_NONE, identity.out()));
  must(CeedQFunctionApply(identity, 4, in, out));
  expect_all(v, 3, "the identity");
  must(CeedQFunctionCreateInteriorByName(ceed, "Vector3Poisson2DApply", named.out()));
  CeedInt num_in = 0, num_out = 0;
  must(CeedQFunctionGetFields(named, &num_in, nullptr, &num_out, nullptr));
  expect(num_in == 2 && num_out == 1, "fields of a gallery QFunction");
}

/// A line of two quadratic elements.
struct Mesh {
  explicit Mesh(Ceed ceed) {
    constexpr CeedInt offsets[6] = {0, 1, 2, 2, 3, 4}, coarse_offsets[4] = {0, 1, 1, 2};
    must(CeedElemRestrictionCreate(ceed, 2, 3, 1, 1, 5, CEED_MEM_HOST, CEED_COPY_VALUES, offsets, fine.out()));
    must(CeedElemRestrictionCreate(ceed, 2, 2, 1, 1, 3, CEED_MEM_HOST, CEED_COPY_VALUES, coarse_offsets, coarse.out()));
    must(CeedBasisCreateTensorH1Lagrange(ceed, 1, 1, 3, 3, CEED_GAUSS, basis.out()));
    must(CeedBasisCreateTensorH1Lagrange(ceed, 1, 1, 2, 3, CEED_GAUSS, coarse_basis.out()));
  }
  Restriction fine, coarse;
  Basis basis, coarse_basis;
};

/// v = 2 u at quadrature points, or at points.
struct Doubled {
  Doubled(Ceed ceed, const Mesh &mesh, bool at_points, CeedEvalMode mode = CEED_EVAL_INTERP) {
    make_qfunction(ceed, mode, context, qf);
    must((at_points ? CeedOperatorCreateAtPoints : CeedOperatorCreate)(ceed, qf, CEED_QFUNCTION_NONE,
                                                                       CEED_QFUNCTION_NONE, op.out()));
    must(CeedOperatorSetField(op, "the input of the function", mesh.fine, mesh.basis, CEED_VECTOR_ACTIVE));
    must(CeedOperatorSetField(op, "the output of the function", mesh.fine, mesh.basis, CEED_VECTOR_ACTIVE));
    must(CeedOperatorSetName(op, "an operator with a long name"));
    if (!at_points) return;
    constexpr CeedInt list[] = {3, 6, 8, 0, 2, 4, 1, 3};
    must(CeedElemRestrictionCreateAtPoints(ceed, 2, 5, 1, 5, CEED_MEM_HOST, CEED_COPY_VALUES, list, points_rstr.out()));
    CeedScalar x[5] = {-0.8, -0.4, 0.1, 0.3, 0.9};
    must(CeedVectorCreate(ceed, 5, points.out()));
    must(CeedVectorSetArray(points, CEED_MEM_HOST, CEED_COPY_VALUES, x));
    must(CeedOperatorAtPointsSetPoints(op, points_rstr, points));
  }
  Context context;
  QFunction qf;
  Restriction points_rstr;
  Vector points;
  Operator op;
};

void apply_and_expect(Ceed ceed, CeedOperator op, CeedSize length, CeedScalar sum, const char *what) {
  Vector in, out;
  fill(ceed, in, length, 1);
  must(CeedVectorCreate(ceed, length, out.out()));
  must(CeedOperatorApply(op, in, out, CEED_REQUEST_IMMEDIATE));
  expect(std::abs(sum_of(out) - sum) < 1e-12, what);
}

void use_operator(Ceed ceed) {
  const Mesh mesh(ceed);
  const Doubled doubled(ceed, mesh, false);
  apply_and_expect(ceed, doubled.op, 5, 12, "action of an operator");  // 2 times 3 points of each element
  Vector in, out;
  fill(ceed, in, 5, 1);
  fill(ceed, out, 5, 0);
  must(CeedOperatorApplyAdd(doubled.op, in, out, CEED_REQUEST_IMMEDIATE));
  must(CeedOperatorApplyAddActive(doubled.op, in, out, CEED_REQUEST_IMMEDIATE));
  expect(std::abs(sum_of(out) - 24) < 1e-12, "added action of an operator");
  CeedContextFieldLabel label = nullptr;
  must(CeedOperatorGetContextFieldLabel(doubled.op, "factor", &label));
  double factor = 1;
  must(CeedOperatorSetContextDouble(doubled.op, label, &factor));
  apply_and_expect(ceed, doubled.op, 5, 6, "action with another context");
  CeedSize flops = 0;
  must(CeedOperatorGetFlopsEstimate(doubled.op, &flops));
  CeedOperatorMemory memory{};
  must(CeedOperatorPrepare(doubled.op));
  must(CeedOperatorGetMemory(doubled.op, &memory));
  must(CeedOperatorView(doubled.op, nowhere()));
}

/// All matrices of an operator whose action on 1 sums up to `sum`.
void assemble(Ceed ceed, CeedOperator op, CeedScalar sum) {
  Vector assembled, diagonal, blocks, values;
  Restriction rstr;
  must(CeedOperatorPrepareFor(op, CEED_USE_ASSEMBLE));
  must(CeedOperatorLinearAssembleQFunction(op, assembled.out(), rstr.out(), CEED_REQUEST_IMMEDIATE));
  must(CeedVectorCreate(ceed, 5, diagonal.out()));
  must(CeedOperatorLinearAssembleDiagonal(op, diagonal, CEED_REQUEST_IMMEDIATE));
  Freed<CeedInt> rows, cols, block_rows, block_cols;
  CeedSize num_entries = 0, num_block_entries = 0;
  must(CeedOperatorLinearAssembleSymbolic(op, &num_entries, &rows.array, &cols.array));
  must(CeedVectorCreate(ceed, num_entries, values.out()));
  must(CeedOperatorLinearAssemble(op, values));
  expect(std::abs(sum_of(values) - sum) < 1e-11, "sum of a matrix");
  must(CeedOperatorLinearAssemblePointBlockDiagonalSymbolic(op, &num_block_entries, &block_rows.array,
                                                            &block_cols.array));
  must(CeedVectorCreate(ceed, num_block_entries, blocks.out()));
  must(CeedOperatorLinearAssemblePointBlockDiagonal(op, blocks, CEED_REQUEST_IMMEDIATE));
  expect(std::abs(sum_of(blocks) - sum_of(diagonal)) < 1e-12, "blocks of one component");
}

void assemble_operator(Ceed ceed) {
  const Mesh mesh(ceed);
  const Doubled doubled(ceed, mesh, false);
  must(CeedOperatorSetQFunctionAssemblyReuse(doubled.op, true));
  assemble(ceed, doubled.op, 12);
  must(CeedOperatorSetQFunctionAssemblyDataUpdateNeeded(doubled.op, true));
  assemble(ceed, doubled.op, 12);
  apply_and_expect(ceed, doubled.op, 5, 12, "action after assembly");
}

void use_operator_at_points(Ceed ceed) {
  const Mesh mesh(ceed);
  const Doubled doubled(ceed, mesh, true);
  apply_and_expect(ceed, doubled.op, 5, 10, "action at points");
  must(CeedOperatorAtPointsSetPoints(doubled.op, doubled.points_rstr, doubled.points));
  apply_and_expect(ceed, doubled.op, 5, 10, "action at points that were set again");
  assemble(ceed, doubled.op, 10);
}

void use_composite(Ceed ceed) {
  const Mesh mesh(ceed);
  const Doubled first(ceed, mesh, false), second(ceed, mesh, true);
  Operator sum;
  must(CeedOperatorCreateComposite(ceed, sum.out()));
  must(CeedOperatorCompositeAddSub(sum, first.op));
  must(CeedOperatorCompositeAddSub(sum, second.op));
  apply_and_expect(ceed, sum, 5, 22, "action of a sum");
  CeedContextFieldLabel label = nullptr;
  must(CeedOperatorGetContextFieldLabel(sum, "factor", &label));
  double factor = 1;
  must(CeedOperatorSetContextDouble(sum, label, &factor));
  apply_and_expect(ceed, sum, 5, 11, "action of a sum with another context");
  Vector multiplicity, diagonal;
  must(CeedVectorCreate(ceed, 5, multiplicity.out()));
  must(CeedOperatorCompositeGetMultiplicity(sum, 0, nullptr, multiplicity));
  must(CeedVectorCreate(ceed, 5, diagonal.out()));
  must(CeedOperatorLinearAssembleDiagonal(sum, diagonal, CEED_REQUEST_IMMEDIATE));
  must(CeedOperatorView(sum, nowhere()));
}

void make_multigrid_levels(Ceed ceed) {
  const Mesh mesh(ceed);
  const Doubled fine(ceed, mesh, false);
  Vector multiplicity, u, v;
  fill(ceed, multiplicity, 5, 1);
  Operator coarse, prolong, restricted;
  must(CeedOperatorMultigridLevelCreate(fine.op, multiplicity, mesh.coarse, mesh.coarse_basis, coarse.out(),
                                        prolong.out(), restricted.out()));
  apply_and_expect(ceed, coarse, 3, 12, "action of a coarse operator");
  fill(ceed, u, 3, 1);
  must(CeedVectorCreate(ceed, 5, v.out()));
  must(CeedOperatorApply(prolong, u, v, CEED_REQUEST_IMMEDIATE));
  must(CeedOperatorApply(restricted, v, u, CEED_REQUEST_IMMEDIATE));
}

void invert_elements(Ceed ceed) {
  const Mesh mesh(ceed);
  const Doubled mass(ceed, mesh, false);
  Operator inverse;
  must(CeedOperatorCreateFDMElementInverse(mass.op, inverse.out(), CEED_REQUEST_IMMEDIATE));
  Vector u, v;
  fill(ceed, u, 5, 1);
  must(CeedVectorCreate(ceed, 5, v.out()));
  must(CeedOperatorApply(inverse, u, v, CEED_REQUEST_IMMEDIATE));
}

void add_sources(Ceed ceed) {
  must(CeedAddJitSourceRoot(ceed, "/a/folder/with/a/long/name/for/sources"));
  must(CeedAddJitDefine(ceed, "A_DEFINE_WITH_A_LONG_NAME=1"));
  CeedInt num = 0;
  const char **texts = nullptr;
  must(CeedGetJitSourceRoots(ceed, &num, &texts));
  must(CeedRestoreJitSourceRoots(ceed, &texts));
  must(CeedGetJitDefines(ceed, &num, &texts));
  must(CeedRestoreJitDefines(ceed, &texts));
  CeedScalar a[4] = {2, 1, 1, 3}, b[4] = {2, 0, 0, 2}, x[4], lambda[2];
  must(CeedSimultaneousDiagonalization(ceed, a, b, x, lambda, 2));
  must(CeedMatrixPseudoinverse(ceed, a, 2, 2, x));
  expect(std::abs(2 * x[0] + x[2] - 1) < 1e-12, "a pseudoinverse");
}

constexpr Scenario scenarios[] = {
    {"vectors", use_vectors},
    {"restrictions", use_restrictions},
    {"bases", use_bases},
    {"contexts", use_contexts},
    {"QFunctions", use_qfunctions},
    {"operator", use_operator},
    {"assembly", assemble_operator},
    {"operator at points", use_operator_at_points},
    {"composite operator", use_composite},
    {"multigrid", make_multigrid_levels},
    {"element inverse", invert_elements},
    {"sources and dense helpers", add_sources},
};

}  // namespace

std::span<const Scenario> failure_scenarios() {
  return scenarios;
}

}  // namespace hg::test
