// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <chrono>

#include "lacuna/dynamics/integration/runge_kutta.hpp"
#include "lacuna/dynamics/integration/synchroniser.hpp"
#include "lacuna/dynamics/test_systems/measurement.hpp"
#include "lacuna/dynamics/test_systems/test_systems.hpp"

namespace lacuna {
namespace {

/// A context whose deadline comes when the given activity is reported for the n-th time.
void end_at(RunContext& context, const std::string& activity, int n) {
  context.progress = [&context, activity, left = n](const Progress& progress) mutable {
    if (progress.activity == activity && --left == 0)
      context.deadline = std::chrono::steady_clock::now();
  };
}

TEST(Synchroniser, PastTheDeadlineTheSlavesStayAndTheRestIsLeftOut) {
  const TestSystem& system = test_system("rossler");
  const Dataset record = record_of(system.model, Dopri8{}, system.start, 0.1, 500);
  const Vector noise = Vector::Constant(3, 0.01);
  RunContext context;
  end_at(context, "synchronising", 2);  // the second slave shows the response to noise
  const SyncResult cut = synchronise(system.model, record, Rk4{}, {.noise = noise}, context);
  const SyncResult whole = synchronise(system.model, record, Rk4{}, {.noise = noise});
  EXPECT_EQ(cut.median, whole.median);
  EXPECT_EQ(cut.response, Vector::Zero(3));
  EXPECT_GT(whole.response.maxCoeff(), 0.0);
  EXPECT_EQ(cut.stages.front().name, "slaves");
  EXPECT_TRUE(cut.stages.front().done);
  EXPECT_NE(left_out_line(cut.stages), "");
  EXPECT_EQ(left_out_line(whole.stages), "");
  RunContext at_once;
  end_at(at_once, "synchronising", 1);
  EXPECT_THROW(synchronise(system.model, record, Rk4{}, {.noise = noise}, at_once), OutOfTime);
}

}  // namespace
}  // namespace lacuna
