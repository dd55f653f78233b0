// Programs that use the former names of functions still compile, and do what the present names do.
#include <ceed.h>
#include <gtest/gtest.h>

#include "support/errors.hpp"
#include "support/handles.hpp"
#include "support/values.hpp"

#pragma GCC diagnostic ignored "-Wdeprecated-declarations"

namespace {

using namespace hg::test;

TEST(FormerNamesTest, OfCompositeOperators) {
  const CeedHandle ceed{open(reference_resource)};
  const CeedInt offsets[] = {0, 1, 1, 2};  // two elements of two nodes that share one
  Restriction rstr;
  ok(CeedElemRestrictionCreate(ceed, 2, 2, 1, 1, 3, CEED_MEM_HOST, CEED_COPY_VALUES, offsets, rstr.out()));
  QFunction qf;
  ok(CeedQFunctionCreateIdentity(ceed, 1, CEED_EVAL_NONE, CEED_EVAL_NONE, qf.out()));
  Operator parts[2], all;
  ok(CeedCompositeOperatorCreate(ceed, all.out()));
  for (Operator &part : parts) {
    ok(CeedOperatorCreate(ceed, qf, CEED_QFUNCTION_NONE, CEED_QFUNCTION_NONE, part.out()));
    ok(CeedOperatorSetField(part, "input", rstr, CEED_BASIS_NONE, CEED_VECTOR_ACTIVE));
    ok(CeedOperatorSetField(part, "output", rstr, CEED_BASIS_NONE, CEED_VECTOR_ACTIVE));
    ok(CeedCompositeOperatorAddSub(all, part));
  }
  ok(CeedOperatorSetName(parts[1], "second"));

  CeedInt count = 0;
  ok(CeedCompositeOperatorGetNumSub(all, &count));
  EXPECT_EQ(count, 2);
  CeedOperator *list = nullptr, found = nullptr;
  ok(CeedCompositeOperatorGetSubList(all, &list));
  EXPECT_EQ(list[0], parts[0].get());
  EXPECT_EQ(list[1], parts[1].get());
  ok(CeedCompositeOperatorGetSubByName(all, "second", &found));
  EXPECT_EQ(found, parts[1].get());

  const Vector former = make_vector(ceed, 3, 7), present = make_vector(ceed, 3, 7);
  CeedInt skipped[] = {1};
  ok(CeedCompositeOperatorGetMultiplicity(all, 1, skipped, former));
  ok(CeedOperatorCompositeGetMultiplicity(all, 1, skipped, present));
  EXPECT_EQ(values_of(former), values_of(present));
  EXPECT_EQ(values_of(former), Values(3, 1));
}

}  // namespace
