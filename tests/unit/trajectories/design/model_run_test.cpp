// SPDX-License-Identifier: MIT
#include "trajectories/design/model_run.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "lacuna/model/files/ode_text.hpp"

namespace lacuna {
namespace {

/// x' = -k x + u with x(0) = 1 +- 0.1 and two channels: x and 2 k x, noise 0.1 and 0.5.
PlanProblem decay_problem() {
  PlanProblem all;
  all.models = {{"m", parse_ode_system("input u hold zero\nparam k = 0.5 in 0..9\n"
                                       "dx/dt = -k*x + u\nfixed dx/dt: u\ny = x\nz = 2*k*x\n"
                                       "initial x = 1\n",
                                       "m")}};
  all.inputs = {{"u", 0.0, 1.0}};
  all.starts = {{"x", 1.0, 1.0, 0.1}};
  all.channels = {{"y", 0.1}, {"z", 0.5}};
  all.safe = {{"x", 0.0, 2.0}};
  return all;
}

/// u = 0 at 0, 1 and 2, where z is measured only.
Experiment decay_run() {
  Experiment one{Vector::LinSpaced(3, 0.0, 2.0), Matrix::Zero(3, 1), Matrix::Ones(3, 2),
                 decay_problem().starts};
  one.measured(2, 0) = 0.0;
  return one;
}

TEST(Predict, ValuesAreInUnitsOfTheirNoise) {
  const PlanProblem all = decay_problem();
  ModelRun run = model_run(all.models[0], all);
  choose_steps(run, {decay_run()});
  load(run, decay_run());
  const Prediction found = predict(run, decay_run(), {run.values, {}});
  ASSERT_EQ(found.values.size(), 5);
  const double one = std::exp(-0.5), two = std::exp(-1.0);
  Vector expected(5);
  expected << 1.0 / 0.1, 1.0 / 0.5, one / 0.1, one / 0.5, two / 0.5;
  EXPECT_LT((found.values - expected).cwiseAbs().maxCoeff(), 0.1) << "a tenth of the noise";
  EXPECT_NEAR(found.safe(2, 0), two, 0.01);
  EXPECT_TRUE(found.is_finite);
  const Prediction other =
      predict(run, decay_run(), {Vector::Constant(1, 1.0), Vector::Constant(1, 2.0)});
  EXPECT_NEAR(other.channels(1, 0), 2.0 * std::exp(-1.0), 0.02);
}

TEST(Linearise, DerivativesAreThoseOfTheFormula) {
  const PlanProblem all = decay_problem();
  ModelRun run = model_run(all.models[0], all);
  set_substeps(run.engine, 16);
  load(run, decay_run());
  const LinearPrediction found = linearise(run, decay_run(), {run.values, {}});
  ASSERT_EQ(found.by_parameter.rows(), 5);
  ASSERT_EQ(found.by_start.cols(), 1);
  const double one = std::exp(-0.5);
  EXPECT_NEAR(found.by_parameter(2, 0), -one / 0.1, 1e-4) << "-t exp(-k t) / noise";
  EXPECT_NEAR(found.by_parameter(3, 0), 2.0 * (one - 0.5 * one) / 0.5, 1e-4);
  EXPECT_NEAR(found.by_start(2, 0), 0.1 * one / 0.1, 1e-4) << "in its deviation";
}

TEST(ModelRunOf, NamesThatAreNotThereAreErrors) {
  PlanProblem all = decay_problem();
  all.safe[0].name = "w";
  EXPECT_THROW(model_run(all.models[0], all), ArgumentError);
  all = decay_problem();
  all.models[0].system = parse_ode_system("dx/dt = -delay(x,1)\ny = x\nz = x\n", "delayed");
  EXPECT_THROW(model_run(all.models[0], all), ModelError);
}

}  // namespace
}  // namespace lacuna
