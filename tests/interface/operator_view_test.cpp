// What operators print of themselves, and the names they go by. The text is the contract: scripts read it.
#include <ceed/backend.h>
#include <gtest/gtest.h>

#include <string>

#include "support/errors.hpp"
#include "support/handles.hpp"
#include "support/values.hpp"
#include "view_text.hpp"

namespace {

using namespace hg::test;

class OperatorViewTest : public testing::Test {
 protected:
  void SetUp() override {
    const CeedInt strides[] = {1, 4, 4};
    ok(CeedElemRestrictionCreateStrided(ceed, 2, 4, 1, 8, strides, rstr.out()));
    ok(CeedQFunctionCreateInteriorByName(ceed, "Scale", qf.out()));
    ok(CeedQFunctionAddInput(qf, "u", 1, CEED_EVAL_NONE));
    ok(CeedQFunctionAddOutput(qf, "v", 1, CEED_EVAL_NONE));
    ok(CeedOperatorCreate(ceed, qf, CEED_QFUNCTION_NONE, CEED_QFUNCTION_NONE, op.out()));
    ok(CeedOperatorSetField(op, "u", rstr, CEED_BASIS_NONE, CEED_VECTOR_ACTIVE));
    ok(CeedOperatorSetField(op, "v", rstr, CEED_BASIS_NONE, CEED_VECTOR_ACTIVE));
  }

  static std::string view(CeedOperator shown) {
    return printed([&](FILE *stream) { ok(CeedOperatorView(shown, stream)); });
  }
  static std::string terse(CeedOperator shown) {
    return printed([&](FILE *stream) { ok(CeedOperatorViewTerse(shown, stream)); });
  }
  static std::string field(const char *kind, const char *name, const std::string &indent) {
    return indent + "  1 " + kind + " field:\n" + indent + "    " + (*kind == 'i' ? "Input" : "Output") +
           " field 0:\n" + indent + "      Name: \"" + name + "\"\n" + indent + "      Size: 1\n" + indent +
           "      EvalMode: none\n" + indent + "      No basis\n" + indent + "      Active vector\n";
  }
  static std::string fields(const std::string &indent) {
    return indent + "  2 elements with 4 quadrature points each\n" + indent + "  2 fields\n" +
           field("input", "u", indent) + field("output", "v", indent);
  }

  const CeedHandle ceed{open(reference_resource)};
  Restriction rstr;
  QFunction qf;
  Operator op;
};

TEST_F(OperatorViewTest, GoesByTheNameOfItsQFunctionUntilItHasOne) {
  EXPECT_EQ(view(op), "CeedOperator - Scale\n" + fields(""));
  EXPECT_EQ(terse(op), "CeedOperator - Scale\n");
  ok(CeedOperatorSetName(op, "twice"));
  EXPECT_EQ(view(op), "CeedOperator - twice\n" + fields(""));
  for (const char *none : {static_cast<const char *>(nullptr), ""}) {
    ok(CeedOperatorSetName(op, none));
    EXPECT_EQ(terse(op), "CeedOperator - Scale\n");
  }
}

/// Within a composite a part is shown, and found, by the name that it was given, never by that of its QFunction.
TEST_F(OperatorViewTest, CompositeShowsTheNamesItsPartsWereGiven) {
  Operator all;
  ok(CeedOperatorCreateComposite(ceed, all.out()));
  ok(CeedOperatorCompositeAddSub(all, op));
  EXPECT_EQ(view(all), "Composite CeedOperator\n  SubOperator 0:\n" + fields("  "));
  CeedOperator found = nullptr;
  ok(CeedOperatorCompositeGetSubByName(all, "Scale", &found));
  EXPECT_EQ(found, nullptr);

  ok(CeedOperatorSetName(op, "part"));
  ok(CeedOperatorSetName(all, "sum"));
  EXPECT_EQ(view(all), "Composite CeedOperator - sum\n  SubOperator 0 - part:\n" + fields("  "));
  EXPECT_EQ(terse(all), "Composite CeedOperator - sum\n  SubOperator 0 - part\n");
  ok(CeedOperatorCompositeGetSubByName(all, "part", &found));
  EXPECT_EQ(found, op.get());
}

}  // namespace
