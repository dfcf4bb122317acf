// SPDX-License-Identifier: MIT
#include "trajectories/sensitivities/fixed_size.hpp"

#include <gtest/gtest.h>

namespace lacuna {
namespace {

int compiled_size(Index size) {
  return with_size(size, [](auto fixed) { return static_cast<int>(fixed()); });
}

TEST(FixedSize, UsualSizesAreKnownToTheCompiler) {
  for (int size = 1; size <= 8; ++size) EXPECT_EQ(compiled_size(size), size);
  EXPECT_EQ(compiled_size(0), Eigen::Dynamic);
  EXPECT_EQ(compiled_size(9), Eigen::Dynamic);
}

}  // namespace
}  // namespace lacuna
