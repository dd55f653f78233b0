// What the objects of every backend tell of themselves, and that their references count.
#include <array>
#include <cstring>

#include "backends.hpp"
#include "interface/view_text.hpp"
#include "oracle/affine_operator.hpp"

namespace {

using namespace hg::test;

class HandlesTest : public BackendTest {
 protected:
  const Box mesh{1, 3, 3};
  static constexpr AffineContext start{2, 0, 0, false};
};

TEST_P(HandlesTest, ACeedSaysWhatItIs) {
  const auto view = [&] { return printed([&](FILE *stream) { ok(CeedView(ceed, stream)); }); };
  const char *resource = nullptr;
  CeedMemType type = CEED_MEM_HOST;
  ok(CeedGetResource(ceed, &resource));
  ok(CeedGetPreferredMemType(ceed, &type));
  const std::string lines[] = {"Ceed", "  Ceed Resource: " + std::string(resource),
                               "  Preferred MemType: " + std::string(CeedMemTypes[type])};
  EXPECT_EQ(view(), lines[0] + "\n" + lines[1] + "\n" + lines[2] + "\n");
  CeedInt tabs = -1;
  ok(CeedGetNumViewTabs(ceed, &tabs));
  EXPECT_EQ(tabs, 0);
  ok(CeedSetNumViewTabs(ceed, 2));
  ok(CeedGetNumViewTabs(ceed, &tabs));
  EXPECT_EQ(tabs, 2);
  EXPECT_EQ(view(), "    " + lines[0] + "\n    " + lines[1] + "\n    " + lines[2] + "\n");
  EXPECT_NE(CeedSetNumViewTabs(ceed, -1), 0);
}

/// A backend that says so gives the same bits each time; others may, too.
TEST_P(HandlesTest, ADeterministicBackendRepeatsItself) {
  bool is_deterministic = false;
  ok(CeedIsDeterministic(ceed, &is_deterministic));
  if (is_reference()) {
    EXPECT_TRUE(is_deterministic);
  }
  if (!is_deterministic) GTEST_SKIP() << GetParam() << " does not say that it is deterministic";
  const Box large(2, 7, 3);
  const AffineOperator op(ceed, large, 4, 1, start);
  const Values u = Random(21).reals(large.num_nodes), once = apply_to(ceed, op.op, u);
  for (int i = 0; i < 3; i++) {
    const Values again = apply_to(ceed, op.op, u);
    EXPECT_EQ(std::memcmp(once.data(), again.data(), once.size() * sizeof(CeedScalar)), 0);
  }
}

/// The default stream: a backend works on it, or says that it has none; it goes on working in both cases.
TEST_P(HandlesTest, TakesTheDefaultStreamOrSaysThatItHasNone) {
  const AffineOperator op(ceed, mesh, 4, 1, start);
  const Values u = Random(22).reals(mesh.num_nodes), before = apply_to(ceed, op.op, u);
  const int code = CeedSetStream(ceed, nullptr);
  if (code != CEED_ERROR_SUCCESS) expect_error(code, CEED_ERROR_UNSUPPORTED, {"CeedSetStream", GetParam()});
  if (GetParam().rfind("/cpu", 0) == 0) {
    EXPECT_NE(code, CEED_ERROR_SUCCESS);
  }
  expect_close(apply_to(ceed, op.op, u), before, tolerance(mesh.num_nodes), "after CeedSetStream()");
}

TEST_P(HandlesTest, RemembersTheCompilerAskedFor) {
  bool is_clang = true;
  ok(CeedGetIsClang(ceed, &is_clang));
  for (const bool wanted : {!is_clang, is_clang}) {
    bool got = !wanted;
    ok(CeedSetIsClang(ceed, wanted));
    ok(CeedGetIsClang(ceed, &got));
    EXPECT_EQ(got, wanted);
  }
}

/// The gallery is there after the call, and after another one.
TEST_P(HandlesTest, RegistersTheGallery) {
  for (int i = 0; i < 2; i++) {
    ok(CeedQFunctionRegisterAll());
    for (const char *name :
         {"Identity", "Scale", "Mass1DBuild", "Mass2DBuild", "Mass3DBuild", "MassApply", "Vector3MassApply",
          "Poisson1DBuild", "Poisson2DBuild", "Poisson3DBuild", "Poisson1DApply", "Poisson2DApply", "Poisson3DApply",
          "Vector3Poisson1DApply", "Vector3Poisson2DApply", "Vector3Poisson3DApply"}) {
      SCOPED_TRACE(name);
      QFunction qf;
      ok(CeedQFunctionCreateInteriorByName(ceed, name, qf.out()));
      const char *kept = nullptr;
      ok(CeedQFunctionGetName(qf, &kept));
      EXPECT_STREQ(kept, name);
    }
  }
}

/// A copy of a handle is another reference: the object outlives the first one, and what the copy held before goes.
TEST_P(HandlesTest, CopiesKeepTheirObjects) {
  AffineOperator op(ceed, mesh, 4, 1, start);
  const Values u = Random(23).reals(mesh.num_nodes), before = apply_to(ceed, op.op, u);
  const AffineOperator other(ceed, mesh, 2, 1, start);
  Operator op_copy;
  Restriction rstr_copy;
  Basis basis_copy;
  QFunction qf_copy;
  Context context_copy;
  CeedHandle ceed_copy;
  for (const AffineOperator *source : {&other, static_cast<const AffineOperator *>(&op)}) {
    ok(CeedOperatorReferenceCopy(source->op, op_copy.address()));
    ok(CeedElemRestrictionReferenceCopy(source->rstr, rstr_copy.address()));
    ok(CeedBasisReferenceCopy(source->basis, basis_copy.address()));
    ok(CeedQFunctionReferenceCopy(source->qf, qf_copy.address()));
    ok(CeedQFunctionContextReferenceCopy(source->context, context_copy.address()));
    ok(CeedReferenceCopy(ceed, ceed_copy.address()));
  }
  EXPECT_EQ(op_copy.get(), op.op.get());
  EXPECT_EQ(rstr_copy.get(), op.rstr.get());
  EXPECT_EQ(basis_copy.get(), op.basis.get());
  EXPECT_EQ(qf_copy.get(), op.qf.get());
  EXPECT_EQ(context_copy.get(), op.context.get());
  EXPECT_EQ(ceed_copy.get(), ceed.get());
  CeedOperator none = nullptr;
  EXPECT_NE(CeedOperatorReferenceCopy(nullptr, &none), 0);

  // Each is destroyed but for its copy, and is used then.
  CeedElemRestrictionDestroy(op.rstr.address());
  CeedBasisDestroy(op.basis.address());
  CeedQFunctionContextDestroy(op.context.address());
  CeedQFunctionDestroy(op.qf.address());
  CeedOperatorDestroy(op.op.address());
  EXPECT_EQ(op.op.get(), nullptr);
  expect_close(apply_to(ceed, op_copy, u), before, tolerance(mesh.num_nodes), "by the copy");
  CeedInt num_elem = 0, num_nodes = 0, num_inputs = 0;
  std::size_t size = 0;
  op_copy.reset();
  ok(CeedElemRestrictionGetNumElements(rstr_copy, &num_elem));
  EXPECT_EQ(num_elem, mesh.num_elem);
  ok(CeedBasisGetNumNodes(basis_copy, &num_nodes));
  EXPECT_EQ(num_nodes, 3);
  ok(CeedQFunctionGetFields(qf_copy, &num_inputs, nullptr, nullptr, nullptr));
  EXPECT_EQ(num_inputs, 2);
  ok(CeedQFunctionContextGetContextSize(context_copy, &size));
  EXPECT_EQ(size, sizeof(AffineContext));
}

/// Functions that all kinds of objects have, for one of them.
template <typename T>
struct Common {
  T object;
  int (*get_ceed)(T, Ceed *);
  Ceed (*return_ceed)(T);
  int (*set_tabs)(T, CeedInt);
  int (*get_tabs)(T, CeedInt *);
  int (*view)(T, FILE *);
};

template <typename T>
void check_common(Ceed ceed, const Common<T> &common) {
  CeedHandle owner;
  ok(common.get_ceed(common.object, owner.out()));
  EXPECT_EQ(owner.get(), ceed);
  EXPECT_EQ(common.return_ceed(common.object), ceed);
  const auto view = [&] { return printed([&](FILE *stream) { ok(common.view(common.object, stream)); }); };
  CeedInt tabs = -1;
  ok(common.get_tabs(common.object, &tabs));
  EXPECT_EQ(tabs, 0);
  const std::string plain = view();
  ASSERT_FALSE(plain.empty());
  ASSERT_EQ(plain.back(), '\n');
  ok(common.set_tabs(common.object, 3));
  ok(common.get_tabs(common.object, &tabs));
  EXPECT_EQ(tabs, 3);
  // Every line moves in by two spaces a step.
  std::string moved = "      " + plain;
  for (std::size_t end = moved.find('\n'); end + 1 < moved.size(); end = moved.find('\n', end + 1)) {
    moved.insert(end + 1, "      ");
  }
  EXPECT_EQ(view(), moved);
  EXPECT_NE(common.set_tabs(common.object, -1), 0);
  ok(common.set_tabs(common.object, 0));
  EXPECT_EQ(view(), plain);
}

int view_vector(CeedVector vec, FILE *stream) {
  return CeedVectorView(vec, "%12.8f", stream);
}

TEST_P(HandlesTest, ObjectsKnowTheirCeedAndMoveInWhenViewed) {
  const AffineOperator op(ceed, mesh, 4, 1, start);
  const Vector vec = make_vector(ceed, 3, 1.0);
  check_common<CeedVector>(ceed, {vec, CeedVectorGetCeed, CeedVectorReturnCeed, CeedVectorSetNumViewTabs,
                                  CeedVectorGetNumViewTabs, view_vector});
  check_common<CeedElemRestriction>(
      ceed, {op.rstr, CeedElemRestrictionGetCeed, CeedElemRestrictionReturnCeed, CeedElemRestrictionSetNumViewTabs,
             CeedElemRestrictionGetNumViewTabs, CeedElemRestrictionView});
  check_common<CeedBasis>(ceed, {op.basis, CeedBasisGetCeed, CeedBasisReturnCeed, CeedBasisSetNumViewTabs,
                                 CeedBasisGetNumViewTabs, CeedBasisView});
  check_common<CeedQFunction>(ceed, {op.qf, CeedQFunctionGetCeed, CeedQFunctionReturnCeed, CeedQFunctionSetNumViewTabs,
                                     CeedQFunctionGetNumViewTabs, CeedQFunctionView});
  check_common<CeedQFunctionContext>(
      ceed, {op.context, CeedQFunctionContextGetCeed, CeedQFunctionContextReturnCeed,
             CeedQFunctionContextSetNumViewTabs, CeedQFunctionContextGetNumViewTabs, CeedQFunctionContextView});
  check_common<CeedOperator>(ceed, {op.op, CeedOperatorGetCeed, CeedOperatorReturnCeed, CeedOperatorSetNumViewTabs,
                                    CeedOperatorGetNumViewTabs, CeedOperatorView});
}

/// Fields give what they were made of; the handles are counted.
TEST_P(HandlesTest, FieldsGiveWhatTheyWereMadeOf) {
  const AffineOperator op(ceed, mesh, 4, 1, start);
  CeedInt num_inputs = 0, num_outputs = 0;
  CeedQFunctionField *qf_inputs = nullptr, *qf_outputs = nullptr;
  CeedOperatorField *inputs = nullptr, *outputs = nullptr;
  ok(CeedQFunctionGetFields(op.qf, &num_inputs, &qf_inputs, &num_outputs, &qf_outputs));
  ASSERT_EQ(num_inputs, 2);
  ASSERT_EQ(num_outputs, 1);
  ok(CeedOperatorGetFields(op.op, &num_inputs, &inputs, &num_outputs, &outputs));
  ASSERT_EQ(num_inputs, 2);
  ASSERT_EQ(num_outputs, 1);
  struct Expected {
    CeedQFunctionField qf_field;
    CeedOperatorField field;
    const char *name;
    CeedEvalMode mode;
  };
  for (const Expected &expected : {Expected{qf_inputs[0], inputs[0], "u", CEED_EVAL_INTERP},
                                   Expected{qf_inputs[1], inputs[1], "w", CEED_EVAL_WEIGHT},
                                   Expected{qf_outputs[0], outputs[0], "v", CEED_EVAL_INTERP}}) {
    SCOPED_TRACE(expected.name);
    const bool is_weight = expected.mode == CEED_EVAL_WEIGHT;
    const char *name = nullptr;
    CeedInt size = 0;
    CeedEvalMode mode = CEED_EVAL_NONE;
    ok(CeedQFunctionFieldGetName(expected.qf_field, &name));
    EXPECT_STREQ(name, expected.name);
    ok(CeedQFunctionFieldGetSize(expected.qf_field, &size));
    EXPECT_EQ(size, 1);
    ok(CeedQFunctionFieldGetEvalMode(expected.qf_field, &mode));
    EXPECT_EQ(mode, expected.mode);
    ok(CeedOperatorFieldGetName(expected.field, &name));
    EXPECT_STREQ(name, expected.name);
    CeedElemRestriction rstr = nullptr;
    CeedBasis basis = nullptr;
    CeedVector vec = nullptr;
    ok(CeedOperatorFieldGetElemRestriction(expected.field, &rstr));
    ok(CeedOperatorFieldGetBasis(expected.field, &basis));
    ok(CeedOperatorFieldGetVector(expected.field, &vec));
    EXPECT_EQ(rstr, is_weight ? CEED_ELEMRESTRICTION_NONE : op.rstr.get());
    EXPECT_EQ(basis, op.basis.get());
    EXPECT_EQ(vec, is_weight ? CEED_VECTOR_NONE : CEED_VECTOR_ACTIVE);
    ok(CeedElemRestrictionDestroy(&rstr));
    ok(CeedBasisDestroy(&basis));
    ok(CeedVectorDestroy(&vec));
  }
  // What was destroyed were the copies.
  EXPECT_NEAR(dot(Values(mesh.num_nodes, 1), apply_to(ceed, op.op, Values(mesh.num_nodes, 1))), 4.0 * mesh.num_elem,
              100 * tolerance(mesh.num_nodes));
}

INSTANTIATE_TEST_SUITE_P(Backends, HandlesTest, testing::ValuesIn(usable_backends()), backend_name);

}  // namespace
