// SPDX-License-Identifier: MIT
#include "forms/candidate/nesting.hpp"

#include <gtest/gtest.h>

#include "lacuna/effects/families.hpp"
#include "support/effect_forms.hpp"

namespace lacuna {
namespace {

using support::candidate_of;

bool has(const Candidate& general, const Candidate& special) {
  return nests(general, special, special.starts.front(), support::oscillator_scope());
}

TEST(Nesting, SharpFrictionIsASpecialCaseOfSmoothAndOfRisingOne) {
  const Scope scope = support::oscillator_scope();
  const Candidate sharp = candidate_of<kCoulombFriction>(scope, 1, "sign(v)");
  const Candidate smooth = candidate_of<kCoulombFriction>(scope, 1, "tanh(v/width)");
  const Candidate rising =
      candidate_of<kStribeckFriction>(scope, 1, "(1+rise*exp(-(v/speed)^2))*sign(v)");
  EXPECT_TRUE(has(smooth, sharp));
  EXPECT_TRUE(has(rising, sharp));
  EXPECT_FALSE(has(sharp, smooth)) << "the other way round";
  EXPECT_FALSE(has(rising, candidate_of<kQuadraticDrag>(scope, 1, "v*abs(v)")));
}

TEST(Nesting, ACubeIsASoftLimitFarAway) {
  const Scope scope = support::oscillator_scope();
  const Candidate cube = candidate_of<kCubicTerm>(scope, 1, "q^3");
  EXPECT_TRUE(has(candidate_of<kSaturation>(scope, 1, "q-limit*tanh(q/limit)"), cube));
  EXPECT_FALSE(has(candidate_of<kSaturation>(scope, 1, "q-clip(q,-limit,limit)"), cube));
}

TEST(Nesting, FormsOfOtherVariablesDoNotNest) {
  const Scope scope = support::oscillator_scope();
  EXPECT_FALSE(has(candidate_of<kSaturation>(scope, 1, "q-limit*tanh(q/limit)"),
                   candidate_of<kCubicTerm>(scope, 1, "v^3")));
}

TEST(Nesting, SamplesDoNotTellWhatRemembers) {
  const Scope scope = support::oscillator_scope();
  EXPECT_FALSE(
      has(candidate_of<kLag>(scope, 1, "lagged-q"), candidate_of<kCubicTerm>(scope, 1, "q^3")));
}

}  // namespace
}  // namespace lacuna
