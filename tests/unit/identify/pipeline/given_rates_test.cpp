// SPDX-License-Identifier: MIT
#include "identify/pipeline/given_rates.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.hpp"
#include "lacuna/model/files/ode_text.hpp"

namespace lacuna {
namespace {

/// x = cos t with dx/dt = -sin t, both with noise.
Dataset turning(double state_noise, double rate_noise) {
  constexpr Index kSamples = 4000;
  Random random(7);
  Trajectory run{"run", Vector::LinSpaced(kSamples, 0.0, 40.0), Matrix(kSamples, 1),
                 Matrix(kSamples, 0), Matrix(kSamples, 1)};
  for (Index n = 0; n < kSamples; ++n) {
    run.states(n, 0) = std::cos(run.time[n]) + state_noise * random.normal();
    run.derivatives(n, 0) = -std::sin(run.time[n]) + rate_noise * random.normal();
  }
  return {"s", {{"x", ""}}, {}, {run}, {}, {}};
}

TEST(GivenRates, LeaveTheirNoiseAndThatOfTheStatesThroughTheRates) {
  const OdeModel model = parse_ode("dx/dt = -2*x + x^2", "model");
  const Vector exact = noise_of_given_rates(model, turning(0.0, 0.0), Vector::Zero(1));
  EXPECT_NEAR(exact[0], kRoundingOfRates * std::sqrt(0.5), 0.05 * kRoundingOfRates);
  const Vector own = noise_of_given_rates(model, turning(0.0, 0.03), Vector::Zero(1));
  EXPECT_NEAR(own[0], 0.03, 0.003);
  // (2 x - 2)^2 is 6 on average over turns.
  const Vector both = noise_of_given_rates(model, turning(0.01, 0.03), Vector{{0.01}});
  EXPECT_NEAR(both[0], std::hypot(0.03, 0.01 * std::sqrt(6.0)), 0.004);
}

TEST(GivenRates, DecideOnlyFarAboveTheirNoiseAndAtRounding) {
  const OdeModel model = parse_ode("dx/dt = -2*x + x^2", "model");
  const Dataset data = turning(0.0, 0.03);
  std::vector<EquationFit> fits(1);
  const auto has_floor = [&](double residual) {
    fits[0] = {.equation = "x", .residual_rms = residual};
    note_floors_of_given_rates(model, data, Vector::Zero(1), fits);
    return fits[0].noise_floor.has_value();
  };
  EXPECT_TRUE(has_floor(0.1));
  EXPECT_FALSE(has_floor(0.03));
  EXPECT_TRUE(has_floor(1e-10));
}

}  // namespace
}  // namespace lacuna
