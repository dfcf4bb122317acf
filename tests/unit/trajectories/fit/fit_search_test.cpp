// SPDX-License-Identifier: MIT
#include "trajectories/fit/fit_search.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "lacuna/trajectories/fit/fit.hpp"
#include "support/grey_box.hpp"

namespace lacuna {
namespace {

Dataset record_of(const std::string& truth, double start) {
  return support::grey_box(parse_ode(truth, "truth.ode"), {.start = Vector::Constant(1, start),
                                                           .step = 0.2,
                                                           .samples = 30,
                                                           .noise = 0.02});
}

TEST(SearchFit, BeginsElsewhereWhereTheGivenRunIsNotFinite) {
  // dx/dt = g x^2 - x from 1 has no end where g < 1, and is infinite after ln(g/(g - 1)) else.
  const std::string equation = "dx/dt = g*x^2 - x\ny = x\ninitial x = 1 fixed\n";
  const SystemModel model =
      parse_ode_system("param g = 2000 in 1e-4..1e4\n" + equation, "m.ode");
  const Fit found = fit(model, record_of("dx/dt = 0.3*x^2 - x\ny = x\n", 1.0), {});
  EXPECT_NEAR(found.numbers[0].value, 0.3, 0.02);
}

TEST(SearchFit, ARangeThatIsNotWideIsNotLeft) {
  const SystemModel model = parse_ode_system(
      "param k = 3 in 2..5\ndx/dt = -k*x\ny = x\ninitial x = 2 fixed\n", "m.ode");
  const Fit found = fit(model, record_of("dx/dt = -0.5*x\ny = x\n", 2.0), {});
  EXPECT_EQ(found.numbers[0].value, 2.0);
  EXPECT_LE(found.starts, 11) << "the given ones and eight others";
}

}  // namespace
}  // namespace lacuna
