// SPDX-License-Identifier: MIT
#include "trajectories/shooting/window_search.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "trajectories/shooting/confidence.hpp"
#include "unit/trajectories/shooting/records.hpp"

namespace lacuna {
namespace {

/// A pendulum without the term w^3 that its record has.
struct InexactCase {
  InexactCase() : problem(lacking(), record(), std::nullopt) {
    problem.set_sigma(0.001 * Vector::Ones(2));
    growth.dimension = 2;
    fit = fit_of(equal_windows(problem.record().begins, 25));
    growth.transitions = fit.linear.transitions;
  }

  static const TestSystem& system() { return test_system("pendulum"); }

  static ParametrisedModel lacking() {
    return with_free_coefficients(system().model, {true, false});
  }

  static Dataset record() {
    const OdeModel truth =
        system().model.with_term(1, {Term::parse("w^3", system().model.variables()), -0.01});
    return add_relative_noise(testing::clean_record(truth, system(), 800), 0.001, 1);
  }

  ShootingFit fit_of(const WindowPlan& plan) {
    ShootingFit made;
    made.plan = plan;
    made.point.parameters = problem.model().values();
    made.point.starts = starts_of(plan, problem.record().values);
    minimise(problem, made, 1e-3, 50, {});
    return made;
  }

  InexactWindows search() const { return {growth, 1e6, 4, 1e-3, 50}; }

  ShootingProblem problem;
  ErrorGrowth growth;
  ShootingFit fit;
};

Index longest_of(const WindowPlan& plan) {
  Index longest = 0;
  for (const Window& window : plan) longest = std::max(longest, window.samples);
  return longest;
}

/// Mean log standard error by the gradients of blocks.
double score_of(const ShootingFit& fit) {
  const Index p = fit.point.parameters.size();
  const Matrix r = fit.linear.reduced.topLeftCorner(p, p);
  const auto covariance = block_covariance(fit.linear.windows, (r.transpose() * r).inverse());
  return covariance ? 0.5 * covariance->diagonal().array().log().mean() : 1e300;
}

TEST(WindowSearch, NoOtherLengthKnowsTheParametersMuchBetter) {
  InexactCase c;
  const ShootingFit found = search_windows(c.problem, c.fit, c.search(), {});
  EXPECT_TRUE(found.point.finite);
  // One standard error of the mean log standard error over 30 blocks.
  const auto parameters = static_cast<double>(c.problem.model().size());
  const double margin = 1.0 / std::sqrt(2.0 * 30.0 * parameters);
  const Index samples = longest_of(found.plan);
  for (const Index other : {samples / 2, samples, 2 * samples}) {
    if (other < 4) continue;
    const ShootingFit fit = c.fit_of(equal_windows(c.problem.record().begins, other));
    EXPECT_GT(score_of(fit), score_of(found) - margin - 0.05) << other << " of " << samples;
  }
}

TEST(WindowSearch, TwiceAsLongWindowsKnowTheParametersLessWell) {
  InexactCase c;
  const double margin =
      1.0 / std::sqrt(2.0 * 30.0 * static_cast<double>(c.problem.model().size()));
  for (Index length = 26; length <= 46; length += 2) {
    const ShootingFit start = c.fit_of(equal_windows(c.problem.record().begins, length));
    const ShootingFit found = search_windows(c.problem, start, c.search(), {});
    Index limit = longest_of(start.plan);  // twofold steps from there are what was tried
    while (limit / 2 >= longest_of(found.plan)) limit /= 2;
    while (limit < longest_of(found.plan)) limit *= 2;
    const WindowPlan twice = plan_windows(c.problem.record().begins, c.growth,
                                          {c.search().largest_growth, 1e300, 4, 2 * limit});
    EXPECT_GT(score_of(c.fit_of(twice)), score_of(found) + margin - 0.005)
        << 2 * limit << " samples for " << longest_of(found.plan) << ", from " << length;
  }
}

}  // namespace
}  // namespace lacuna
