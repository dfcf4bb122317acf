// SPDX-License-Identifier: MIT
#include "lacuna/data/derivatives/spectral.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "core/base/random.hpp"
#include "grids.hpp"

namespace lacuna {
namespace {

Vector disturbed(Vector y, double noise, std::uint64_t seed) {
  Random random(seed);
  for (Index i = 0; i < y.size(); ++i) y[i] += noise * random.normal();
  return y;
}

TEST(Spectral, IsExactForItsOwnSeriesOnAnyGrid) {
  for (const Vector& grid : {uniform_grid(120, 3.0), jittered_grid(120, 3.0)}) {
    const Vector time = grid.array() - grid[0];
    const double w = 4.0 * std::numbers::pi / time[119];
    const Vector y = (w * time.array()).cos() + time.array().cube();
    const Vector rate = 3.0 * time.array().square() - w * (w * time.array()).sin();
    const Spectral method{{.cutoff = 3.0}};
    EXPECT_LT(relative_error(method.differentiate(time, y), rate), 1e-9);
  }
}

TEST(Spectral, RemovesWhatIsAboveTheCutoff) {
  const Vector time = uniform_grid(800, 10.0);
  const Vector slow = (2.0 * time.array()).sin();
  const Vector fast = (60.0 * time.array()).sin();
  const Vector kept = Spectral{{.cutoff = 2.0}}.differentiate(time, slow + fast, 0);
  EXPECT_LT((kept - slow).norm() / fast.norm(), 0.06);
}

TEST(Spectral, ChoosesACutoffForNoiseAndItsErrorIsThatOfManyDraws) {
  const Vector time = uniform_grid(600, 12.0);
  double error = 0.0, claimed = 0.0;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    const Vector y = disturbed((2.0 * time.array()).sin(), 0.1, seed);
    const Vector rate = Spectral{}.differentiate(time, y);
    error += (rate.array() - 2.0 * (2.0 * time.array()).cos()).square().mean();
    claimed += Spectral{}.standard_error(time, y)->array().square().mean();
  }
  EXPECT_LT(std::sqrt(error / 8.0), 0.25);
  EXPECT_NEAR(std::log(claimed / error), 0.0, std::log(4.0));
}

TEST(Spectral, LongRecordsGoByPieces) {
  const Vector time = uniform_grid(5000, 100.0);
  const Vector rate = Spectral{}.differentiate(time, disturbed(time.array().sin(), 0.01, 2));
  EXPECT_LT((rate.array() - time.array().cos()).matrix().norm() / std::sqrt(5000.0), 0.02);
}

}  // namespace
}  // namespace lacuna
