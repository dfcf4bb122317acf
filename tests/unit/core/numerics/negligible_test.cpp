// SPDX-License-Identifier: MIT
#include "lacuna/core/numerics/negligible.hpp"

#include <gtest/gtest.h>

namespace lacuna {
namespace {

TEST(NegligibleTerms, AreSmallAndDoNotExplainMostOfWhatIsLeft) {
  const NegligibleTerms rule;
  EXPECT_TRUE(rule.holds(9e-4, 9.0));
  EXPECT_FALSE(rule.holds(2e-3, 1.01));
  EXPECT_FALSE(rule.holds(9e-4, 11.0));
}

TEST(NegligibleTerms, BelowTheResolutionNothingIsMeant) {
  EXPECT_TRUE(NegligibleTerms().holds(5e-8, 1e6));
  EXPECT_FALSE(NegligibleTerms{.effect_size = 0.0}.holds(0.0, 1.0));
}

TEST(NegligibleTerms, BesideAFloorATermHasToExplainMoreThanTheRest) {
  const NegligibleTerms rule = NegligibleTerms().beside_a_floor();
  EXPECT_TRUE(rule.holds(9e-3, 1.3));
  EXPECT_FALSE(rule.holds(9e-3, 1.5));
  EXPECT_FALSE(rule.holds(2e-2, 1.3));
}

}  // namespace
}  // namespace lacuna
