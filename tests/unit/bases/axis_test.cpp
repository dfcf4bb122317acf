// SPDX-License-Identifier: MIT
#include "bases/axis.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace lacuna {
namespace {

TEST(Axis, FormulasAreShort) {
  EXPECT_EQ(scaled_axis("x", -1.0, 1.0), "x");
  EXPECT_EQ(scaled_axis("x", 1.0, 5.0), "((x-3)/2)");
  EXPECT_EQ(shifted_axis("x", -0.5), "(x+0.5)");
  EXPECT_THAT(places_between(0.0, 2.0, 3), ::testing::ElementsAre(0.0, 1.0, 2.0));
  EXPECT_THROW(check_number_of_terms("radial", 100001), ConfigError);
}

}  // namespace
}  // namespace lacuna
