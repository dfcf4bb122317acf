// SPDX-License-Identifier: MIT
#include "lacuna/effects/lag.hpp"

#include <gtest/gtest.h>

#include "support/diagnosis_scope.hpp"

namespace lacuna {
namespace {

TEST(Lag, EveryTermOfTheEquationMayLag) {
  const auto made = Lag().candidates(support::oscillator_scope(), 1);
  ASSERT_EQ(made.size(), 3u);
  EXPECT_EQ(made[2].form, "lagged-(F)");
  ASSERT_EQ(made[2].memory.size(), 1u);
  EXPECT_EQ(made[2].memory[0].start, "F");
  const std::vector<double> tau{0.5};
  EXPECT_EQ(bind_formula(made[2], made[2].memory[0].rate, tau),
            parse_expression("((F)-lagged)/(0.5)"));
}

}  // namespace
}  // namespace lacuna
