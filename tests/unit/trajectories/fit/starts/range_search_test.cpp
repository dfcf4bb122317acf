// SPDX-License-Identifier: MIT
#include "trajectories/fit/starts/range_search.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "core/base/random.hpp"
#include "data/derivatives/finite_differences.hpp"
#include "dynamics/integration/runge_kutta.hpp"
#include "lacuna/dynamics/integration/simulate.hpp"
#include "lacuna/model/files/model_file.hpp"
#include "lacuna/records/binding/model_view.hpp"
#include "lacuna/trajectories/fit/fit.hpp"
#include "support/grey_box.hpp"

namespace lacuna {
namespace {

Dataset record_of(const std::string& truth, double noise) {
  return support::grey_box(parse_ode(truth, "t.ode"), {.start = Vector::Constant(1, 1.0),
                                                       .step = 0.05,
                                                       .samples = 160,
                                                       .noise = noise});
}

TEST(RangeSearch, EndsWhenTheBestWasReachedAndNoOtherIsExpected) {
  EXPECT_FALSE(is_settled({}, 0.1));
  EXPECT_FALSE(is_settled({3.0, 3.0, 3.0}, 0.1)) << "one of three may hide another";
  EXPECT_TRUE(is_settled({3.0, 3.05, 3.0, 3.0, 3.0, 3.0}, 0.1));
  EXPECT_FALSE(is_settled({3.0, 3.0, 9.0, 9.0, 9.0, 9.0, 9.0, 9.0, 9.0, 9.0, 9.0, 9.0}, 0.1))
      << "the best was reached twice";
  // 2 (n - 1)/(n - 4) - 2 < 1 from n = 11 on.
  EXPECT_FALSE(is_settled({3.0, 3.0, 3.0, 9.0, 9.0, 9.0, 9.0, 9.0, 9.0, 9.0}, 0.1));
  EXPECT_TRUE(is_settled({3.0, 3.0, 3.0, 9.0, 9.0, 9.0, 9.0, 9.0, 9.0, 9.0, 9.0}, 0.1));
}

TEST(RangeSearch, FindsAFrequencyAmongManyMinima) {
  // The sum of squares of sin(w t) has a minimum about every pi/8 of w.
  const SystemModel model = parse_ode_system(
      "param w = 0.3 in 0.05..15\ndx/dt = w*cos(w*t)\ny = x\ninitial x = 1 fixed\n", "m.ode");
  Dataset record = record_of("dx/dt = -x\ny = x\n", 0.0);
  Random random(3);
  for (Index n = 0; n < record.samples(); ++n)
    record.trajectories[0].states(n, 0) =
        1.0 + std::sin(7.0 * record.trajectories[0].time[n]) + 0.04 * random.normal();
  const Fit one = fit(model, record, {}, {.restarts = 0, .starts = 0});
  EXPECT_GT(std::abs(one.numbers[0].value - 7.0), 1.0) << "the minimum beside the start";
  const Fit many = fit(model, record, {}, {.restarts = 0});
  EXPECT_NEAR(many.numbers[0].value, 7.0, 0.02);
  EXPECT_GT(many.log_likelihood, one.log_likelihood);
}

TEST(RangeSearch, AFitToTheNoiseTriesNoneAndOneMinimumNeedsFew) {
  const SystemModel model = parse_ode_system(
      "param k = 2 in 1e-3..1e3\ndx/dt = -k*x\ny = x\ninitial x = 1 fixed\n", "m.ode");
  const Dataset record = record_of("dx/dt = -0.5*x\ny = x\n", 0.02);
  EXPECT_EQ(fit(model, record, {}).starts, 1);
  const Fit asked = fit(model, record, {}, {.starts = 200});
  EXPECT_GT(asked.starts, 10);
  EXPECT_LT(asked.starts, 60) << "it ends where searches agree";
  EXPECT_NEAR(asked.numbers[0].value, 0.5, 0.02);
}

TEST(RangeSearch, StepsThatAreWrongAtAMinimumAreSeen) {
  // One explicit step an interval, of 2 radians.
  const SystemModel system = parse_ode_system(
      "param w = 10\ndx/dt = w*v\ndv/dt = -w*x\ny = x\ninitial x = 1 fixed\n"
      "initial v = 0 fixed\n",
      "m.ode");
  const Dataset record = support::grey_box(
      parse_ode("dx/dt = 10*v\ndv/dt = -10*x\ny = x\n", "t.ode"),
      {.start = (Vector(2) << 1.0, 0.0).finished(), .step = 0.2, .samples = 20, .noise = 0.01});
  const ParametrisedModel model = system.parametrised();
  FitEngine engine = fit_engine(model, fit_records(model, record));
  const FitPoint truth{model.values().transpose(), engine.records.starts};
  FitMinimum coarse{truth, follow(engine, truth, {})};
  EXPECT_TRUE(check_by_implicit_steps(engine, coarse, 1.0));
  ASSERT_TRUE(engine.implicit.has_value());
  for (Index n = 0; n < coarse.path.states.rows(); ++n)
    EXPECT_NEAR(coarse.path.states(n, 0), std::cos(10.0 * record.trajectories[0].time[n]), 1e-4);
  engine.implicit.reset();
  set_substeps(engine, kMostSubsteps);
  FitMinimum fine{truth, follow(engine, truth, {})};
  EXPECT_FALSE(check_by_implicit_steps(engine, fine, 1.0));
  EXPECT_FALSE(engine.implicit.has_value());
}

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

void expect_lorenz(const Fit& found, const std::string& of) {
  const double truths[] = {10.0, 28.0, 8.0 / 3.0};
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(found.numbers[i].value, truths[i], 4e-3 * truths[i]) << of;
    EXPECT_TRUE(found.numbers[i].standard_error) << of;
  }
  ASSERT_EQ(found.quality.size(), 3u);
  for (const FitQuality& quality : found.quality) EXPECT_NEAR(quality.rmse, 0.1, 0.01) << of;
}

// Errors grow by exp(0.9 t): to 2e4 of those at the begin in 11.
TEST(Continuation, FollowsAChaoticModelFarBeyondTheTimeOfItsErrors) {
  const SystemModel model = parse_ode_system(kLorenz, "m.ode");
  for (const Index samples : {400, 700, 1100}) {
    expect_lorenz(fit(model, lorenz(samples), {}), std::to_string(samples) + " samples");
  }
}

TEST(Continuation, AChaoticRecordThatNoFreeRunFollowsIsFittedInWindows) {
  const SystemModel model = parse_ode_system(kLorenz, "m.ode");
  const Fit found = fit(model, lorenz(3000), {}, {.effort = Thoroughness::Quick});
  EXPECT_THAT(found.notes, ::testing::Contains(::testing::HasSubstr("so long a record")));
  expect_lorenz(found, "in windows");
}

}  // namespace
}  // namespace lacuna
