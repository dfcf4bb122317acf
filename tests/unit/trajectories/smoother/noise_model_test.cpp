// SPDX-License-Identifier: MIT
#include "lacuna/trajectories/smoother/noise_model.hpp"

#include <gtest/gtest.h>

namespace lacuna {
namespace {

TEST(NoiseModel, CountsWhatIsMeasured) {
  const NoiseModel noise{{0.1, std::nullopt, 0.2}, {{}, {}, {}}, Vector::Zero(3)};
  EXPECT_EQ(noise.states(), 3);
  EXPECT_EQ(noise.measured(), 2);
}

}  // namespace
}  // namespace lacuna
