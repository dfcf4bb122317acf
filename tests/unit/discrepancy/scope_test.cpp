// SPDX-License-Identifier: MIT
#include "lacuna/discrepancy/scope.hpp"

#include <gtest/gtest.h>

#include "lacuna/core/error.hpp"
#include "support/diagnosis_scope.hpp"

namespace lacuna {
namespace {

TEST(Scope, DescribesEveryVariable) {
  const Scope scope = support::oscillator_scope();
  ASSERT_EQ(scope.variables.size(), 3u);
  EXPECT_EQ(scope.variables[2].name, "F");
  EXPECT_TRUE(scope.variables[2].is_input);
  EXPECT_NEAR(scope.state(1).high, 2.0, 1e-3);
  EXPECT_NEAR(scope.state(1).low, -2.0, 1e-3);
  EXPECT_NEAR(scope.state(0).quantile(0.5), 0.0, 0.1);
  EXPECT_EQ(scope.state(0).quantile(1.0), scope.state(0).high);
  EXPECT_DOUBLE_EQ(scope.state(0).noise, 0.01);
}

TEST(Scope, KnowsTheTimes) {
  const Scope scope = support::oscillator_scope();
  EXPECT_NEAR(scope.step, 0.01, 1e-12);
  EXPECT_NEAR(scope.duration, 10.0, 1e-12);
}

TEST(Scope, KnowsIdentities) {
  const Scope scope = support::oscillator_scope();
  EXPECT_TRUE(scope.is_identity(0));
  EXPECT_FALSE(scope.is_identity(1));
  EXPECT_EQ(scope.integral_of(1), std::optional<Index>(0));
  EXPECT_EQ(scope.integral_of(0), std::nullopt);
}

TEST(Scope, RecordsMustFitTheModel) {
  Dataset other = support::oscillator_record();
  other.inputs[0].name = "u";
  EXPECT_THROW(make_scope(support::oscillator(), other, Vector::Zero(2)), ArgumentError);
}

}  // namespace
}  // namespace lacuna
