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

TEST(ParameterPromise, IsTheSpreadOfFits) {
  // The plan: 0 as the only input, so that its run is known beforehand.
  PlanProblem problem;
  problem.models = {{"decay", decay(0.7)}};
  problem.inputs = {{"u", 0.0, 1e-9}};
  problem.channels = {{"y", 0.02}};
  problem.duration = 4.0;
  problem.step = 0.1;
  PlanOptions options;
  options.candidates = 1;
  options.searches = 1;
  options.evaluations = 1;
  const Plan plan = plan_experiment(problem, options);
  ASSERT_EQ(plan.parameters.size(), 1u);
  ASSERT_TRUE(plan.parameters[0].after);
  constexpr int kDraws = 60;
  double squares = 0.0;
  for (int draw = 0; draw < kDraws; ++draw) {
    const Dataset data =
        model_view(decay(1.0).model(), record(0.7, 0.02, 100 + std::uint64_t(draw)),
                   FiniteDifferences{});
    const Fit found = fit(decay(0.7), data, {}, {.restarts = 0});
    squares += std::pow(found.model.parameters().at(0).value - 0.7, 2);
  }
  // The deviation of 60 draws is known to 9 %; 25 % are nearly three times that.
  EXPECT_NEAR(std::sqrt(squares / kDraws) / *plan.parameters[0].after, 1.0, 0.25);
}

}  // namespace
}  // namespace lacuna
