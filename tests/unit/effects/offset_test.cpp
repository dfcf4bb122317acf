// SPDX-License-Identifier: MIT
#include "lacuna/effects/offset.hpp"

#include <gtest/gtest.h>

#include "support/diagnosis_scope.hpp"

namespace lacuna {
namespace {

TEST(ConstantOffset, IsTheConstantOfAnEquationThatHasNone) {
  const Scope scope = support::oscillator_scope();
  const auto made = ConstantOffset().candidates(scope, 1);
  ASSERT_EQ(made.size(), 1u);
  EXPECT_EQ(made[0].form, "1");
  EXPECT_TRUE(ConstantOffset().candidates(scope, 0).empty()) << "an identity lacks nothing";
}

TEST(ConstantOffset, IsNoCandidateWhereTheModelHasAConstant) {
  Scope scope = support::oscillator_scope();
  scope.model = scope.model.with_term(1, {Term::parse("1", scope.model.variables()), 0.5});
  EXPECT_TRUE(ConstantOffset().candidates(scope, 1).empty());
}

}  // namespace
}  // namespace lacuna
