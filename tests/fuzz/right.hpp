/// @file
/// Right operators against the dense evaluation of the conformance suite.
#pragma once

#include "conformance/oracle/instance.hpp"

namespace hg::fuzz {

/// A case that the bytes choose, small enough to be evaluated in some milliseconds.
test::Case small_case(test::Random &bytes);

/// Throws Defect unless the operator does to a vector what the case says, and leaves its passive inputs alone.
void expect_action(const test::Instance &instance, const test::Case &c);

/// Makes a case's operator and compares what the bytes choose: action, added action, assembled QFunction, diagonal,
/// matrix.
void run_right(test::Random &bytes);

/// Compares the assembled matrix of one operator or a sum of some, with many active spaces, with its action on unit
/// vectors.
void run_assembled(test::Random &bytes);

}  // namespace hg::fuzz
