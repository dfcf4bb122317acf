// SPDX-License-Identifier: MIT
#include "lacuna/diagnose/candidates/explanation.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/assimilated_oscillator.hpp"

namespace lacuna {
namespace {

TEST(Explanation, FitsCoefficientAndShapesJointly) {
  const Dataset data = support::hidden_record(
      [](double, double q, double) { return -3.0 * std::min(q + 0.2, 0.0); }, 0.002);
  const Assimilation base = support::assimilated(data);
  const Explanation found =
      explain({data, base.model, support::oscillator_fit_options(), RunContext{}}, base,
              {{support::stop_candidate(0.0), Vector::Constant(1, -0.1), -2.0}});
  EXPECT_LT(found.fit.deviance, base.deviance - 100.0);
  EXPECT_NEAR(found.effects[0].shapes[0], -0.2, 0.02);
  EXPECT_NEAR(found.effects[0].coefficient, -3.0, 0.1);
  EXPECT_GT(found.effects[0].deviation, 0.0);
  EXPECT_EQ(found.parameters(), 2);
  EXPECT_NEAR(found.fit.model.coefficient(1, "v"), -0.2, 0.01);
}

TEST(Explanation, ShapesOfWhatHasLostItsPathAreNotMoved) {
  const Dataset data = support::hidden_record(
      [](double, double q, double) { return -3.0 * std::min(q + 0.2, 0.0); }, 0.002);
  const Assimilation base = support::assimilated(data);
  const OdeModel nominal = base.model;
  const AssimilationOptions options = support::oscillator_fit_options();
  const RunContext context;
  JointFitTask task{data, nominal, options, context};
  const std::vector<FittedEffect> stop{
      {support::stop_candidate(0.0), Vector::Constant(1, -0.1), -2.0}};
  task.bare_deviance = base.deviance - 1e3;
  EXPECT_NE(explain(task, base, stop).effects[0].shapes[0], -0.1) << "not as good yet";
  task.bare_deviance = -1e9;
  EXPECT_EQ(explain(task, base, stop).effects[0].shapes[0], -0.1);
}

TEST(Explanation, AFitOfAFreeInputIsWhereTheSameFitEnds) {
  const Dataset data = support::hidden_record(
      [](double t, double, double) {
        return 2.0 * std::sin(3.1 * t) * std::cos(0.31 * t) + std::sin(7.3 * t);
      },
      0.0005);
  const Assimilation base = support::assimilated(data);
  Candidate input = support::plain_candidate("drive");
  input.memory = {{"drive", parse_expression("-drive/memory"), Expression::number(0.0), true}};
  input.shapes = {{"memory", "s", 0.1, 20.0, true}};
  const AssimilationOptions options = support::oscillator_fit_options();
  const RunContext context;
  const JointFitTask task{data, base.model, options, context};
  const Explanation found = explain(task, base, {{input, Vector::Constant(1, 1.0), 1.0}});
  ASSERT_LT(found.fit.deviance, base.deviance - 100.0);
  const Explanation again = explain_roughly(task, found.fit, found.effects);
  EXPECT_NEAR(again.fit.deviance, found.fit.deviance, 1.0);
}

TEST(Explanation, AMemoryWithoutFiniteValuesIsNoExplanation) {
  const Dataset data = support::hidden_record(support::nothing, 0.01);
  const Assimilation base = support::assimilated(data);
  Candidate late = support::plain_candidate("late");  // that grows beyond numbers in the end
  late.memory = {{"late", parse_expression("(F-late)/0.2+1000*step(t-25)*late"),
                  parse_expression("F")}};
  const Explanation found =
      explain({data, base.model, support::oscillator_fit_options(), RunContext{}}, base,
              {{late, Vector(0), 1.0}});
  EXPECT_FALSE(std::isfinite(found.fit.deviance)) << found.fit.deviance;
}

}  // namespace
}  // namespace lacuna
