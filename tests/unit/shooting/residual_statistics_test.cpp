// SPDX-License-Identifier: MIT
#include "lacuna/shooting/residual_statistics.hpp"

#include <gtest/gtest.h>

#include "lacuna/core/random.hpp"
#include "lacuna/shooting/refine.hpp"
#include "unit/shooting/records.hpp"

namespace lacuna {
namespace {

std::vector<ResidualStatistics> of_draw(std::uint64_t seed) {
  return refine(with_free_coefficients(test_system("van-der-pol").model),
                testing::noisy_record("van-der-pol", 300, 0.03, seed))
      .residuals;
}

TEST(ResidualStatistics, RightModelsLeaveWhiteResiduals) {
  double sum = 0.0;
  int white = 0;
  constexpr int kDraws = 40;
  for (int seed = 1; seed <= kDraws; ++seed)
    for (const ResidualStatistics& s : of_draw(static_cast<std::uint64_t>(seed))) {
      sum += s.structure;
      white += s.white ? 1 : 0;
    }
  EXPECT_GE(white, 2 * kDraws - 2);
  EXPECT_NEAR(sum / (2 * kDraws), 0.0, 0.4);  // standard normal scores
}

TEST(ResidualStatistics, ColouredNoiseIsNotWhite) {
  Dataset record = testing::noisy_record("van-der-pol", 600, 0.001, 1);
  Random random(7);
  double drift = 0.0;
  for (Index i = 0; i < 600; ++i) {
    drift = 0.8 * drift + 0.03 * random.normal();
    record.trajectories[0].states(i, 0) += drift;
  }
  const auto statistics =
      refine(with_free_coefficients(test_system("van-der-pol").model), record).residuals;
  EXPECT_FALSE(statistics[0].white);
  EXPECT_GT(statistics[0].autocorrelation[0], 0.5);
  EXPECT_FALSE(statistics[0].is_noise);
}

}  // namespace
}  // namespace lacuna
