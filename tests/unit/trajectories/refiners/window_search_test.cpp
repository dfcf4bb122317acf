// SPDX-License-Identifier: MIT
// The search by quasilinearisation against the trajectory fit, which simulates.
#include "trajectories/refiners/window_search.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "bases/monomials.hpp"
#include "support/noisy_records.hpp"
#include "trajectories/shooting/shooting_fit.hpp"
#include "trajectories/subset_selection/subset_problem.hpp"

namespace lacuna {
namespace {

const RunContext kNoLimits;

/// A search among cubic monomials.
struct SearchCase {
  SearchCase(const OdeModel& model, const Dataset& record, std::optional<double> penalty = {},
             int degree = 3)
      : data(record),
        library(Monomials{{.max_degree = degree}}.library(model.variables())),
        task(search_task(data, {library}, analyse_noise(data), {.penalty = penalty})),
        search(begun(task, prepared_search(task),
                     Matrix::Zero(data.state_count(), library.size()), kNoLimits)) {}

  bool grow() { return lacuna::grow(task, search, kNoLimits); }

  /// The model with the terms and coefficients of the search.
  OdeModel found() const {
    std::vector<Equation> equations(data.states.size());
    for (const Index c : search.fit.subset) {
      const Coefficient place = search.fit.columns[static_cast<std::size_t>(c)];
      equations[static_cast<std::size_t>(place.equation)].push_back(
          {library.terms[static_cast<std::size_t>(place.term)],
           search.fit.coefficients(place.equation, place.term)});
    }
    return {data.states, data.inputs, equations};
  }

  Dataset data;
  TermLibrary library;
  SearchTask task;
  WindowSearch search;
};

/// Windows of so many samples; the rest joins the last one.
WindowPlan plan_of(Index n, Index samples) {
  WindowPlan plan;
  for (Index first = 0; first + samples <= n; first += samples)
    plan.push_back({first, samples, samples});
  plan.back().samples = n - plan.back().first;
  plan.back().intervals = plan.back().samples - 1;
  return plan;
}

/// The least squares of the simulated model in the same windows with the same noise.
ShootingFit shot(ShootingProblem& problem, const WindowFit& fit) {
  problem.set_sigma(fit.sigma);
  problem.set_scheme({&prince_dormand_87(), 1});
  ShootingFit best;
  best.plan = plan_of(problem.record().samples(), fit.samples);
  best.point.parameters = problem.model().values();
  best.point.starts = starts_of(best.plan, problem.record().values);
  minimise(problem, best, 1e-10, 50, kNoLimits);
  return best;
}

TEST(WindowSearch, EndsAtTheLeastSquaresOfTheSimulatedModel) {
  const OdeModel& model = test_system("van-der-pol").model;
  SearchCase c(model, noisy_record("van-der-pol", 500, 0.02, 1));
  ASSERT_TRUE(c.search.fit.rows > 0);
  while (c.grow()) {
  }
  finish(c.search, kNoLimits);
  ASSERT_EQ(structure_of(c.found()), structure_of(model)) << to_text(c.found(), 4);
  const WindowFit& fit = c.search.fit;
  ShootingProblem problem(with_free_coefficients(c.found()), c.data, std::nullopt);
  const ShootingFit best = shot(problem, fit);
  ASSERT_TRUE(best.converged);
  const Index p = best.point.parameters.size();
  const Vector error =
      covariance_of(best.linear.reduced.topLeftCorner(p, p)).diagonal().cwiseSqrt();
  const Vector found = with_free_coefficients(c.found()).values();
  EXPECT_LT((found - best.point.parameters).cwiseQuotient(error).cwiseAbs().maxCoeff(), 0.02);

  const auto windows = static_cast<Index>(best.plan.size());
  EXPECT_EQ(fit.rows, 2 * 500 - 2 * windows) << "initial states are eliminated";
  const double freedom = static_cast<double>(fit.rows - p);
  EXPECT_NEAR(fit.misfit, best.point.cost / freedom, 1e-3 * fit.misfit);
  const Matrix r = problem.residuals(best.plan, best.point);
  for (Index k = 0; k < 2; ++k)
    EXPECT_NEAR(fit.rms[k],
                fit.sigma[k] * std::sqrt(r.col(k).squaredNorm() / (freedom * 500.0 / 1000.0)),
                1e-3 * fit.rms[k]);
}

TEST(WindowSearch, WindowsOfChaosEndWhereRoundingKeepsPathsFromRest) {
  SearchCase c(test_system("lorenz").model, noisy_record("lorenz", 5000, 0.01, 4), {}, 2);
  ASSERT_TRUE(c.search.fit.rows > 0);
  while (c.grow()) {
  }
  const WindowFit& fit = c.search.fit;
  EXPECT_TRUE(c.search.limited);
  EXPECT_LT(4 * fit.samples, 5000) << "the record has longer windows";
  EXPECT_LT(fit.rounding.worst, 1e-3);
  // Published: Lorenz' largest exponent is 0.906; in so few turns it is known to a fifth.
  const double time = mean_step(c.data.trajectories.front()) *
                      static_cast<double>(fit.samples - c.search.shorter.samples);
  const double exponent = (fit.rounding.log_mean - c.search.shorter.log_mean) / time;
  EXPECT_NEAR(exponent, 0.906, 0.2);
  EXPECT_EQ(structure_of(c.found()), structure_of(test_system("lorenz").model));
}

/// Whether a subset holds another one.
bool holds(const std::vector<Index>& all, const std::vector<Index>& some) {
  return std::includes(all.begin(), all.end(), some.begin(), some.end());
}

TEST(WindowSearch, SimplifyingTakesTermsAwayAsFarAsTheSlackGoes) {
  const OdeModel& model = test_system("van-der-pol").model;
  SearchCase c(model, noisy_record("van-der-pol", 400, 0.02, 1));
  ASSERT_TRUE(c.search.fit.rows > 0);
  const std::vector<Index> all = c.search.fit.subset;
  WindowSearch none = c.search, some = c.search, most = c.search;
  simplify(c.task, none, 0.0, kNoLimits);
  EXPECT_EQ(none.fit.subset, all);
  simplify(c.task, most, 1e9, kNoLimits);
  EXPECT_EQ(most.fit.subset.size(), 2u) << "each equation keeps its last term";
  const SubsetProblem problem = subset_problem(c.search.fit.triangle);
  simplify(c.task, some, 1.0, kNoLimits);
  EXPECT_TRUE(holds(all, some.fit.subset));
  EXPECT_LT(fit_subset(problem, some.fit.subset).residual,
            1.05 * 4.0 * fit_subset(problem, all).residual);
}

}  // namespace
}  // namespace lacuna
