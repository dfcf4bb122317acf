// SPDX-License-Identifier: MIT
#include "trajectories/smoother/outlier_check.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/assimilated_oscillator.hpp"

namespace lacuna {
namespace {

TEST(OutlierCheck, KeepsWhatThePathDoesNotExplain) {
  Dataset data = support::hidden_record(support::nothing, 0.01);
  data.trajectories[0].states(200, 0) += 0.5;
  Matrix marks = Matrix::Zero(data.samples(), 2);
  marks(200, 0) = 1.0;
  marks(300, 0) = 1.0;  // a sample like others
  const Assimilation fit = assimilate(support::oscillator(), as_measured(data, {marks}),
                                      support::oscillator_fit_options(), RunContext{});
  const OutlierCheck check = check_outliers(data.states, fit);
  EXPECT_TRUE(check.any_false);
  EXPECT_EQ(check.outliers[0](200, 0), 1.0);
  EXPECT_EQ(check.outliers[0].sum(), 1.0);
  EXPECT_THAT(check.notes, ::testing::ElementsAre("1 outlier of q was left out"));
}

}  // namespace
}  // namespace lacuna
