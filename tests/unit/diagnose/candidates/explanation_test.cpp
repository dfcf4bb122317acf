// SPDX-License-Identifier: MIT
#include "lacuna/diagnose/candidates/explanation.hpp"

#include <gtest/gtest.h>

#include <Eigen/QR>
#include <cmath>

#include "diagnose/candidates/candidate_column.hpp"
#include "diagnose/candidates/shape_step.hpp"
#include "support/assimilated_oscillator.hpp"

namespace lacuna {
namespace {

FittedEffect fitted(Candidate candidate, const Vector& shapes = Vector(0),
                    double coefficient = -0.3) {
  return {std::move(candidate), shapes, coefficient, 0.0};
}

/// z' = (q - z) / lag, z = 0 at first; the form is z.
Candidate lagging(const std::string& name) {
  Candidate candidate = support::plain_candidate(name);
  candidate.shapes = {{"lag", "s", 0.1, 10.0, true}};
  candidate.memory = {
      {name, parse_expression("(q-" + name + ")/lag"), parse_expression("0"), false}};
  return candidate;
}

AugmentedProblem augmented(const std::vector<FittedEffect>& effects) {
  const OdeModel nominal = support::oscillator();
  const Dataset data = support::oscillator_record();
  return augment(nominal, data, free_coefficients(nominal), effects,
                 {data.trajectories.front().states});
}

TEST(Augment, AMemoryIsAStateThatWasNotMeasuredWithItsSolution) {
  constexpr double kLag = 0.4;
  const AugmentedProblem made = augmented({fitted(lagging("z"), Vector::Constant(1, kLag))});
  ASSERT_EQ(made.model.dimension(), 3);
  EXPECT_EQ(made.data.states[2].name, "z");
  EXPECT_EQ(made.data.reconstructed, (std::vector<bool>{false, false, true}));
  const Trajectory& record = made.data.trajectories[0];
  // z' = (sin 2t - z) / T from z = 0: a sine behind the other, and what is left of the start.
  const double w = 2.0 * kLag, size = 1.0 / (1.0 + w * w);
  for (Index i = 0; i < record.samples(); i += 50) {
    const double t = record.time[i];
    const double z =
        size * (std::sin(2.0 * t) - w * std::cos(2.0 * t) + w * std::exp(-t / kLag));
    EXPECT_NEAR(record.states(i, 2), z, 2e-4) << t;
  }
}

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

/// A stop of which coefficient and edge were fitted.
struct FittedStop {
  Dataset data = support::hidden_record(
      [](double, double q, double) { return -3.0 * std::min(q + 0.2, 0.0); }, 0.002);
  Assimilation base = support::assimilated(data);
  AssimilationOptions options = support::oscillator_fit_options();
  RunContext context = {};
  JointFitTask task{data, base.model, options, context};
  Explanation found =
      explain(task, base, {{support::stop_candidate(0.0), Vector::Constant(1, -0.1), -2.0}});
};

/// Columns of everything that was fitted and of the edge, which moves the column of the stop.
Matrix all_columns(const Explanation& at) {
  const InnovationSystem system(at.fit);
  const FittedEffect& stop = at.effects[0];
  constexpr double kReach = 1e-4;
  const auto column = [&](double edge) {
    return *candidate_column(stop.candidate, {&edge, 1}, at.fit, system);
  };
  const double edge = stop.shapes[0];
  const Matrix fitted = system.fitted_columns();
  Matrix all(fitted.rows(), fitted.cols() + 1);
  all << fitted,
      stop.coefficient * (column(edge + kReach) - column(edge - kReach)) / (2.0 * kReach);
  return all;
}

TEST(ShapeStep, ErrorsAreThoseOfTheJointProblem) {
  const FittedStop stop;
  const Explanation joint = with_joint_errors(stop.task, stop.found);
  // (X'X)^-1 by the triangular factor of X: columns of its inverse.
  const Matrix columns = all_columns(stop.found);
  const Matrix r = Eigen::HouseholderQR<Matrix>(columns)
                       .matrixQR()
                       .topRows(columns.cols())
                       .triangularView<Eigen::Upper>();
  const Matrix inverse = r.inverse();
  const Vector deviations = inverse.rowwise().norm();
  const Index p = joint.fit.covariance.rows();
  ASSERT_EQ(deviations.size(), p + 1);
  for (Index j = 0; j < p; ++j)
    EXPECT_NEAR(std::sqrt(joint.fit.covariance(j, j)) / deviations[j], 1.0, 0.02);
  EXPECT_NEAR(joint.effects[0].deviation / deviations[p - 1], 1.0, 0.02);
  EXPECT_NEAR(joint.effects[0].shape_deviations[0] / deviations[p], 1.0, 0.02);
  EXPECT_GT(joint.effects[0].deviation, 1.05 * stop.found.effects[0].deviation)
      << "an edge that may move leaves the coefficient less certain";
}

}  // namespace
}  // namespace lacuna
