// SPDX-License-Identifier: MIT
#include "trajectories/fit/population/marginal_likelihood.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <limits>
#include <numbers>

#include "support/populations.hpp"
#include "trajectories/fit/fit_steps.hpp"
#include "trajectories/fit/population/record_mode.hpp"
#include "trajectories/fit/population/smooth_minimum.hpp"

namespace lacuna {
namespace {

/// A model with its records, ready for a likelihood.
struct Population {
  Population(const SystemModel& system, const Dataset& data)
      : model(system.parametrised()),
        engine(fit_engine(model, fit_records(model, data))),
        problem(population_problem(system, engine, fit_unknowns(model, {}))),
        start{model.values().transpose().replicate(engine.records.records(), 1),
              engine.records.starts} {}

  PopulationState at(const Vector& parameters, const Vector& spreads, const Vector& sizes) {
    return population_at(engine, problem, {parameters, spreads, sizes},
                         first_guesses(problem, start));
  }

  ParametrisedModel model;
  FitEngine engine;
  PopulationProblem problem;
  FitPoint start;
};

/// -2 log of a multivariate normal density.
double normal_loss(const Vector& residual, const Matrix& covariance) {
  const Eigen::LLT<Matrix> root(covariance);
  return static_cast<double>(residual.size()) * std::log(2.0 * std::numbers::pi) +
         2.0 * Matrix(root.matrixL()).diagonal().array().log().sum() +
         residual.dot(root.solve(residual));
}

// y = b + a t with normal b and a: each record is normal with the mean b0 + a0 t and the
// covariance sigma^2 I + w_b^2 1 1' + w_a^2 t t' (Laird and Ware, Biometrics 38:963-974, 1982).
TEST(MarginalLikelihood, IsThatOfTheLinearMixedModel) {
  const SystemModel system = support::line_model();
  const Dataset data = support::lines(system, 6, 0.5, 0.3, 0.1, 1);
  Population population(system, data);
  const PopulationState found =
      population.at(Vector{{2.1, 0.9}}, Vector{{0.45, 0.35}}, Vector{{0.12}});
  double expected = 0.0;
  ASSERT_EQ(data.trajectories.size(), 6u);
  for (std::size_t r = 0; r < 6; ++r) {
    const Trajectory& record = data.trajectories[r];
    const Vector& t = record.time;
    const Vector ones = Vector::Ones(t.size());
    const Matrix covariance = 0.12 * 0.12 * Matrix::Identity(t.size(), t.size()) +
                              0.45 * 0.45 * ones * ones.transpose() +
                              0.35 * 0.35 * t * t.transpose();
    const Vector y = population.engine.records.values.col(0).segment(
        population.engine.records.first(static_cast<Index>(r)), t.size());
    const double own = normal_loss(y - 2.1 * ones - 0.9 * t, covariance);
    EXPECT_NEAR(-2.0 * found.log_likelihood(r), own, 1e-6) << r;
    expected += own;
  }
  EXPECT_NEAR(found.loss, expected, 1e-6);
}

// exp(-k t) with a lognormal k is no normal: Laplace's approximation beside the sum over a fine
// grid of z, which is exact to 1e-10.
TEST(MarginalLikelihood, IsNearTheIntegralWhereTheModelIsNotLinear) {
  const SystemModel system = parse_ode_system(
      "param k = 0.5 varies */ 1.3\ndx/dt = -k*x\ny = x\ninitial x = 3 fixed\n", "decay.ode");
  const Dataset data = support::individuals(
      system, 5, sample_times(0.0, 0.5, 9), 3, [](Random& random) {
        const double k = 0.5 * std::exp(0.3 * random.normal());
        return [=](double t, Random& each) {
          return 3.0 * std::exp(-k * t) + 0.15 * each.normal();
        };
      });
  Population population(system, data);
  set_substeps(population.engine, 8);
  const PopulationState found =
      population.at(Vector{{0.5}}, Vector{{std::log(1.3)}}, Vector{{0.15}});
  const FitRecords& records = population.engine.records;
  ASSERT_EQ(records.records(), 5);
  for (Index r = 0; r < records.records(); ++r) {
    constexpr double kStep = 0.01;
    double integral = 0.0;
    for (double z = -8.0; z <= 8.0; z += kStep) {
      const double k = 0.5 * std::exp(std::log(1.3) * z);
      double log_density = -0.5 * z * z - 0.5 * std::log(2.0 * std::numbers::pi);
      for (Index n = records.first(r); n < records.end(r); ++n) {
        const double residual =
            (records.values(n, 0) - 3.0 * std::exp(-k * records.series.time[n])) / 0.15;
        log_density -= 0.5 * (std::log(2.0 * std::numbers::pi * 0.15 * 0.15) +
                              residual * residual);
      }
      integral += kStep * std::exp(log_density);
    }
    EXPECT_NEAR(found.log_likelihood(static_cast<std::size_t>(r)), std::log(integral), 0.05);
  }
}

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
  const RecordMode mode = find_mode(engine, problem, values, 1, Vector::Zero(2), point, path);
  const Vector t = data.trajectories[1].time;
  Matrix z(t.size(), 2);
  z << 0.4 * Vector::Ones(t.size()), 0.25 * t;
  const Vector residual =
      engine.records.values.col(0).segment(8, 8).array() - 2.1 - 0.9 * t.array();
  const Matrix normal = z.transpose() * z + 0.04 * Matrix::Identity(2, 2);
  const Vector expected = normal.ldlt().solve(z.transpose() * residual);
  EXPECT_TRUE(mode.own.isApprox(expected, 1e-8)) << mode.own << "\n" << expected;
  EXPECT_TRUE(mode.covariance.isApprox(0.04 * normal.inverse(), 1e-8));
  EXPECT_NEAR(mode.log_determinant, std::log((normal / 0.04).determinant()), 1e-8);
  EXPECT_NEAR(point.parameters(1, 0), 2.1 + 0.4 * expected[0], 1e-8);
}

// Far from the mode, of a model that is not linear, by noise that depends on it: no neighbour
// is more probable.
TEST(RecordMode, IsAMaximumFromFarAway) {
  const SystemModel system = parse_ode_system(
      "param k = 0.5 varies */ 2\nparam s = 3 varies */ 1.5\ndx/dt = -k*x\n"
      "y = s*x noise both\ninitial x = 1 fixed\n",
      "decay.ode");
  const Dataset data =
      support::individuals(system, 2, sample_times(0.0, 0.5, 12), 3, [](Random&) {
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

constexpr double kNone = std::numeric_limits<double>::infinity();

SmoothTask from(const Vector& start) {
  return {start, Matrix::Identity(start.size(), start.size()),
          Vector::Constant(start.size(), -kNone), Vector::Constant(start.size(), kNone)};
}

// Rosenbrock's valley (Computer J. 3:175-184, 1960): its minimum is (1, 1).
const auto valley = [](const Vector& x) {
  return std::pow(1.0 - x[0], 2) + 100.0 * std::pow(x[1] - x[0] * x[0], 2);
};

TEST(SmoothMinimum, FollowsACurvedValley) {
  int moves = 0;
  const SmoothMinimum found =
      minimise_smooth(valley, [&](const Vector&) { ++moves; }, from(Vector{{-1.2, 1.0}}), {});
  EXPECT_TRUE(found.converged);
  EXPECT_NEAR(found.place[0], 1.0, 1e-3);
  EXPECT_NEAR(found.place[1], 1.0, 1e-3);
  EXPECT_LT(found.value, 1e-6);
  EXPECT_GT(moves, 5);
}

TEST(SmoothMinimum, StaysInRangesAndAtWhatIsHeld) {
  SmoothTask task = from(Vector{{0.2, 0.0, 5.0}});
  task.upper[0] = 0.5;
  task.lower[2] = task.upper[2] = 5.0;
  const SmoothMinimum found =
      minimise_smooth([](const Vector& x) { return valley(x.head(2)) + std::pow(x[2], 2); },
                      [](const Vector&) {}, task, {});
  EXPECT_TRUE(found.converged);
  EXPECT_DOUBLE_EQ(found.place[0], 0.5);
  EXPECT_NEAR(found.place[1], 0.25, 1e-4) << "least of the valley at x = 0.5";
  EXPECT_DOUBLE_EQ(found.place[2], 5.0);
}

TEST(SmoothMinimum, ComesBackFromWhereThereIsNoValue) {
  // -log x + x has its minimum at 1; beyond 0 it has no value.
  const SmoothMinimum found = minimise_smooth(
      [](const Vector& x) { return x[0] > 0.0 ? x[0] - std::log(x[0]) : kNone; },
      [](const Vector&) {}, from(Vector{{6.0}}), {});
  EXPECT_TRUE(found.converged);
  EXPECT_NEAR(found.place[0], 1.0, 1e-3);
}

TEST(SmoothMinimum, SecondDerivativesOfAQuadraticAreExact) {
  const Matrix expected{{4.0, 1.0, 0.0}, {1.0, 3.0, 0.0}, {0.0, 0.0, 0.0}};
  const Matrix found = second_derivatives(
      [&](const Vector& x) { return 0.5 * x.dot(expected * x) + 2.0 * x[0] + x[2] * x[2]; },
      Vector{{0.3, -0.2, 1.0}}, Vector{{0.1, 0.2, 0.0}}, {});
  EXPECT_TRUE(found.isApprox(expected, 1e-10)) << found;
}

}  // namespace
}  // namespace lacuna
