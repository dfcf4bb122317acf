// SPDX-License-Identifier: MIT
#include "trajectories/fit/population/marginal_likelihood.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <numbers>

#include "support/populations.hpp"

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

}  // namespace
}  // namespace lacuna
