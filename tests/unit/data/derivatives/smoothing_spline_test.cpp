// SPDX-License-Identifier: MIT
#include "lacuna/data/derivatives/smoothing_spline.hpp"

#include <gtest/gtest.h>

#include "core/base/random.hpp"
#include "data/derivatives/wiener_path.hpp"
#include "grids.hpp"

namespace lacuna {
namespace {

Vector noisy_sine(const Vector& time, double noise, std::uint64_t seed) {
  Random random(seed);
  Vector y = time.array().sin();
  for (Index i = 0; i < y.size(); ++i) y[i] += noise * random.normal();
  return y;
}

TEST(SmoothingSpline, IsTheSmootherOfTheIntegratedWienerProcess) {
  const Vector time = uniform_grid(200, 10.0);
  const Vector y = noisy_sine(time, 0.1, 2);
  for (int m = 2; m <= 4; ++m) {
    const double lambda = 1e-3;
    const SmoothingSpline spline{{.order = m, .lambda = lambda}};
    const WienerPath path = smooth_wiener(time, y, m, lambda);
    for (int k = 0; k < 2; ++k) {
      const Vector expected = path.states[static_cast<std::size_t>(k)].col(0);
      EXPECT_LT(relative_error(spline.differentiate(time, y, k), expected), 1e-5) << m << k;
      // Between the knots the process is rougher than splines: of rates, errors agree roughly.
      if (m == 2 && k == 1) continue;
      const Vector errors = spline.standard_error(time, y, k)->col(0);
      const Vector shape = path.deviations[static_cast<std::size_t>(k)];
      EXPECT_LT((errors / errors[100] - shape / shape[100]).norm(),
                (k == 0 ? 1e-4 : 0.01) * shape.norm() / shape[100])
          << m << k;
    }
  }
}

TEST(SmoothingSpline, EveryChoiceReducesTheErrorOfTheRateAndKnowsIt) {
  const Vector time = jittered_grid(400, 12.0);
  for (const auto choice : {PenaltyChoice::Gcv, PenaltyChoice::Reml, PenaltyChoice::Noise}) {
    const SmoothingSpline spline{{.choice = choice}};
    double error = 0.0, claimed = 0.0;
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      const Vector y = noisy_sine(time, 0.1, seed);
      const Vector rate = spline.differentiate(time, y);
      error += (rate.array() - time.array().cos()).square().mean();
      claimed += spline.standard_error(time, y)->array().square().mean();
    }
    // Differences of neighbours have 0.1 sqrt(2) / 0.03 = 4.7.
    EXPECT_LT(std::sqrt(error / 5.0), 0.15) << static_cast<int>(choice);
    EXPECT_NEAR(std::log(claimed / error), 0.0, std::log(4.0)) << static_cast<int>(choice);
  }
}

TEST(SmoothingSpline, GoesOnOverAGap) {
  const Vector all = uniform_grid(300, 10.0);
  Vector time(250);
  time << all.head(120), all.tail(130);
  const Vector y = noisy_sine(time, 0.02, 3);
  const Vector rate = SmoothingSpline{}.differentiate(time, y);
  EXPECT_LT((rate.array() - time.array().cos()).abs().maxCoeff(), 0.3);
}

TEST(SmoothingSpline, FittedKeepsItsLambdaAndHasAMargin) {
  Dataset data;
  data.states = {{"x", ""}};
  const Vector time = uniform_grid(500, 20.0);
  data.trajectories.push_back({"", time, noisy_sine(time, 0.1, 1), Matrix(500, 0), Matrix()});
  const auto fitted = fitted_to(Stage<Differentiator>(SmoothingSpline{}), data);
  EXPECT_GT(fitted->margin(), 5);
  EXPECT_LT(fitted->margin(), 100);
  const Vector twice = fitted->differentiate(time, 2.0 * data.trajectories[0].states);
  const Vector once = fitted->differentiate(time, data.trajectories[0].states);
  EXPECT_LT((twice - 2.0 * once).norm(), 1e-10 * twice.norm());
}

TEST(SmoothingSpline, HasNoHigherDerivativesThanItsDegree) {
  const Vector time = uniform_grid(30, 1.0);
  EXPECT_THROW(SmoothingSpline({.lambda = 1.0}).differentiate(time, Matrix(time), 5),
               ArgumentError);
}

}  // namespace
}  // namespace lacuna
