// SPDX-License-Identifier: MIT
#include "trajectories/fit/population/population_search.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/populations.hpp"

namespace lacuna {
namespace {

/// Levels y = m + b_i + noise, m = 1.7 and the spread of b given.
SystemModel level_model() {
  return parse_ode_system(
      "param m = 1 varies +- 0.5\ndx/dt = 0*x\ny = m + x\ninitial x = 0 fixed\n", "level.ode");
}

Dataset levels(const SystemModel& system, double spread, std::uint64_t seed) {
  return support::individuals(system, 9, sample_times(0.0, 1.0, 6), seed, [=](Random& random) {
    const double own = 1.7 + spread * random.normal();
    return [=](double, Random& each) { return own + 0.3 * each.normal(); };
  });
}

/// Everything that a search takes.
struct Search {
  explicit Search(const SystemModel& system, const Dataset& data)
      : model(system.parametrised()),
        engine(fit_engine(model, fit_records(model, data))),
        problem(population_problem(system, engine, fit_unknowns(model, {}))) {}
  PopulationMinimum run() {
    const FitPoint start{model.values().transpose().replicate(engine.records.records(), 1),
                         engine.records.starts};
    return search_population(engine, problem, start, false, {});
  }
  ParametrisedModel model;
  FitEngine engine;
  PopulationProblem problem;
};

/// Analysis of variance of balanced levels (Searle, Casella and McCulloch, Variance Components
/// (1992), Sect. 3.7): the estimates of the largest likelihood in closed form.
struct Levels {
  explicit Levels(const FitEngine& engine) {
    const Index records = engine.records.records(), n = engine.records.end(0);
    mean = engine.records.values.mean();
    for (Index r = 0; r < records; ++r) {
      const Vector own = engine.records.values.col(0).segment(engine.records.first(r), n);
      between += static_cast<double>(n) * std::pow(own.mean() - mean, 2);
      within += (own.array() - own.mean()).square().sum();
    }
    noise = within / static_cast<double>(records * (n - 1));
    spread = (between / static_cast<double>(records) - noise) / static_cast<double>(n);
    error = std::sqrt((noise + static_cast<double>(n) * spread) /
                      static_cast<double>(n * records));
  }
  double mean = 0.0, between = 0.0, within = 0.0;
  double noise, spread, error;  ///< variances, and the standard error of the mean
};

TEST(PopulationSearch, OfBalancedLevelsIsTheAnalysisOfVariance) {
  const SystemModel system = level_model();
  Search search(system, levels(system, 0.6, 1));
  const PopulationMinimum found = search.run();
  const Levels expected(search.engine);
  ASSERT_GT(expected.spread, 0.0);
  EXPECT_TRUE(found.converged);
  EXPECT_EQ(found.agreeing, 2);
  EXPECT_NEAR(found.values.parameters[0], expected.mean, 1e-5);
  EXPECT_NEAR(found.values.spreads[0], std::sqrt(expected.spread), 1e-5);
  EXPECT_NEAR(found.values.sizes[0], std::sqrt(expected.noise), 1e-5);
  const PopulationErrors errors =
      errors_of_population(search.engine, search.problem, found, {});
  EXPECT_NEAR(std::sqrt(errors.covariance(0, 0)), expected.error, 1e-3 * expected.error);
  // Variances of the estimates: noise 2 v^2 / (R (n-1)), n spread + noise 2 (.)^2 / R.
  const double total = expected.noise + 6.0 * expected.spread;
  const double variance = (2.0 * total * total / 9.0 +
                           2.0 * expected.noise * expected.noise / 45.0) / 36.0;
  EXPECT_NEAR(errors.covariance(1, 1), variance / (4.0 * expected.spread),
              0.05 * errors.covariance(1, 1));
  EXPECT_FALSE(errors.may_be_zero[0]);
}

}  // namespace
}  // namespace lacuna
