// SPDX-License-Identifier: MIT
#include "trajectories/fit/population/record_mode.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "support/populations.hpp"
#include "trajectories/fit/fit_steps.hpp"

namespace lacuna {
namespace {

// The mode of a linear model is the best linear unbiased prediction: with Z = [w_b 1, w_a t],
// z = (Z'Z + sigma^2 I)^-1 Z'(y - b0 - a0 t) (Laird and Ware, Biometrics 38:963-974, 1982).
TEST(RecordMode, IsTheBestLinearPrediction) {
  const SystemModel system = support::line_model();
  const Dataset data = support::lines(system, 3, 0.5, 0.3, 0.2, 1);
  const ParametrisedModel model = system.parametrised();
  FitEngine engine = fit_engine(model, fit_records(model, data));
  const PopulationProblem problem = population_problem(system, engine, fit_unknowns(model, {}));
  const PopulationValues values{Vector{{2.1, 0.9}}, Vector{{0.4, 0.25}}, Vector{{0.2}}};
  set_noise_sizes(problem.sizes, values.sizes, engine);
  FitPoint point{Matrix::Zero(3, 2), engine.records.starts};
  FitPath path = empty_path(engine);
  const RecordMode mode =
      find_mode(engine, problem, values, 1, Vector::Zero(2), point, path);
  const Vector t = data.trajectories[1].time;
  Matrix z(t.size(), 2);
  z << 0.4 * Vector::Ones(t.size()), 0.25 * t;
  const Vector residual = engine.records.values.col(0).segment(8, 8).array() - 2.1 -
                          0.9 * t.array();
  const Matrix normal = z.transpose() * z + 0.04 * Matrix::Identity(2, 2);
  const Vector expected = normal.ldlt().solve(z.transpose() * residual);
  EXPECT_TRUE(mode.own.isApprox(expected, 1e-8)) << mode.own << "\n" << expected;
  EXPECT_TRUE(mode.covariance.isApprox(0.04 * normal.inverse(), 1e-8));
  EXPECT_NEAR(mode.log_determinant, std::log((normal / 0.04).determinant()), 1e-8);
  EXPECT_NEAR(point.parameters(1, 0), 2.1 + 0.4 * expected[0], 1e-8);
}

// Far from the mode, of a model that is not linear, by noise that depends on it: no neighbour is
// more probable.
TEST(RecordMode, IsAMaximumFromFarAway) {
  const SystemModel system = parse_ode_system(
      "param k = 0.5 varies */ 2\nparam s = 3 varies */ 1.5\ndx/dt = -k*x\n"
      "y = s*x noise both\ninitial x = 1 fixed\n",
      "decay.ode");
  const Dataset data = support::individuals(
      system, 2, sample_times(0.0, 0.5, 12), 3, [](Random&) {
        return [](double t, Random& each) {
          return 5.0 * std::exp(-1.1 * t) * (1.0 + 0.1 * each.normal()) + 0.1;
        };
      });
  const ParametrisedModel model = system.parametrised();
  FitEngine engine = fit_engine(model, fit_records(model, data));
  set_substeps(engine, 4);
  const PopulationProblem problem = population_problem(system, engine, fit_unknowns(model, {}));
  const PopulationValues values{Vector{{0.5, 3.0}}, Vector{{0.69, 0.4}}, Vector{{0.05, 0.1}}};
  set_noise_sizes(problem.sizes, values.sizes, engine);
  FitPoint point{Matrix::Zero(2, 2), engine.records.starts};
  FitPath path = empty_path(engine);
  const auto loss_at = [&](const Vector& own) {
    place_own(problem, values, own, 0, point);
    follow_record(engine, point, {}, 0, path);
    return -2.0 * record_log_likelihood(engine, path, 0) + own.squaredNorm();
  };
  const RecordMode mode =
      find_mode(engine, problem, values, 0, Vector{{-3.0, 3.0}}, point, path);
  ASSERT_TRUE(std::isfinite(mode.loss));
  for (const double step : {-1e-3, 1e-3})
    for (Index i = 0; i < 2; ++i) {
      Vector own = mode.own;
      own[i] += step;
      EXPECT_GT(loss_at(own), mode.loss) << i << " " << step;
    }
}

}  // namespace
}  // namespace lacuna
