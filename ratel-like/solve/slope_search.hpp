/// @file
/// A line search for equilibrium: along the step it looks for a small slope of the energy.
#pragma once

#include <petscsnes.h>

namespace hg {

/// Makes the line search of a SNES whose residual F is the gradient of an energy φ. The search goes from u to u − λ y:
///
/// - φ'(0) = −y·F(u). If that is positive, y climbs (the Jacobian is indefinite): its sign is turned.
/// - λ = 1 is taken if |φ'(1)| ≤ 0.8 |φ'(0)|, so that Newton stays quadratic near its goal.
/// - Else a root of φ' is bracketed in (0, 1] and narrowed by a guarded Illinois method until |φ'| ≤ 0.5 |φ'(0)|; a
/// state
///   that cannot be evaluated (an inverted element) counts as beyond the root. If that takes too long, the largest λ
///   found that is still downhill is taken.
///
/// The norm of F may rise on the way, which a Newton that converges often needs.
void use_slope_search(SNES snes);

}  // namespace hg
