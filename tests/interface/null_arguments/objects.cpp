#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>

#include "cases.hpp"

namespace hg::test {

namespace {

void made(int code) {
  if (code != CEED_ERROR_SUCCESS)
    throw std::runtime_error("An object of the test was not made: code " + std::to_string(code));
}

CeedVector vector_of(Ceed ceed, CeedSize length) {
  CeedVector vector = nullptr;
  made(CeedVectorCreate(ceed, length, &vector));
  made(CeedVectorSetValue(vector, 0.5));
  return vector;
}

CeedQFunction copying(Ceed ceed) {
  CeedQFunction qf = nullptr;
  made(CeedQFunctionCreateInterior(ceed, 1, copy_values, copy_values_source, &qf));
  made(CeedQFunctionAddInput(qf, "u", 1, CEED_EVAL_INTERP));
  made(CeedQFunctionAddOutput(qf, "v", 1, CEED_EVAL_INTERP));
  made(CeedQFunctionSetUserFlopsEstimate(qf, 0));
  return qf;
}

void set_fields(CeedOperator op, const Objects &o) {
  made(CeedOperatorSetField(op, "u", o.rstr, o.basis, CEED_VECTOR_ACTIVE));
  made(CeedOperatorSetField(op, "v", o.rstr, o.basis, CEED_VECTOR_ACTIVE));
}

}  // namespace

int copy_values(void *, const CeedInt Q, const CeedScalar *const *in, CeedScalar *const *out) {
  std::copy_n(in[0], Q, out[0]);
  return 0;
}
int init_nothing(Ceed, const char *, CeedQFunction) {
  return 0;
}
int destroy_nothing(void *) {
  return 0;
}

Objects::Objects() {
  ::setenv("CEED_ERROR_HANDLER", "store", 1);
  made(CeedInit("/cpu/self/ref/serial", &ceed));
  stream = std::fopen("/dev/null", "w");
  x = vector_of(ceed, 5);
  y = vector_of(ceed, 5);
  w = vector_of(ceed, 5);
  e = vector_of(ceed, 6);
  q = vector_of(ceed, 6);
  p = vector_of(ceed, 3);
  at_p = vector_of(ceed, 3);
  entries = vector_of(ceed, 18);
  inputs[0] = e;
  outputs[0] = q;

  for (int i = 0; i < 6; i++) curl_orients[3 * i + 1] = 1;
  for (int i = 0; i < 64; i++) {
    matrix[i] = other_matrix[i] = i % 4 == 0 ? 2 : 0;  // 3 by 3: the identity, twice
    third_matrix[i] = tau[i] = 1;
  }
  const CeedMemType host = CEED_MEM_HOST;
  const CeedCopyMode copy = CEED_COPY_VALUES;
  made(CeedElemRestrictionCreate(ceed, 2, 3, 1, 1, 5, host, copy, offsets, &rstr));
  made(CeedElemRestrictionCreate(ceed, 2, 2, 1, 1, 3, host, copy, coarse_offsets, &coarse_rstr));
  made(CeedElemRestrictionCreateStrided(ceed, 2, 3, 1, 6, strides, &strided));
  made(CeedElemRestrictionCreateOriented(ceed, 2, 3, 1, 1, 5, host, copy, offsets, orients, &oriented));
  made(CeedElemRestrictionCreateCurlOriented(ceed, 2, 3, 1, 1, 5, host, copy, offsets, curl_orients, &curl_oriented));
  made(CeedElemRestrictionCreateAtPoints(ceed, 2, 3, 1, 3, host, copy, points_offsets, &points));

  made(CeedBasisCreateTensorH1Lagrange(ceed, 1, 1, 3, 3, CEED_GAUSS, &basis));
  made(CeedBasisCreateTensorH1Lagrange(ceed, 1, 1, 2, 3, CEED_GAUSS, &coarse_basis));
  const CeedElemTopology quad = CEED_TOPOLOGY_QUAD;
  made(CeedBasisCreateHdiv(ceed, quad, 1, 3, 2, matrix, matrix, matrix, matrix, &hdiv));
  made(CeedBasisCreateHcurl(ceed, quad, 1, 3, 2, matrix, matrix, matrix, matrix, &hcurl));

  made(CeedQFunctionContextCreate(ceed, &ctx));
  made(CeedQFunctionContextSetData(ctx, host, copy, sizeof data, &data));
  made(CeedQFunctionContextRegisterDouble(ctx, "a", offsetof(ContextData, a), 1, "a number"));
  made(CeedQFunctionContextRegisterInt32(ctx, "n", offsetof(ContextData, n), 1, "an integer"));
  made(CeedQFunctionContextRegisterBoolean(ctx, "b", offsetof(ContextData, b), 1, "a choice"));
  made(CeedQFunctionContextGetFieldLabel(ctx, "a", &label_a));
  made(CeedQFunctionContextGetFieldLabel(ctx, "n", &label_n));
  made(CeedQFunctionContextGetFieldLabel(ctx, "b", &label_b));
  qf = copying(ceed);
  new_qf = copying(ceed);
  made(CeedQFunctionSetContext(qf, ctx));

  const CeedQFunction none = CEED_QFUNCTION_NONE;
  made(CeedOperatorCreate(ceed, qf, none, none, &op));
  made(CeedOperatorCreate(ceed, qf, none, none, &new_op));
  made(CeedOperatorCreateAtPoints(ceed, qf, none, none, &points_op));
  set_fields(op, *this);
  set_fields(points_op, *this);
  made(CeedOperatorAtPointsSetPoints(points_op, points, p));
  made(CeedOperatorSetName(op, "part"));
  made(CeedOperatorCreateComposite(ceed, &composite));
  made(CeedOperatorCompositeAddSub(composite, op));
  made(CeedQFunctionGetFields(qf, nullptr, &qf_inputs, nullptr, nullptr));
  qf_field = qf_inputs[0];
  made(CeedOperatorGetFieldByName(op, "u", &op_field));
}

Objects::~Objects() {
  // What was not lent is not given back: that these fail is no matter.
  CeedVectorRestoreArray(x, nullptr);
  CeedVectorRestoreArrayRead(x, nullptr);
  CeedElemRestrictionRestoreOffsets(rstr, &read_offsets);
  CeedElemRestrictionRestoreOrientations(oriented, &read_orients);
  CeedElemRestrictionRestoreCurlOrientations(curl_oriented, &read_curl_orients);
  CeedQFunctionContextRestoreData(ctx, nullptr);
  CeedQFunctionContextRestoreDataRead(ctx, nullptr);
  if (work_vector != nullptr) CeedRestoreWorkVector(ceed, &work_vector);

  for (CeedOperator *object : {&op, &new_op, &points_op, &composite, &made_op, &second_op, &third_op}) {
    CeedOperatorDestroy(object);
  }
  for (CeedQFunction *object : {&qf, &new_qf, &made_qf}) CeedQFunctionDestroy(object);
  for (CeedQFunctionContext *object : {&ctx, &made_ctx}) CeedQFunctionContextDestroy(object);
  for (CeedBasis *object : {&basis, &coarse_basis, &hdiv, &hcurl, &made_basis, &second_basis}) CeedBasisDestroy(object);
  for (CeedElemRestriction *object :
       {&rstr, &coarse_rstr, &strided, &oriented, &curl_oriented, &points, &made_rstr, &second_rstr}) {
    CeedElemRestrictionDestroy(object);
  }
  for (CeedVector *object : {&x, &y, &w, &e, &q, &p, &at_p, &entries, &made_vector, &second_vector}) {
    CeedVectorDestroy(object);
  }
  CeedDestroy(&made_ceed);
  CeedDestroy(&ceed);
  std::free(const_cast<char *>(absolute_path));
  std::free(own_text);
  std::free(static_cast<void *>(names));
  std::free(static_cast<void *>(strings));
  std::free(rows);
  std::free(cols);
  std::free(plugins);
  if (stream != nullptr) std::fclose(stream);
}

std::string Objects::messages() const {
  std::string all;
  for (Ceed of : {ceed, Ceed{}}) {
    const char *message = nullptr;
    if (CeedGetErrorMessage(of, &message) == CEED_ERROR_SUCCESS) all += std::string(message) + "\n";
  }
  return all;
}

void Objects::forget_messages() const {
  for (Ceed of : {ceed, Ceed{}}) {
    const char *message = nullptr;
    CeedResetErrorMessage(of, &message);
  }
}

void expect_refused(const std::string &function, const Objects &objects, int code) {
  EXPECT_NE(code, CEED_ERROR_SUCCESS);
  const std::string messages = objects.messages();
  for (const std::string &fragment : {"in " + function + "(): ", std::string("NULL"), std::string("expected")}) {
    EXPECT_NE(messages.find(fragment), std::string::npos) << "no '" << fragment << "' in: " << messages;
  }
}

void expect_accepted(const Objects &objects, int code) {
  EXPECT_EQ(code, CEED_ERROR_SUCCESS) << objects.messages();
}

}  // namespace hg::test
