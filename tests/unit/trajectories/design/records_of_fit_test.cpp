// SPDX-License-Identifier: MIT
// What records determine, and promised intervals against fits of simulated records.
#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.hpp"
#include "lacuna/data/derivatives/finite_differences.hpp"
#include "lacuna/model/files/ode_text.hpp"
#include "lacuna/records/binding/model_view.hpp"
#include "lacuna/trajectories/design/plan.hpp"
#include "trajectories/design/evidence.hpp"

namespace lacuna {
namespace {

/// x' = -k x + u from a known start, so that k is all that is estimated.
SystemModel decay(double k) {
  return parse_ode_system("input u hold zero\nparam k = " + std::to_string(k) +
                              " in 0.01..9\ndx/dt = -k*x + u\nfixed dx/dt: u\ny = x\n"
                              "initial x = 1 fixed\n",
                          "decay");
}

/// With u = 0: y = exp(-k t) with noise.
Dataset record(double k, double noise, std::uint64_t seed) {
  Random random(seed);
  Dataset data;
  data.states = {{"y", ""}};
  data.inputs = {{"u", "", Hold::Zero}};
  Trajectory run{"r", Vector::LinSpaced(41, 0.0, 4.0), Matrix(41, 1), Matrix::Zero(41, 1),
                 Matrix()};
  for (Index i = 0; i < 41; ++i)
    run.states(i, 0) = std::exp(-k * run.time[i]) + noise * random.normal();
  data.trajectories = {std::move(run)};
  return data;
}

TEST(InformationOf, IsThatOfTheFormula) {
  const Dataset data = model_view(decay(1.0).model(), record(0.7, 0.02, 3),
                                  FiniteDifferences{});
  const Fit found = fit(decay(1.0), data, {});
  const Matrix information = information_of(found, data);
  ASSERT_EQ(information.size(), 1);
  const double k = found.model.parameters().at(0).value, rmse = found.quality.at(0).rmse;
  double sum = 0.0;  // of (dy/dk)^2 = t^2 exp(-2 k t)
  for (const double t : data.trajectories[0].time) sum += t * t * std::exp(-2.0 * k * t);
  EXPECT_NEAR(information(0, 0) * rmse * rmse / sum, 1.0, 1e-3);
}

TEST(ExperimentsOf, AreTheRecords) {
  const Dataset data = model_view(decay(1.0).model(), record(0.7, 0.02, 3),
                                  FiniteDifferences{});
  const Fit found = fit(decay(1.0), data, {});
  PlanProblem problem;
  problem.inputs = {{"u", 0.0, 1.0}};
  problem.channels = {{"y", 0.02}};
  const std::vector<Experiment> made = experiments_of(found, data, problem);
  ASSERT_EQ(made.size(), 1u);
  EXPECT_EQ(made[0].time, data.trajectories[0].time);
  EXPECT_EQ(made[0].inputs.rows(), 41);
  ASSERT_EQ(made[0].starts.size(), 1u);
  EXPECT_EQ(made[0].starts[0].low, 1.0);
  problem.inputs[0].name = "w";
  EXPECT_THROW(experiments_of(found, data, problem), ArgumentError);
}

/// A run without input, so that it is known before it is planned.
PlanProblem free_decay(double information) {
  PlanProblem problem;
  problem.models = {{"decay", decay(0.7), Matrix::Constant(1, 1, information)}};
  problem.inputs = {{"u", 0.0, 1e-9}};
  problem.channels = {{"y", 0.02}};
  problem.duration = 4.0;
  problem.step = 0.1;
  return problem;
}

double promised_error(const PlanProblem& problem, int draws) {
  PlanOptions options;
  options.candidates = 1;
  options.searches = 1;
  options.evaluations = 1;
  options.draws = draws;
  const Plan plan = plan_experiment(problem, options);
  return plan.parameters.at(0).after.value_or(NAN);
}

TEST(ParameterPromise, IsTheSpreadOfFits) {
  constexpr double kKnown = 1e4;  // so that draws do not differ
  const double promised = promised_error(free_decay(kKnown), 8);
  constexpr int kDraws = 60;
  double squares = 0.0;
  for (int draw = 0; draw < kDraws; ++draw) {
    const Dataset data =
        model_view(decay(1.0).model(), record(0.7, 0.02, 100 + std::uint64_t(draw)),
                   FiniteDifferences{});
    const Fit found = fit(decay(0.7), data, {}, {.restarts = 0});
    squares += std::pow(found.model.parameters().at(0).value - 0.7, 2);
  }
  // The record is added to what is known; the deviation of 60 draws is known to 9 %, 25 % are
  // nearly three times that.
  const double together = 1.0 / std::sqrt(kKnown + kDraws / squares);
  EXPECT_NEAR(together / promised, 1.0, 0.25);
}

/// d/dk of exp(-k t) at the 41 samples, over the noise.
double information_at(double k) {
  double sum = 0.0;
  for (int i = 0; i <= 40; ++i) sum += std::pow(0.1 * i * std::exp(-k * 0.1 * i) / 0.02, 2);
  return sum;
}

TEST(ParameterPromise, IsAMeanOverWhatIsPossible) {
  // A rate known to 0.2: a fast decay shows less of its rate than a slow one.
  constexpr double kKnown = 25.0;
  const double promised = promised_error(free_decay(kKnown), 4000);
  double sum = 0.0, weights = 0.0;
  for (double z = -4.0; z <= 4.0; z += 0.01) {
    // What is taken where nothing is known, half of 0.7, adds its part.
    const double k = 0.7 + z / std::sqrt(kKnown + 1.0 / (0.35 * 0.35));
    const double weight = std::exp(-0.5 * z * z);
    sum += weight / (kKnown + information_at(k));
    weights += weight;
  }
  const double expected = std::sqrt(sum / weights);
  EXPECT_NEAR(promised, expected, 0.02 * expected);
  EXPECT_GT(expected, 1.04 / std::sqrt(kKnown + information_at(0.7))) << "more than there";
}

}  // namespace
}  // namespace lacuna
