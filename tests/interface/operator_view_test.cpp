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
    ok(CeedQFunctionCreateInteriorByName(ceed, "Identity", qf.out()));
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
  EXPECT_EQ(view(op), "CeedOperator - Identity\n" + fields(""));
  EXPECT_EQ(terse(op), "CeedOperator - Identity\n");
  ok(CeedOperatorSetName(op, "twice"));
  EXPECT_EQ(view(op), "CeedOperator - twice\n" + fields(""));
  for (const char *none : {static_cast<const char *>(nullptr), ""}) {
    ok(CeedOperatorSetName(op, none));
    EXPECT_EQ(terse(op), "CeedOperator - Identity\n");
  }
}

/// Within a composite a part is shown, and found, by the name that it was given, never by that of its QFunction.
TEST_F(OperatorViewTest, CompositeShowsTheNamesItsPartsWereGiven) {
  Operator all;
  ok(CeedOperatorCreateComposite(ceed, all.out()));
  ok(CeedOperatorCompositeAddSub(all, op));
  EXPECT_EQ(view(all), "Composite CeedOperator\n  SubOperator 0:\n" + fields("  "));
  CeedOperator found = nullptr;
  ok(CeedOperatorCompositeGetSubByName(all, "Identity", &found));
  EXPECT_EQ(found, nullptr);

  ok(CeedOperatorSetName(op, "part"));
  ok(CeedOperatorSetName(all, "sum"));
  EXPECT_EQ(view(all), "Composite CeedOperator - sum\n  SubOperator 0 - part:\n" + fields("  "));
  EXPECT_EQ(terse(all), "Composite CeedOperator - sum\n  SubOperator 0 - part\n");
  ok(CeedOperatorCompositeGetSubByName(all, "part", &found));
  EXPECT_EQ(found, op.get());
}

/// A part that is itself composite stands below its title, further in.
TEST_F(OperatorViewTest, CompositeShowsThePartsOfItsParts) {
  Operator all, inner;
  ok(CeedOperatorCreateComposite(ceed, all.out()));
  ok(CeedOperatorCreateComposite(ceed, inner.out()));
  ok(CeedOperatorSetName(inner, "inner"));
  ok(CeedOperatorCompositeAddSub(inner, op));
  ok(CeedOperatorCompositeAddSub(all, op));
  ok(CeedOperatorCompositeAddSub(all, inner));
  const std::string want = "Composite CeedOperator\n  SubOperator 0:\n" + fields("  ") +
                           "  SubOperator 1 - inner:\n    SubOperator 0:\n" + fields("    ");
  EXPECT_EQ(view(all), want);
  ok(CeedOperatorSetNumViewTabs(all, 1));
  EXPECT_EQ(view(all), "  Composite CeedOperator\n    SubOperator 0:\n" + fields("    ") +
                           "    SubOperator 1 - inner:\n      SubOperator 0:\n" + fields("      "));
  EXPECT_EQ(terse(all), "  Composite CeedOperator\n    SubOperator 0\n    SubOperator 1 - inner\n");
}

TEST_F(OperatorViewTest, OperatorsAtPointsSayThatTheyAre) {
  const CeedInt offsets[] = {3, 4, 6, 0, 1, 2};
  Restriction points;
  ok(CeedElemRestrictionCreateAtPoints(ceed, 2, 3, 1, 3, CEED_MEM_HOST, CEED_COPY_VALUES, offsets, points.out()));
  const Vector coordinates = make_vector(ceed, 3, 0.1);
  Operator at_points, all;
  ok(CeedOperatorCreateAtPoints(ceed, qf, CEED_QFUNCTION_NONE, CEED_QFUNCTION_NONE, at_points.out()));
  ok(CeedOperatorSetField(at_points, "u", points, CEED_BASIS_NONE, CEED_VECTOR_ACTIVE));
  ok(CeedOperatorSetField(at_points, "v", points, CEED_BASIS_NONE, CEED_VECTOR_ACTIVE));
  ok(CeedOperatorAtPointsSetPoints(at_points, points, coordinates));
  const auto fields_at_points = [](const std::string &indent) {
    return indent + "  2 elements with 2 max points each\n" + indent + "  2 fields\n" + field("input", "u", indent) +
           field("output", "v", indent);
  };
  EXPECT_EQ(view(at_points), "CeedOperator AtPoints - Identity\n" + fields_at_points(""));
  ok(CeedOperatorSetName(at_points, "moving"));
  EXPECT_EQ(view(at_points), "CeedOperator AtPoints - moving\n" + fields_at_points(""));
  EXPECT_EQ(terse(at_points), "CeedOperator AtPoints - moving\n");
  ok(CeedOperatorCreateComposite(ceed, all.out()));
  ok(CeedOperatorCompositeAddSub(all, at_points));
  EXPECT_EQ(view(all), "Composite CeedOperator\n  SubOperator 0 - moving:\n" + fields_at_points("  "));
}

/// What is not known yet counts as none; "none" has no plural.
TEST_F(OperatorViewTest, ShowsWhatIsNotSet) {
  QFunction source;
  const CeedQFunctionUser nothing = [](void *, const CeedInt, const CeedScalar *const *, CeedScalar *const *) {
    return 0;
  };
  ok(CeedQFunctionCreateInterior(ceed, 1, nothing, "load.h:load", source.out()));
  ok(CeedQFunctionAddOutput(source, "v", 1, CEED_EVAL_NONE));
  Operator unset;
  ok(CeedOperatorCreate(ceed, source, CEED_QFUNCTION_NONE, CEED_QFUNCTION_NONE, unset.out()));
  EXPECT_EQ(view(unset),
            "CeedOperator - load\n  0 elements with 0 quadrature points each\n  1 field\n  0 input field:\n"
            "  1 output field:\n    Output field 0:\n      Name: \"v\"\n      Size: 1\n      EvalMode: none\n"
            "      Not set\n");
  EXPECT_EQ(printed([&](FILE *stream) { ok(CeedQFunctionView(source, stream)); }),
            "User CeedQFunction - load\n  0 input field:\n  1 output field:\n    Output field 0:\n"
            "      Name: \"v\"\n      Size: 1\n      EvalMode: \"none\"\n");
}

}  // namespace
