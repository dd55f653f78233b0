/// @file
/// Values of vectors, comparisons with a tolerance that follows from rounding, and properties.
#pragma once

#include <functional>
#include <span>
#include <string_view>
#include <vector>

#include "handles.hpp"
#include "random.hpp"
#include "source_location.hpp"

namespace hg::test {

using Values = std::vector<CeedScalar>;

/// A vector with a copy of the values.
Vector make_vector(Ceed ceed, std::span<const CeedScalar> values);
/// A vector of `length` equal values.
Vector make_vector(Ceed ceed, CeedSize length, CeedScalar value);
void set_values(CeedVector vec, std::span<const CeedScalar> values);
Values values_of(CeedVector vec);
CeedSize length_of(CeedVector vec);

/// Relative tolerance for a result to which `terms` rounded products contribute, with room for another order of sums
/// and for fused operations.
CeedScalar tolerance(CeedSize terms);

/// max |got - want|, and max |want|.
CeedScalar max_difference(std::span<const CeedScalar> got, std::span<const CeedScalar> want);
CeedScalar max_norm(std::span<const CeedScalar> values);
CeedScalar dot(std::span<const CeedScalar> a, std::span<const CeedScalar> b);

/// Expects the same lengths and max |got - want| <= tol * max(|want|, scale). NaN never passes.
void expect_close(std::span<const CeedScalar> got, std::span<const CeedScalar> want, CeedScalar tol,
                  std::string_view what, CeedScalar scale = 0,
                  SourceLocation where = SourceLocation::current());

/// Expects <y, A x> = <A^T y, x> for random x (num_in) and y (num_out).
void expect_adjoint(const std::function<Values(const Values &)> &action,
                    const std::function<Values(const Values &)> &transpose, CeedSize num_in, CeedSize num_out,
                    Random &random, CeedScalar tol, std::string_view what,
                    SourceLocation where = SourceLocation::current());

/// Expects A(a x + b y) = a A x + b A y for random x and y.
void expect_linear(const std::function<Values(const Values &)> &action, CeedSize num_in, Random &random, CeedScalar tol,
                   std::string_view what, SourceLocation where = SourceLocation::current());

/// Expects that `run` gives the same values on `ceed` as on the reference backend.
void expect_like_reference(Ceed ceed, const std::function<Values(Ceed)> &run, CeedScalar tol, std::string_view what,
                           SourceLocation where = SourceLocation::current());

/// The oracle that other backends are compared with.
inline constexpr const char *reference_resource = "/cpu/self/ref/serial";

}  // namespace hg::test
