// Numbers that are no value of an enumeration: an error that says so.
#include "enumerations.h"

#include <gtest/gtest.h>

#include <string>

#include "support/errors.hpp"
#include "support/handles.hpp"
#include "support/values.hpp"

namespace {

using namespace hg::test;

TEST(Enumerations, OtherNumbersAreRefused) {
#if defined(__SANITIZE_ADDRESS__)
  GTEST_SKIP() << "the sanitizer of undefined behaviour ends a program that passes such numbers to C++";
#endif
  const CeedHandle ceed(open(reference_resource));
  const Vector vec = make_vector(ceed, 6, 1.0), other = make_vector(ceed, 6, 1.0);
  const CeedInt offsets[] = {0, 1, 1, 2}, points[] = {3, 4, 6, 0, 1, 2};
  Restriction rstr, at_points;
  ok(CeedElemRestrictionCreate(ceed, 2, 2, 1, 1, 3, CEED_MEM_HOST, CEED_COPY_VALUES, offsets, rstr.out()));
  ok(CeedElemRestrictionCreateAtPoints(ceed, 2, 3, 1, 3, CEED_MEM_HOST, CEED_COPY_VALUES, points, at_points.out()));
  Basis basis;
  ok(CeedBasisCreateTensorH1Lagrange(ceed, 1, 1, 2, 2, CEED_GAUSS, basis.out()));
  QFunction qf;
  ok(CeedQFunctionCreateInteriorByName(ceed, "Scale", qf.out()));
  Context ctx;
  double number = 1;
  ok(CeedQFunctionContextCreate(ceed, ctx.out()));
  ok(CeedQFunctionContextSetData(ctx, CEED_MEM_HOST, CEED_COPY_VALUES, sizeof number, &number));
  for (const EnumerationCall *one = enumeration_calls; one->name != nullptr; one++) {
    for (const int value : {7, 1000}) {
      SCOPED_TRACE(std::string(one->name) + "(" + std::to_string(value) + ")");
      EnumerationObjects objects{vec, other, rstr, at_points, basis, qf, ctx, ceed};
      forget_reports();
      const int code = one->call(&objects, value);
      EXPECT_NE(code, CEED_ERROR_SUCCESS);
      // Some functions have no object whose handler could be asked.
      if (num_reports() == 0) continue;
      EXPECT_NE(last_report().message.find(std::to_string(value)), std::string::npos) << last_report().message;
    }
  }
  EXPECT_EQ(values_of(other), Values(6, 1.0));
}

}  // namespace
