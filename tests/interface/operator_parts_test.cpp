// Which composites a backend gets as a whole, and which part by part.
#include <ceed/plugin.h>
#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "support/errors.hpp"
#include "support/handles.hpp"
#include "support/values.hpp"

namespace {

using namespace hg::test;

CeedBackendOps parent;
std::vector<CeedInt> num_joined;  ///< parts of each composite that came as a whole
int num_destroyed = 0;            ///< composites among the operators that were destroyed

int apply_add_parts(CeedOperator composite, CeedInt num_parts, const CeedOperator *parts,
                    const CeedProgram *const *programs, const CeedVector *in, const CeedVector *out) {
  num_joined.push_back(num_parts);
  CeedCallBackend(CeedOperatorSetData(composite, &parent));
  for (CeedInt i = num_parts - 1; i >= 0; i--) {  // in any order
    CeedCallBackend(parent.op.apply_add(parts[i], programs[i], in[i], out[i], CEED_APPLY_ADD_ALL));
  }
  return CEED_ERROR_SUCCESS;
}

int get_memory(CeedOperator op, CeedSize *bytes) {
  void *data = nullptr;
  CeedCallBackend(CeedOperatorGetData(op, &data));
  *bytes = data == &parent ? 1000 : 0;
  return CEED_ERROR_SUCCESS;
}

int destroy(CeedOperator op) {
  void *data = nullptr;
  CeedCallBackend(CeedOperatorGetData(op, &data));
  if (data == &parent) num_destroyed++;
  return CEED_ERROR_SUCCESS;
}

int init(Ceed, const char *, CeedBackendOps *ops) {
  if (parent.size == 0) parent = *ops;
  ops->op.apply_add_parts = apply_add_parts;
  ops->op.destroy = destroy;
  ops->op.get_memory = get_memory;
  return CEED_ERROR_SUCCESS;
}

const CeedBackend backend{.resource = "/test/parts",
                          .parent = "/cpu/self/ref/serial",
                          .priority = CEED_MAX_BACKEND_PRIORITY,
                          .aliases = nullptr,
                          .score = nullptr,
                          .init = init};
const CeedPlugin plugin{.size = sizeof(CeedPlugin),
                        .api_version = CEED_PLUGIN_API_VERSION,
                        .name = "parts",
                        .num_backends = 1,
                        .backends = &backend};

/// Operators that copy a vector, and their sums.
class PartsTest : public testing::Test {
 protected:
  static void SetUpTestSuite() { ok(CeedPluginRegister(&plugin)); }
  void SetUp() override {
    num_joined.clear();
    num_destroyed = 0;
    ok(CeedElemRestrictionCreateStrided(ceed, 1, n, 1, n, strides.data(), rstr.out()));
    ok(CeedOperatorCreateComposite(ceed, sum.out()));
  }
  /// v += u; a vector of its own, or CEED_VECTOR_ACTIVE.
  void add_copy(CeedOperator to, CeedVector u, CeedVector v, Ceed of = nullptr) {
    QFunction qf;
    Operator op;
    if (of == nullptr) of = ceed;
    ok(CeedQFunctionCreateIdentity(of, 1, CEED_EVAL_NONE, CEED_EVAL_NONE, qf.out()));
    ok(CeedOperatorCreate(of, qf, CEED_QFUNCTION_NONE, CEED_QFUNCTION_NONE, op.out()));
    ok(CeedOperatorSetField(op, "input", rstr, CEED_BASIS_NONE, u));
    ok(CeedOperatorSetField(op, "output", rstr, CEED_BASIS_NONE, v));
    ok(CeedOperatorCompositeAddSub(to, op));
  }
  /// What the sum gives for ones, everywhere the same.
  CeedScalar apply() {
    const Vector u = make_vector(ceed, n, 1), v = make_vector(ceed, n, -1);
    ok(CeedOperatorApply(sum, u, v, CEED_REQUEST_IMMEDIATE));
    const Values values = values_of(v);
    for (const CeedScalar value : values) EXPECT_EQ(value, values[0]);
    return values[0];
  }

  static constexpr CeedInt n = 3;
  const std::array<CeedInt, 3> strides{1, n, n};
  const CeedHandle ceed{open("/test/parts")};
  Restriction rstr;
  Operator sum;
};

TEST_F(PartsTest, ComeTogether) {
  for (int i = 0; i < 3; i++) add_copy(sum, CEED_VECTOR_ACTIVE, CEED_VECTOR_ACTIVE);
  EXPECT_EQ(apply(), 3);
  EXPECT_EQ(apply(), 3);
  EXPECT_EQ(num_joined, (std::vector<CeedInt>{3, 3}));
  CeedOperatorMemory memory{};
  ok(CeedOperatorGetMemory(sum, &memory));
  EXPECT_EQ(memory.backend, 1000);
  sum = Operator();
  EXPECT_EQ(num_destroyed, 1);
}

TEST_F(PartsTest, OfCompositesComeTogetherToo) {
  Operator inner;
  ok(CeedOperatorCreateComposite(ceed, inner.out()));
  for (int i = 0; i < 2; i++) add_copy(inner, CEED_VECTOR_ACTIVE, CEED_VECTOR_ACTIVE);
  ok(CeedOperatorCompositeAddSub(sum, inner));
  add_copy(sum, CEED_VECTOR_ACTIVE, CEED_VECTOR_ACTIVE);
  EXPECT_EQ(apply(), 3);
  EXPECT_EQ(num_joined, std::vector<CeedInt>{3});
  ok(CeedOperatorCompositeSetSequential(inner, true));
  EXPECT_EQ(apply(), 3);
  EXPECT_EQ(num_joined, std::vector<CeedInt>{3});
}

TEST_F(PartsTest, ComeOneAfterAnotherWhereThatIsSaid) {
  for (int i = 0; i < 2; i++) add_copy(sum, CEED_VECTOR_ACTIVE, CEED_VECTOR_ACTIVE);
  ok(CeedOperatorCompositeSetSequential(sum, true));
  EXPECT_EQ(apply(), 2);
  EXPECT_TRUE(num_joined.empty());
  sum = Operator();
  EXPECT_EQ(num_destroyed, 0);
}

TEST_F(PartsTest, ComeAloneWhereThereIsOne) {
  add_copy(sum, CEED_VECTOR_ACTIVE, CEED_VECTOR_ACTIVE);
  EXPECT_EQ(apply(), 1);
  EXPECT_TRUE(num_joined.empty());
}

/// The second part reads what the first one has written.
TEST_F(PartsTest, ThatDependOnEachOtherComeOneAfterAnother) {
  const Vector between = make_vector(ceed, n, 5);
  add_copy(sum, CEED_VECTOR_ACTIVE, between);
  add_copy(sum, between, CEED_VECTOR_ACTIVE);
  EXPECT_EQ(apply(), 1);
  EXPECT_TRUE(num_joined.empty());
}

TEST_F(PartsTest, ThatWriteOneVectorComeTogether) {
  const Vector passive = make_vector(ceed, n, 5);
  add_copy(sum, CEED_VECTOR_ACTIVE, passive);
  add_copy(sum, CEED_VECTOR_ACTIVE, passive);
  add_copy(sum, CEED_VECTOR_ACTIVE, CEED_VECTOR_ACTIVE);
  EXPECT_EQ(apply(), 1);
  EXPECT_EQ(num_joined, std::vector<CeedInt>{3});
  EXPECT_EQ(values_of(passive), Values(n, 2));
}

TEST_F(PartsTest, OfAnotherCeedComeOneAfterAnother) {
  const CeedHandle other{open("/test/parts")};
  add_copy(sum, CEED_VECTOR_ACTIVE, CEED_VECTOR_ACTIVE);
  add_copy(sum, CEED_VECTOR_ACTIVE, CEED_VECTOR_ACTIVE, other);
  EXPECT_EQ(apply(), 2);
  EXPECT_TRUE(num_joined.empty());
}

}  // namespace
