// SPDX-License-Identifier: MIT
#include "diagnose/hypotheses/shared_process.hpp"

#include <gtest/gtest.h>

#include <array>

#include "lacuna/model/files/ode_text.hpp"
#include "support/asked.hpp"

namespace lacuna {
namespace {

/// Effects of the same form in both equations.
std::array<FittedEffect, 2> in_both(double one, double other) {
  std::array<FittedEffect, 2> made;
  for (Index k = 0; k < 2; ++k) {
    FittedEffect& effect = made[static_cast<std::size_t>(k)];
    effect.candidate.equation = k;
    effect.coefficient = k == 0 ? one : other;
  }
  return made;
}

TEST(SharedProcess, ActsOnBothEquationsAsATermDoesThatTheyShare) {
  const OdeModel passed_on =
      parse_ode("dS/dt = -0.5*S*I - 0.02*S\ndI/dt = 0.5*S*I - 0.2*I\n", "m.ode");
  const auto [loss, gain] = in_both(-0.3, 0.1);
  EXPECT_TRUE(acts_as_shared(passed_on, loss, gain));
  const auto [first, second] = in_both(0.3, 0.1);
  EXPECT_FALSE(acts_as_shared(passed_on, first, second)) << "what one loses the other gains";
  const OdeModel alike = parse_ode("dx/dt = -x*y\ndy/dt = -2*x*y\n", "m.ode");
  EXPECT_TRUE(acts_as_shared(alike, first, second));
  EXPECT_FALSE(acts_as_shared(alike, loss, gain));
}

}  // namespace
}  // namespace lacuna
