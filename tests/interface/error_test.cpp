// Error handlers: the four of the interface, one's own, and the environment variable that chooses one.
#include <ceed/backend.h>
#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <string>
#include <thread>
#include <vector>

#include "support/errors.hpp"
#include "support/handles.hpp"
#include "support/values.hpp"

namespace {

using namespace hg::test;

Ceed open_with(const char *environment) {
  if (environment != nullptr) {
    ::setenv("CEED_ERROR_HANDLER", environment, 1);
  } else {
    ::unsetenv("CEED_ERROR_HANDLER");
  }
  Ceed ceed = nullptr;
  EXPECT_EQ(CeedInit(reference_resource, &ceed), 0);
  return ceed;
}

std::string stored(Ceed ceed) {
  const char *message = nullptr;
  EXPECT_EQ(CeedGetErrorMessage(ceed, &message), 0);
  return message;
}

TEST(Error, ReturnOnlyGivesTheCode) {
  const CeedHandle ceed(open_with("return"));
  testing::internal::CaptureStderr();
  EXPECT_EQ(CeedError(ceed, CEED_ERROR_DIMENSION, "a length of %d", 3), CEED_ERROR_DIMENSION);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_EQ(stored(ceed), "No error message stored");
}

TEST(Error, StoreKeepsTheMessage) {
  const CeedHandle ceed(open_with("store"));
  EXPECT_EQ(stored(ceed), "No error message stored");
  const int line = __LINE__ + 1;
  EXPECT_EQ(CeedError(ceed, CEED_ERROR_DIMENSION, "a length of %d, not %s", 3, "four"), CEED_ERROR_DIMENSION);
  const std::string want =
      std::string(__FILE__) + ":" + std::to_string(line) + " in " + __func__ + "(): a length of 3, not four";
  EXPECT_EQ(stored(ceed), want);
  const char *message = "not yet";
  ok(CeedResetErrorMessage(ceed, &message));
  EXPECT_EQ(message, nullptr);
  EXPECT_EQ(stored(ceed), "No error message stored");
}

/// A message that was handed out can be read while other threads fail.
TEST(Error, SeveralThreadsMayFailAtOnce) {
  const CeedHandle ceed(open_with("store"));
  std::vector<std::thread> threads;
  std::atomic<int> num_other = 0;
  for (int t = 0; t < 4; t++) {
    threads.emplace_back([&, t] {
      for (int i = 0; i < 200; i++) {
        CeedVector vec = nullptr;
        EXPECT_EQ(CeedVectorCreate(ceed, -1 - t, &vec), CEED_ERROR_DIMENSION);
        const std::string message = stored(ceed);
        if (message.find("CeedVectorCreate(): Length of a CeedVector is -") == std::string::npos) num_other++;
      }
    });
  }
  for (std::thread &thread : threads) thread.join();
  EXPECT_EQ(num_other, 0);
}

/// The general form is file:line in function(): message, with the function that the caller called.
TEST(Error, OfTheLibraryNamesItsFunction) {
  const CeedHandle ceed(open_with("store"));
  CeedVector vec = nullptr;
  EXPECT_GT(CeedVectorCreate(ceed, -5, &vec), 0);
  const std::string message = stored(ceed);
  EXPECT_NE(message.find("in CeedVectorCreate(): "), std::string::npos) << message;
  EXPECT_NE(message.find("-5"), std::string::npos) << message;
  EXPECT_NE(message.find(".cpp:"), std::string::npos) << message;
}

TEST(ErrorDeathTest, AbortPrintsAndAborts) {
  EXPECT_DEATH(
      {
        Ceed ceed = open_with("abort");
        static_cast<void>(CeedError(ceed, CEED_ERROR_MAJOR, "the roof is %s", "gone"));
      },
      "error_test.*in .*\\(\\): the roof is gone");
}

TEST(ErrorDeathTest, AbortIsTheDefault) {
  EXPECT_DEATH(
      {
        Ceed ceed = open_with(nullptr);
        CeedVector vec = nullptr;
        CeedVectorCreate(ceed, -5, &vec);
      },
      "CeedVectorCreate\\(\\): .*-5");
  EXPECT_DEATH(
      {
        Ceed ceed = open_with("no such handler");
        static_cast<void>(CeedError(ceed, 1, "still an end"));
      },
      "still an end");
}

TEST(ErrorDeathTest, ExitPrintsAndExitsWithTheCode) {
  EXPECT_EXIT(
      {
        Ceed ceed = open_with("exit");
        static_cast<void>(CeedError(ceed, CEED_ERROR_INCOMPLETE, "half a bridge"));
      },
      testing::ExitedWithCode(CEED_ERROR_INCOMPLETE), "half a bridge");
  // Negative codes are what the operating system makes of them: not 0.
  EXPECT_EXIT(
      {
        Ceed ceed = open_with("exit");
        static_cast<void>(CeedError(ceed, CEED_ERROR_MAJOR, "no bridge"));
      },
      testing::ExitedWithCode(255), "no bridge");
}

/// Errors before there is a Ceed.
TEST(ErrorDeathTest, WithoutACeedTheEnvironmentDecides) {
  EXPECT_DEATH(
      {
        ::setenv("CEED_ERROR_HANDLER", "abort", 1);
        Ceed ceed = nullptr;
        CeedInit("/abacus", &ceed);
      },
      "No suitable backend: /abacus");
  ::setenv("CEED_ERROR_HANDLER", "return", 1);
  Ceed ceed = nullptr;
  EXPECT_EQ(CeedInit("/abacus", &ceed), CEED_ERROR_MAJOR);
}

TEST(Error, HandlersCanBeChanged) {
  const CeedHandle ceed(open_with("return"));
  ok(CeedSetErrorHandler(ceed, CeedErrorStore));
  EXPECT_EQ(CeedError(ceed, 1, "kept"), 1);
  EXPECT_NE(stored(ceed).find("kept"), std::string::npos);
  ok(CeedSetErrorHandler(ceed, CeedErrorReturn));
  EXPECT_EQ(CeedError(ceed, 1, "lost"), 1);
  EXPECT_NE(stored(ceed).find("kept"), std::string::npos);
  EXPECT_NE(CeedSetErrorHandler(ceed, nullptr), 0);
}

/// One's own handler sees everything; two Ceeds have two.
TEST(Error, OnesOwnHandler) {
  const CeedHandle ceed(open("/cpu/self/ref/serial")), other(open_with("store"));
  forget_reports();
  CeedVector vec = nullptr;
  expect_error(CeedVectorCreate(ceed, -5, &vec), CEED_ERROR_DIMENSION, {"-5"});
  EXPECT_EQ(num_reports(), 1);
  EXPECT_EQ(last_report().function, "CeedVectorCreate");
  EXPECT_GT(last_report().line, 0);
  EXPECT_GT(CeedVectorCreate(other, -6, &vec), 0);
  EXPECT_EQ(num_reports(), 1);
  EXPECT_NE(stored(other).find("-6"), std::string::npos);
}

/// An error is told once, however many functions it passes on its way out.
TEST(Error, IsReportedOnce) {
  const CeedHandle ceed(open("/cpu/self/ref/serial"));
  const Vector short_one = make_vector(ceed, 2, 1);
  QFunction qf;
  ok(CeedQFunctionCreateIdentity(ceed, 1, CEED_EVAL_NONE, CEED_EVAL_NONE, qf.out()));
  Restriction rstr;
  const CeedInt strides[] = {1, 3, 3};
  ok(CeedElemRestrictionCreateStrided(ceed, 1, 3, 1, 3, strides, rstr.out()));
  Operator op;
  ok(CeedOperatorCreate(ceed, qf, CEED_QFUNCTION_NONE, CEED_QFUNCTION_NONE, op.out()));
  ok(CeedOperatorSetField(op, "input", rstr, CEED_BASIS_NONE, CEED_VECTOR_ACTIVE));
  ok(CeedOperatorSetField(op, "output", rstr, CEED_BASIS_NONE, CEED_VECTOR_ACTIVE));
  Vector empty;
  ok(CeedVectorCreate(ceed, 3, empty.out()));
  const Vector out = make_vector(ceed, 3, 0);
  forget_reports();
  EXPECT_NE(CeedOperatorApply(op, empty, out, CEED_REQUEST_IMMEDIATE), 0);  // deep inside: no values
  EXPECT_EQ(num_reports(), 1);
  forget_reports();
  EXPECT_NE(CeedOperatorApply(op, short_one, out, CEED_REQUEST_IMMEDIATE), 0);
  EXPECT_EQ(num_reports(), 1);
}

TEST(Error, NamesOfTheCodes) {
  EXPECT_STREQ(CeedErrorTypes[CEED_ERROR_SUCCESS], "success");
  for (int code = CEED_ERROR_UNSUPPORTED; code <= CEED_ERROR_ACCESS; code++) {
    ASSERT_NE(CeedErrorTypes[code], nullptr) << code;
    EXPECT_STRNE(CeedErrorTypes[code], "") << code;
  }
}

}  // namespace
