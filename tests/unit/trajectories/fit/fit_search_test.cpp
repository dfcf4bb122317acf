// SPDX-License-Identifier: MIT
#include "trajectories/fit/fit_search.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "lacuna/trajectories/fit/fit.hpp"
#include "support/grey_box.hpp"

namespace lacuna {
namespace {

Dataset record_of(const std::string& truth, double start) {
  return support::grey_box(parse_ode(truth, "truth.ode"), {.start = Vector::Constant(1, start),
                                                           .step = 0.2,
                                                           .samples = 30,
                                                           .noise = 0.02});
}

TEST(SearchFit, BeginsElsewhereWhereTheGivenRunIsNotFinite) {
  // dx/dt = g x^2 - x from 1 has no end where g < 1, and is infinite after ln(g/(g - 1)) else.
  const std::string equation = "dx/dt = g*x^2 - x\ny = x\ninitial x = 1 fixed\n";
  const SystemModel model =
      parse_ode_system("param g = 2000 in 1e-4..1e4\n" + equation, "m.ode");
  const Fit found = fit(model, record_of("dx/dt = 0.3*x^2 - x\ny = x\n", 1.0), {});
  EXPECT_NEAR(found.numbers[0].value, 0.3, 0.02);
}

TEST(SearchFit, ARangeThatIsNotWideIsNotLeft) {
  const SystemModel model = parse_ode_system(
      "param k = 3 in 2..5\ndx/dt = -k*x\ny = x\ninitial x = 2 fixed\n", "m.ode");
  const Fit found = fit(model, record_of("dx/dt = -0.5*x\ny = x\n", 2.0), {});
  EXPECT_EQ(found.numbers[0].value, 2.0);
  EXPECT_LE(found.starts, 11) << "the given ones and eight others";
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

// Errors grow by exp(0.9 t): to 2e4 of those at the begin in 11.
TEST(SearchFit, FollowsAChaoticModelFarBeyondTheTimeOfItsErrors) {
  const SystemModel model = parse_ode_system(kLorenz, "m.ode");
  for (const Index samples : {400, 700, 1100}) {
    const Fit found = fit(model, lorenz(samples), {});
    const double truths[] = {10.0, 28.0, 8.0 / 3.0};
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_NEAR(found.numbers[i].value, truths[i], 4e-3 * truths[i]) << samples;
      EXPECT_TRUE(found.numbers[i].standard_error);
    }
    for (const FitQuality& quality : found.quality) EXPECT_NEAR(quality.rmse, 0.1, 0.01);
  }
}

TEST(SearchFit, AChaoticRecordThatNoFreeRunFollowsIsSaidToBeTooLong) {
  const SystemModel model = parse_ode_system(kLorenz, "m.ode");
  const Fit found = fit(model, lorenz(3000), {}, {.effort = Thoroughness::Quick});
  EXPECT_THAT(found.notes, ::testing::Contains(::testing::HasSubstr("so long a record")));
  for (const FitQuality& quality : found.quality) EXPECT_FALSE(quality.white);
}

}  // namespace
}  // namespace lacuna
