// SPDX-License-Identifier: MIT
#include "lacuna/bases/piecewise_linear.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "unit/bases/values.hpp"

namespace lacuna {
namespace {

TEST(PiecewiseLinear, SpansFunctionsThatAreLinearBetweenTheBends) {
  const TermLibrary library =
      PiecewiseLinear{{.count = 2, .low = -1.0, .high = 1.0}}.library({{"x"}, {}});
  EXPECT_THAT(library.names(), ::testing::ElementsAre("1", "x", "max(x+1,0)", "max(x-1,0)"));
  EXPECT_EQ(values_at(library, -2.0)[2], 0.0);
  EXPECT_EQ(values_at(library, 0.5)[2], 1.5);
}

}  // namespace
}  // namespace lacuna
