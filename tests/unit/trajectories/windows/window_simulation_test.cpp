// SPDX-License-Identifier: MIT
#include "trajectories/windows/window_simulation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "lacuna/dynamics/integration/simulate.hpp"
#include "trajectories/shooting/shooting_problem.hpp"
#include "unit/trajectories/shooting/records.hpp"

namespace lacuna {
namespace {

/// Windows of unequal lengths over a record that nothing drives.
struct Windows {
  Dataset data = testing::noisy_record("van-der-pol", 100, 0.01);
  ParametrisedModel model = with_free_coefficients(test_system("van-der-pol").model);
  ShootingProblem problem{model, data, std::nullopt};  // whose signals are those of one step
  WindowPlan plan{{0, 10, 10},  {10, 40, 40}, {50, 3, 3},
                  {53, 20, 20}, {73, 12, 12}, {85, 15, 14}};
  Matrix starts = data.trajectories[0].states({0, 10, 50, 53, 73, 85}, Eigen::all);

  Orbits simulated(const WindowRange& range) {
    WindowSimulator simulator(problem.signals(), 2);
    Orbits orbits;
    make_room(problem.signals(), 2, 100, orbits);
    orbits.samples.setConstant(-7.0);
    simulator.run(problem.rates(), plan, range, starts, orbits);
    return orbits;
  }
};

TEST(WindowSimulator, FollowsTheModelFromEachStart) {
  Windows windows;
  windows.problem.rates().set(windows.model.values());
  const Orbits orbits = windows.simulated({0, 6});
  const double step = test_system("van-der-pol").step;
  ASSERT_FALSE(windows.plan.empty());
  for (std::size_t w = 0; w < windows.plan.size(); ++w) {
    const Window& window = windows.plan[w];
    const Solution alone =
        simulate(windows.model.model(), Rk4(), windows.starts.row(static_cast<Index>(w)),
                 sample_times(0.0, step, window.samples));
    EXPECT_LT((orbits.samples.middleRows(window.first, window.samples) - alone.states)
                  .cwiseAbs()
                  .maxCoeff(),
              1e-10)
        << w;
  }
}

TEST(WindowSimulator, WritesTheWindowsOfItsRangeOnly) {
  Windows windows;
  windows.problem.rates().set(windows.model.values());
  const Orbits all = windows.simulated({0, 6}), some = windows.simulated({1, 2});
  EXPECT_TRUE((some.samples.topRows(10).array() == -7.0).all());
  EXPECT_TRUE((some.samples.bottomRows(47).array() == -7.0).all());
  EXPECT_LT((some.samples.middleRows(10, 43) - all.samples.middleRows(10, 43)).norm(), 1e-12);
}

TEST(DivergedWindows, AreThoseWithAStateThatIsNoNumber) {
  Windows windows;
  windows.problem.rates().set(windows.model.values());
  Orbits orbits = windows.simulated({0, 6});
  EXPECT_TRUE(diverged_windows(windows.plan, orbits).empty());
  orbits.samples(52, 1) = INFINITY;
  orbits.samples(99, 0) = NAN;
  EXPECT_EQ(diverged_windows(windows.plan, orbits), (std::vector<Index>{2, 5}));
}

}  // namespace
}  // namespace lacuna
