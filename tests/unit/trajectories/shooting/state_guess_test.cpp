// SPDX-License-Identifier: MIT
#include "trajectories/shooting/state_guess.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.hpp"
#include "lacuna/core/base/error.hpp"

namespace lacuna {
namespace {

/// dq/dt = 2 v + q, dv/dt = -q with q = sin t: v = (cos t - sin t) / 2.
ParametrisedModel chain(const std::string& first, const std::string& second) {
  const Variables names{{"q", "v"}, {}};
  return with_free_coefficients(
      OdeModel({{"q", ""}, {"v", ""}}, {},
               {{{Term::parse(first, names), 2.0}, {Term::parse("q", names), 1.0}},
                {{Term::parse(second, names), -1.0}}}));
}

Trajectory sine(Index n, double begin, double noise, std::uint64_t seed) {
  Trajectory run{.source = "run" + std::to_string(seed) + ".csv",
                 .time = Vector::LinSpaced(n, begin, begin + 0.02 * static_cast<double>(n - 1)),
                 .states = {},
                 .inputs = Matrix(n, 0),
                 .derivatives = {}};
  Random random(seed);
  run.states.resize(n, 1);
  for (Index i = 0; i < n; ++i)
    run.states(i, 0) = std::sin(run.time[i]) + noise * random.normal();
  return run;
}

Dataset sines(double noise) {
  Dataset data;
  data.states = {{"q", ""}};
  data.trajectories = {sine(200, 0.0, noise, 1), sine(100, 40.0, noise, 2)};
  return data;
}

Matrix guessed(const ParametrisedModel& model, const Dataset& data, double sigma) {
  const ShootingRecord record = shooting_record(model, data);
  Rates rates(model);
  const StageSignals signals = stage_signals(record, rates, {&runge_kutta_4(), 1});
  return guess_states(model, record, rates, signals, Vector::Constant(1, sigma));
}

TEST(StateGuess, AnotherStateSolvesTheEquationItStandsIn) {
  const Matrix states = guessed(chain("v", "q"), sines(0.0), 0.0);
  for (Index i = 0; i < 300; ++i) {
    const double t =
        i < 200 ? 0.02 * static_cast<double>(i) : 40.0 + 0.02 * static_cast<double>(i - 200);
    EXPECT_NEAR(states(i, 1), 0.5 * (std::cos(t) - std::sin(t)), 5e-4) << i;
  }
}

TEST(StateGuess, SmallDivisorsKeepTheQuotientBefore) {
  // dq/dt = 2 q v + q: v = (cos t - sin t) / (2 sin t), nothing is known of it at t = 0.
  const Matrix states = guessed(chain("q*v", "q"), sines(0.0), 0.0);
  EXPECT_EQ(states(0, 1), 0.0);
  EXPECT_TRUE(states.allFinite());
  EXPECT_NEAR(states(79, 1), 0.5 * (1.0 / std::tan(1.58) - 1.0), 1e-3);
}

TEST(StateGuess, AStateThatNoEquationDefinesIsAnError) {
  EXPECT_THROW(guessed(chain("v^2", "q"), sines(0.0), 0.0), DataError);
  EXPECT_THROW(guessed(chain("q^2", "v"), sines(0.0), 0.0), DataError);
}

TEST(SmoothDerivative, IsExactForParabolasWithinEachRecord) {
  Dataset data = sines(0.0);
  const auto parabola = [](double t) { return 1.0 - 2.0 * t + 3.0 * t * t; };
  for (Trajectory& run : data.trajectories)
    for (Index i = 0; i < run.samples(); ++i) run.states(i, 0) = parabola(run.time[i]);
  const ShootingRecord record = shooting_record(chain("v", "q"), data);
  const Vector slopes = smooth_derivative(record, record.values.col(0), 1e-9);
  for (Index i = 0; i < 300; ++i)
    EXPECT_NEAR(slopes[i], -2.0 + 6.0 * record.time[i], 1e-6) << i;
}

TEST(SmoothDerivative, SmoothsAsMuchAsTheNoiseAllows) {
  const ShootingRecord record = shooting_record(chain("v", "q"), sines(0.01));
  const Vector slopes = smooth_derivative(record, record.values.col(0), 0.01);
  const double error = (slopes - record.time.array().cos().matrix()).norm() / std::sqrt(300.0);
  EXPECT_LT(error, 0.1) << "differences of neighbours have errors of 0.35";
}

}  // namespace
}  // namespace lacuna
