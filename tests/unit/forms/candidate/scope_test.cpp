// SPDX-License-Identifier: MIT
#include "lacuna/forms/candidate/scope.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "lacuna/core/base/error.hpp"
#include "lacuna/model/files/ode_text.hpp"
#include "support/diagnosis_scope.hpp"
#include "support/expect_error.hpp"

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

TEST(Scope, KnowsHowLongVariablesRemember) {
  // cos(2 t) falls to one half at 2 t = pi/3.
  const Scope scope = support::oscillator_scope();
  EXPECT_NEAR(scope.state(0).timescale, 0.52, 0.05);
}

TEST(Scope, TellsAmountsFromSignedVariables) {
  Dataset data = support::oscillator_record();
  data.trajectories[0].states.col(0).array() += 1.5;
  const Scope scope = make_scope(support::oscillator(), data, Vector::Constant(2, 0.01));
  EXPECT_TRUE(scope.state(0).is_amount());
  EXPECT_FALSE(scope.state(0).changes_sign());
  EXPECT_FALSE(scope.state(1).is_amount());
  EXPECT_TRUE(scope.state(1).changes_sign());
}

TEST(Scope, AnAmountMayBeUsedUpForLong) {
  Dataset data = support::oscillator_record();
  auto q = data.trajectories[0].states.col(0).array();
  for (Index i = 0; i < q.size(); ++i)
    q[i] = std::max(q[i], 0.0) + (i % 2 == 0 ? 0.02 : -0.02);  // below 0 a quarter of the time
  const auto amount = [&](double noise) {
    return make_scope(support::oscillator(), data, Vector::Constant(2, noise))
        .state(0)
        .is_amount();
  };
  EXPECT_TRUE(amount(0.01));
  EXPECT_FALSE(amount(0.003)) << "noise does not take it as far below 0";
}

TEST(Scope, FormulasHaveARange) {
  const VariableRange range =
      support::oscillator_scope().range_of(parse_expression("4*q^2+v^2"));
  EXPECT_NEAR(range.low, 4.0, 1e-9);
  EXPECT_NEAR(range.high, 4.0, 1e-9);
  EXPECT_THROW(support::oscillator_scope().range_of(parse_expression("delay(q,1)")),
               ModelError);
}

TEST(Scope, NamesOfTheModelAreNotFree) {
  const Scope scope = support::oscillator_scope();
  EXPECT_EQ(scope.free_name("edge"), "edge");
  EXPECT_EQ(scope.free_name("q"), "q_");
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

TEST(Scope, WhatTheModelHasDelayedHasTheRangeOfItsPast) {
  const OdeModel late =
      parse_ode("input F\ndq/dt = v\ndv/dt = -4*q + delay(F, 2) - delay(q, 0.5)\n", "late");
  const Scope scope = make_scope(late, support::oscillator_record(), Vector::Constant(2, 0.01));
  const VariableRange range = scope.range_of(parse_expression("delay(q,0.5)^2"));
  EXPECT_NEAR(range.low, 0.0, 1e-3);
  EXPECT_NEAR(range.high, 1.0, 1e-3);
  const double late_by = scope.range_of(parse_expression("q-delay(q,0.5)")).high;
  EXPECT_NEAR(late_by, 2.0 * std::sin(0.5), 1e-3) << "sin(2 t) - sin(2 t - 1)";
  testing::expect_error<ModelError>(
      [&] { (void)scope.range_of(parse_expression("delay(q,0.6)")); }, "'delay(q,0.6)'",
      "no such delay", "of delays of the model");
}

}  // namespace
}  // namespace lacuna
