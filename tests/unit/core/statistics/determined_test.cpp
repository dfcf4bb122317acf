// SPDX-License-Identifier: MIT
#include "core/statistics/determined.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace lacuna {
namespace {

TEST(Determined, IsWhatHasAnErrorBelowAMillionTimesItsSize) {
  EXPECT_TRUE(is_determined(-2.0, 1.9e6));
  EXPECT_FALSE(is_determined(-2.0, 2.1e6));
  EXPECT_FALSE(is_determined(7.5e-12, 2e71));
  EXPECT_FALSE(is_determined(1.0, std::nan("")));
  EXPECT_TRUE(is_determined(0.0, 3.0)) << "what is 0 has no size";
}

}  // namespace
}  // namespace lacuna
