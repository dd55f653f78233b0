#include "solve/slope_search.hpp"

#include <algorithm>
#include <cmath>

#include "options/error.hpp"

namespace hg {

namespace {

constexpr double full_step_slope = 0.8, wanted_slope = 0.5;
constexpr int max_evaluations = 12, max_trials = 50;

struct Search {
  SNES snes;
  Vec u, f, y, trial, f_trial;

  /// φ'(λ); false if the state cannot be evaluated.
  bool slope(double lambda, double &value) const {
    petsc_check(VecWAXPY(trial, -lambda, y, u));
    petsc_check(SNESComputeFunction(snes, trial, f_trial));
    PetscScalar dot;
    petsc_check(VecDot(y, f_trial, &dot));
    value = -dot;
    return std::isfinite(value);
  }
};

PetscErrorCode apply(SNESLineSearch search, void *) {
  return guard([&] {
    Search s{};
    petsc_check(SNESLineSearchGetSNES(search, &s.snes));
    petsc_check(SNESLineSearchGetVecs(search, &s.u, &s.f, &s.y, &s.trial, &s.f_trial));
    PetscScalar dot;
    petsc_check(VecDot(s.y, s.f, &dot));
    if (dot < 0) {
      petsc_check(VecScale(s.y, -1.));
      dot = -dot;
    }
    const double start = -dot;

    // Brackets the root: φ'(low) < 0, and φ'(high) > 0 or high cannot be evaluated.
    double low = 0, low_slope = start, high = 1, high_slope = 0, lambda = 1, value = 0;
    bool high_known = false, found = false;
    int evaluations = 0;
    for (int trials = 0; trials < max_trials && !found && !(evaluations >= max_evaluations && low > 0); ++trials) {
      if (s.slope(lambda, value)) {
        ++evaluations;
        // Past the full step nothing is known; downhill there is good enough.
        found =
            std::abs(value) <= (lambda == 1 ? full_step_slope : wanted_slope) * -start || (lambda == 1 && value < 0);
        if (found) break;
        if (value < 0) {
          if (high_known) high_slope /= 2;
          low = lambda;
          low_slope = value;
        } else {
          if (high_known) low_slope /= 2;
          high = lambda;
          high_slope = value;
          high_known = true;
        }
      } else {
        high = lambda;
        high_known = false;
      }
      // Half way without a slope at the high end; with one, where the chord is zero, but not too near to either end:
      // next to an inverted element the slope is a wall.
      const double chord = high_known ? low_slope / (low_slope - high_slope) : 0.5;
      lambda = low + (high - low) * std::clamp(chord, 0.1, 0.9);
    }
    if (!found) {
      if (low == 0) {
        petsc_check(SNESLineSearchSetReason(search, SNES_LINESEARCH_FAILED_REDUCT));
        return;
      }
      // Downhill all the way to here.
      lambda = low;
      s.slope(lambda, value);
    }
    petsc_check(VecCopy(s.trial, s.u));
    petsc_check(VecCopy(s.f_trial, s.f));
    petsc_check(SNESLineSearchSetLambda(search, lambda));
    petsc_check(SNESLineSearchComputeNorms(search));
    petsc_check(SNESLineSearchSetReason(search, SNES_LINESEARCH_SUCCEEDED));
  });
}

}  // namespace

void use_slope_search(SNES snes) {
  SNESLineSearch search;
  petsc_check(SNESGetLineSearch(snes, &search));
  petsc_check(SNESLineSearchSetType(search, SNESLINESEARCHSHELL));
#if PETSC_VERSION_LT(3, 21, 0)
  petsc_check(SNESLineSearchShellSetUserFunc(search, apply, nullptr));
#else
  petsc_check(SNESLineSearchShellSetApply(
      search, [](SNESLineSearch inner, void *context) { return apply(inner, context); }, nullptr));
#endif
}

}  // namespace hg
