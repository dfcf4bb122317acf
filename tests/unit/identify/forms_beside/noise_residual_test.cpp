// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.hpp"
#include "identify/forms_beside/form_problem.hpp"

namespace lacuna {
namespace {

constexpr double kNoise = 0.01;

/// x = 2 cos t, y = -2 sin t with noise: dx/dt = y, dy/dt = -x.
Dataset noisy_circle(std::uint64_t seed) {
  constexpr Index kSamples = 2001;
  Dataset data;
  data.states = {{"x", ""}, {"y", ""}};
  Trajectory record;
  record.time = Vector::LinSpaced(kSamples, 0.0, 40.0);
  record.states.resize(kSamples, 2);
  record.inputs.resize(kSamples, 0);
  Random random(seed);
  for (Index i = 0; i < kSamples; ++i) {
    record.states(i, 0) = 2.0 * std::cos(record.time[i]) + kNoise * random.normal();
    record.states(i, 1) = -2.0 * std::sin(record.time[i]) + kNoise * random.normal();
  }
  data.trajectories = {record};
  return data;
}

EquationForms rate_of_x(const FormProblem& problem, const std::string& term) {
  return {0, {Term(parse_expression(term), problem.all_rows().variables())}, {}};
}

TEST(NoiseResidual, IsWhatNoiseLeavesOfARightEquationOnAverage) {
  constexpr int kRecords = 40;
  const Vector noise = Vector::Constant(2, kNoise);
  double sum = 0.0, squares = 0.0;
  NoiseSquares expected;
  for (int seed = 1; seed <= kRecords; ++seed) {
    const FormProblem problem(noisy_circle(static_cast<std::uint64_t>(seed)), noise);
    const double left = problem.left(rate_of_x(problem, "y"));
    sum += left;
    squares += left * left;
    Matrix sensitivity = Matrix::Zero(problem.all_rows().samples(), 2);
    sensitivity.col(1).setOnes();
    expected = problem.all_rows().noise_squares(sensitivity, noise, 0);
    EXPECT_GT(expected.mean, 1.02 * problem.residual_noise(0)) << "noise of y counts as well";
  }
  const double mean = sum / kRecords;
  const double deviation = std::sqrt(squares / kRecords - mean * mean);
  // Of a mean of 40, and of a deviation of 40.
  EXPECT_NEAR(mean, expected.mean, 4.0 * expected.deviation / std::sqrt(1.0 * kRecords));
  EXPECT_NEAR(deviation, expected.deviation, 0.45 * expected.deviation);
}

TEST(NoiseResidual, SaysWhereAFormWouldFitNoise) {
  const FormProblem problem(noisy_circle(1), Vector::Constant(2, kNoise));
  constexpr double kHalf = 0.5;
  EXPECT_TRUE(problem.would_fit_noise(rate_of_x(problem, "y"), kHalf));
  EXPECT_FALSE(problem.would_fit_noise(rate_of_x(problem, "y"), 1.5));
  EXPECT_FALSE(problem.would_fit_noise(rate_of_x(problem, "y^3"), kHalf));
  EXPECT_FALSE(problem.would_fit_noise({0, {}, {}}, kHalf));
}

}  // namespace
}  // namespace lacuna
