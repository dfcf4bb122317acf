// SPDX-License-Identifier: MIT
#include "trajectories/windows/window_groups.hpp"

#include <gtest/gtest.h>

#include "trajectories/shooting/shooting_problem.hpp"
#include "unit/trajectories/shooting/records.hpp"

namespace lacuna {
namespace {

/// A long record, which is simulated in several groups of windows.
ShootingProblem long_problem(int threads) {
  return {with_free_coefficients(test_system("van-der-pol").model),
          testing::noisy_record("van-der-pol", 9000, 0.01), std::nullopt, threads};
}

/// What a problem makes of windows of 45 samples that begin where the record was measured.
struct Made {
  explicit Made(ShootingProblem& problem) : plan(equal_windows(problem.record().begins, 45)) {
    point.parameters = 1.01 * problem.model().values();
    point.starts = Matrix(static_cast<Index>(plan.size()), 2);
    for (std::size_t w = 0; w < plan.size(); ++w)
      point.starts.row(static_cast<Index>(w)) = problem.record().values.row(plan[w].first);
    problem.evaluate(plan, point);
    linear = problem.linearise(plan, point);
  }

  WindowPlan plan;
  ShootingPoint point;
  ShootingLinearisation linear;
};

TEST(WindowGroups, ResultsDoNotDependOnTheNumberOfThreads) {
  ShootingProblem one = long_problem(1);
  const Made alone(one);
  ASSERT_EQ(alone.plan.size(), 200u);
  for (const int threads : {2, 3}) {
    ShootingProblem several = long_problem(threads);
    const Made shared(several);
    EXPECT_EQ(shared.point.orbits.samples, alone.point.orbits.samples);
    EXPECT_EQ(shared.point.cost, alone.point.cost);
    EXPECT_EQ(shared.linear.reduced, alone.linear.reduced);
    EXPECT_EQ(shared.linear.transitions, alone.linear.transitions);
    ASSERT_EQ(shared.linear.windows.size(), alone.linear.windows.size());
    for (std::size_t w = 0; w < alone.linear.windows.size(); ++w)
      EXPECT_EQ(shared.linear.windows[w], alone.linear.windows[w]) << w;
  }
}

TEST(WindowGroups, AreWhatOneWindowAloneIs) {
  ShootingProblem problem = long_problem(2);
  const Made all(problem);
  for (const std::size_t w : {std::size_t{0}, std::size_t{77}, std::size_t{199}}) {
    const WindowPlan plan{all.plan[w]};
    ShootingPoint point{all.point.parameters, all.point.starts.row(static_cast<Index>(w))};
    problem.evaluate(plan, point);
    const auto rows = Eigen::seqN(plan[0].first, plan[0].samples);
    EXPECT_LT(
        (point.orbits.samples(rows, Eigen::all) - all.point.orbits.samples(rows, Eigen::all))
            .norm(),
        1e-10)
        << w;
    const ShootingLinearisation linear = problem.linearise(plan, point);
    const Matrix& r = linear.windows.front();
    const Matrix& of_all = all.linear.windows[w];
    EXPECT_LT((r.transpose() * r - of_all.transpose() * of_all).norm(), 1e-9 * r.squaredNorm())
        << w;
  }
}

}  // namespace
}  // namespace lacuna
