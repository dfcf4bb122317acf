// SPDX-License-Identifier: MIT
#include "lacuna/effects/friction.hpp"

#include <gtest/gtest.h>

#include "support/diagnosis_scope.hpp"

namespace lacuna {
namespace {

TEST(CoulombFriction, IsSharpOrSmooth) {
  const auto made = CoulombFriction().candidates(support::oscillator_scope(), 1);
  ASSERT_EQ(made.size(), 2u);
  EXPECT_EQ(made[0].form, "sign(v)");
  EXPECT_EQ(made[1].form, "tanh(v/width)");
  ASSERT_EQ(made[1].shapes.size(), 1u);
  EXPECT_EQ(made[1].shapes[0].unit, "m/s");
}

TEST(CoulombFriction, NeedsAVelocityOfBothSigns) {
  Scope scope = support::oscillator_scope();
  scope.variables[1].low = 0.1;
  EXPECT_TRUE(CoulombFriction().candidates(scope, 1).empty());
}

}  // namespace
}  // namespace lacuna
