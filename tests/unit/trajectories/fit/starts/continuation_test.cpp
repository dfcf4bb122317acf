// SPDX-License-Identifier: MIT
#include "trajectories/fit/starts/continuation.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <utility>

#include "core/base/random.hpp"
#include "lacuna/data/derivatives/finite_differences.hpp"
#include "lacuna/dynamics/integration/runge_kutta.hpp"
#include "lacuna/dynamics/integration/simulate.hpp"
#include "lacuna/model/files/ode_text.hpp"
#include "lacuna/records/binding/model_view.hpp"
#include "lacuna/trajectories/fit/fit.hpp"

namespace lacuna {
namespace {

const char* const kLorenz =
    "param s = 12\nparam r = 24\nparam b = 3.2\n"
    "dx/dt = s*(y - x)\ndy/dt = x*(r - z) - y\ndz/dt = x*y - b*z\n";

/// Lorenz's oscillation every 0.01, with noise of 0.1.
Dataset lorenz(Index samples) {
  const OdeModel truth = parse_ode(
      "dx/dt = 10*y - 10*x\ndy/dt = 28*x - y - x*z\ndz/dt = x*y - 2.66666667*z\n", "t.ode");
  const Vector times = sample_times(0.0, 0.01, samples);
  Trajectory record{"lorenz", times,
                    simulate(truth, Rk4{}, Vector{{1.0, 2.0, 20.0}}, times).states,
                    Matrix(samples, 0), Matrix()};
  Random random(1);
  for (double& value : record.states.reshaped()) value += 0.1 * random.normal();
  Dataset data;
  data.states = truth.states();
  data.trajectories = {std::move(record)};
  return model_view(truth, data, FiniteDifferences{});
}

// Errors grow by exp(0.9 t): to 2e4 of those at the begin in 11.
TEST(Continuation, FollowsAChaoticModelFarBeyondTheTimeOfItsErrors) {
  const SystemModel model = parse_ode_system(kLorenz, "m.ode");
  for (const Index samples : {400, 700, 1100}) {
    const Fit found = fit(model, lorenz(samples), {});
    const double truths[] = {10.0, 28.0, 8.0 / 3.0};
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_NEAR(found.numbers[i].value, truths[i], 4e-3 * truths[i]) << samples;
      EXPECT_TRUE(found.numbers[i].standard_error);
    }
    ASSERT_EQ(found.quality.size(), 3u);
    for (const FitQuality& quality : found.quality) EXPECT_NEAR(quality.rmse, 0.1, 0.01);
  }
}

TEST(Continuation, AChaoticRecordThatNoFreeRunFollowsIsSaidToBeTooLong) {
  const SystemModel model = parse_ode_system(kLorenz, "m.ode");
  const Fit found = fit(model, lorenz(3000), {}, {.effort = Thoroughness::Quick});
  EXPECT_THAT(found.notes, ::testing::Contains(::testing::HasSubstr("so long a record")));
  ASSERT_EQ(found.quality.size(), 3u);
  for (const FitQuality& quality : found.quality) EXPECT_FALSE(quality.white);
}

}  // namespace
}  // namespace lacuna
