// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "support/asked.hpp"

namespace lacuna {
namespace {

TEST(Baseline, OutliersAreLeftOutAndNoted) {
  Dataset data = support::hidden_record(support::nothing, 0.01);
  data.trajectories[0].states(700, 0) += 5.0;
  const support::Asked asked{.records = observed(data)};
  const auto base = asked.baseline();
  ASSERT_FALSE(base->notes.empty());
  EXPECT_EQ(base->notes[0], "1 outlier of q was left out");
  EXPECT_EQ(base->fitted.used, 2 * 1501 - 1);
  EXPECT_NEAR(*base->fitted.noise.measurement[0], 0.01, 0.001) << "5 is no noise";
}

}  // namespace
}  // namespace lacuna
