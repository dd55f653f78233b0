// A backend each of whose functions fails once, at each call that the scenarios make of it: there is the backend's
// error and its message, nothing leaks (which the address sanitizer tells), and the library works afterwards.
#include <ceed/plugin.h>
#include <gtest/gtest.h>

#include <cctype>
#include <string>
#include <vector>

#include "failing_calls.hpp"
#include "support/handles.hpp"

namespace {

using namespace hg::test;

constexpr const char *reference = "/cpu/self/ref/serial";

CeedBackendOps parent;
long until_failure = 0;  ///< calls of the backend up to the one that fails; 0: none does
bool has_failed = false;

/// Counts a call; whether it is to fail.
bool fails() {
  if (until_failure == 0 || --until_failure > 0) return false;
  has_failed = true;
  return true;
}

constexpr const char *reason = "The device was pulled out";

int fail(Ceed ceed) {
  return CeedError(ceed, CEED_ERROR_BACKEND, "%s", reason);
}

Ceed ceed_of(CeedVector vec) {
  return CeedVectorReturnCeed(vec);
}
Ceed ceed_of(CeedElemRestriction rstr) {
  return CeedElemRestrictionReturnCeed(rstr);
}
Ceed ceed_of(CeedBasis basis) {
  return CeedBasisReturnCeed(basis);
}
Ceed ceed_of(CeedQFunction qf) {
  return CeedQFunctionReturnCeed(qf);
}
Ceed ceed_of(CeedQFunctionContext ctx) {
  return CeedQFunctionContextReturnCeed(ctx);
}
Ceed ceed_of(CeedOperator op) {
  return CeedOperatorReturnCeed(op);
}

/// The parent's function, or what stands in for one that it does not have: a success.
template <auto group, auto entry, typename Object, typename... Rest>
int call(Object object, Rest... rest) {
  if (fails()) return fail(ceed_of(object));
  const auto function = parent.*group.*entry;
  return function != nullptr ? function(object, rest...) : CEED_ERROR_SUCCESS;
}

/// What is freed is freed, whatever it says.
template <auto group, auto entry, typename Object>
int call_and_free(Object object) {
  const auto function = parent.*group.*entry;
  const int code = function != nullptr ? function(object) : CEED_ERROR_SUCCESS;
  return code == CEED_ERROR_SUCCESS && fails() ? fail(ceed_of(object)) : code;
}

template <auto group, auto entry, typename Object, typename... Rest>
void replace(CeedBackendOps &ops, int (*)(Object, Rest...)) {
  ops.*group.*entry = call<group, entry, Object, Rest...>;
}

template <auto group, auto entry>
void replace(CeedBackendOps &ops) {
  replace<group, entry>(ops, ops.*group.*entry);
}

/// An entry that does nothing where the parent has none: those that do work must stay NULL then.
template <auto group, auto... entries>
void replace_those_that_are(CeedBackendOps &ops) {
  ((ops.*group.*entries != nullptr ? replace<group, entries>(ops) : void()), ...);
}

int init(Ceed, const char *, CeedBackendOps *ops) {
  if (parent.size == 0) parent = *ops;
  constexpr auto vector = &CeedBackendOps::vector;
  constexpr auto restriction = &CeedBackendOps::restriction;
  constexpr auto basis = &CeedBackendOps::basis;
  constexpr auto qfunction = &CeedBackendOps::qfunction;
  constexpr auto op = &CeedBackendOps::op;
  constexpr auto context = &CeedBackendOps::context;
  using V = CeedVectorOps;
  replace_those_that_are<vector, &V::create, &V::set_array, &V::take_array, &V::sync_array, &V::get_array,
                         &V::get_array_read, &V::get_array_write, &V::has_valid_array, &V::has_borrowed_array,
                         &V::set_value, &V::norm, &V::scale, &V::axpy, &V::axpby, &V::pointwise_mult, &V::reciprocal,
                         &V::filter, &V::copy, &V::copy_strided, &V::set_value_strided>(*ops);
  replace<vector, &V::restore_array>(*ops);
  replace<vector, &V::restore_array_read>(*ops);
  ops->vector.destroy = call_and_free<vector, &V::destroy, CeedVector>;
  replace<restriction, &CeedElemRestrictionOps::create>(*ops);
  replace<restriction, &CeedElemRestrictionOps::apply>(*ops);
  ops->restriction.destroy = call_and_free<restriction, &CeedElemRestrictionOps::destroy, CeedElemRestriction>;
  replace<basis, &CeedBasisOps::create>(*ops);
  replace<basis, &CeedBasisOps::apply>(*ops);
  replace<basis, &CeedBasisOps::apply_at_points>(*ops);
  ops->basis.destroy = call_and_free<basis, &CeedBasisOps::destroy, CeedBasis>;
  replace<qfunction, &CeedQFunctionOps::create>(*ops);
  replace<qfunction, &CeedQFunctionOps::apply>(*ops);
  ops->qfunction.destroy = call_and_free<qfunction, &CeedQFunctionOps::destroy, CeedQFunction>;
  replace<op, &CeedOperatorOps::create>(*ops);
  replace<op, &CeedOperatorOps::apply_add>(*ops);
  replace<op, &CeedOperatorOps::linear_assemble_qfunction>(*ops);
  replace<op, &CeedOperatorOps::get_memory>(*ops);
  replace_those_that_are<op, &CeedOperatorOps::prepare, &CeedOperatorOps::linear_assemble,
                         &CeedOperatorOps::linear_assemble_elements>(*ops);
  ops->op.destroy = call_and_free<op, &CeedOperatorOps::destroy, CeedOperator>;
  replace<context, &CeedQFunctionContextOps::get_data_read>(*ops);
  replace<context, &CeedQFunctionContextOps::restore_data_read>(*ops);
  return CEED_ERROR_SUCCESS;
}

constexpr CeedBackend backends[] = {{"/test/failing at a call", reference, 1000, nullptr, nullptr, init}};
constexpr CeedPlugin plugin = {sizeof(CeedPlugin), CEED_PLUGIN_API_VERSION, "failing", 1, backends};

class FailingBackend : public testing::TestWithParam<Scenario> {
 protected:
  static void SetUpTestSuite() { ASSERT_EQ(CeedPluginRegister(&plugin), CEED_ERROR_SUCCESS); }
};

TEST_P(FailingBackend, IsAnErrorThatLeaksNothing) {
  CeedHandle ceed;
  ASSERT_EQ(CeedInit(backends[0].resource, ceed.out()), CEED_ERROR_SUCCESS);
  ASSERT_EQ(CeedSetErrorHandler(ceed, keep_told), CEED_ERROR_SUCCESS);
  const Ended first = run_to_end(GetParam(), ceed);
  ASSERT_EQ(first.code, CEED_ERROR_SUCCESS) << told.message;
  long num_errors = 0;
  for (long n = 1;; n++) {
    until_failure = n;
    has_failed = false;
    const Ended ended = run_to_end(GetParam(), ceed);
    until_failure = 0;
    ASSERT_EQ(ended.wrong, nullptr) << "call " << n << ": " << ended.wrong;
    ASSERT_TRUE(ended.code == CEED_ERROR_SUCCESS || has_failed) << "call " << n << ": " << told.message;
    if (ended.code != CEED_ERROR_SUCCESS) {
      num_errors++;
      EXPECT_EQ(ended.code, CEED_ERROR_BACKEND) << "call " << n << ": " << told.message;
    }
    if (has_failed) {
      EXPECT_STREQ(told.message, reason) << "call " << n;
    }
    const Ended again = run_to_end(GetParam(), ceed);
    ASSERT_EQ(again.code, CEED_ERROR_SUCCESS) << "after call " << n << ": " << told.message;
    ASSERT_EQ(again.wrong, nullptr) << "after call " << n << ": " << again.wrong;
    if (!has_failed) break;
  }
  const bool calls_backend = std::string(GetParam().name) != "sources and dense helpers";
  EXPECT_EQ(num_errors > 0, calls_backend);
}

INSTANTIATE_TEST_SUITE_P(Scenarios, FailingBackend,
                         testing::ValuesIn(failure_scenarios().begin(), failure_scenarios().end()),
                         [](const auto &info) {
                           std::string name = info.param.name;
                           for (char &c : name) c = std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
                           return name;
                         });

}  // namespace
