// SPDX-License-Identifier: MIT
#include "trajectories/windows/window_paths.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "lacuna/data/records/marks.hpp"
#include "support/assimilated_oscillator.hpp"

namespace lacuna {
namespace {

TEST(WindowPaths, LeaveWhatTheSquaresCount) {
  const Dataset data = support::hidden_record(support::nothing, 0.01, 3);
  const Assimilation fit = support::assimilated(data);
  const Matrix marks = Matrix::Zero(fit.measured[0].rows(), 2);
  const MarkedSamples measured{fit.measured[0], marks};
  const WindowGrid grid{7, 100};
  const Matrix path = window_paths(fit.records[0], measured, fit.noise, grid);
  const WindowSquares squares =
      window_squares(fit.records[0], measured, fit.noise, Vector::Ones(2), grid);
  double sum = 0.0, count = 0.0;
  for (Index i = 0; i < path.rows(); ++i)
    for (Index k = 0; k < 2; ++k)
      if (std::isfinite(path(i, k))) {
        sum += std::pow(fit.measured[0](i, k) - path(i, k), 2);
        count += 1.0;
      }
  EXPECT_DOUBLE_EQ(count, squares.count);
  EXPECT_NEAR(sum, squares.sum, 1e-9 * sum);
  EXPECT_TRUE(std::isnan(path(6, 0)));
  EXPECT_TRUE(std::isfinite(path(7, 0)));
}

}  // namespace
}  // namespace lacuna
