// SPDX-License-Identifier: MIT
#include "trajectories/fit/fit_search.hpp"

#include <gtest/gtest.h>

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

/// Predators that are sated: prey grows 10 000 times, and noise hides what it begins with.
Dataset sated_predators(std::uint64_t seed) {
  return support::grey_box(
      parse_ode("dx/dt = 1.1*x - 0.5*x*z/(1+0.3*x)\n"
                "dz/dt = 0.3*x*z/(1+0.3*x) - 0.4*z\ny = x\nw = z\n",
                "truth.ode"),
      {.start = Vector{{3.0, 2.0}}, .step = 0.25, .samples = 40, .noise = 0.03, .seed = seed});
}

/// The fit with the seed of the record.
Fit fitted(const std::string& text, std::uint64_t seed) {
  RunContext context;
  context.seed = seed;
  return fit(parse_ode_system(text, "m.ode"), sated_predators(seed), {}, {}, context);
}

// One step for each sample meets the noise elsewhere than the model does, from the true numbers,
// with which the model itself leaves 127 and 1.59.
TEST(SearchFit, WhatOnlyLongStepsMakeOfAModelIsNoFit) {
  const Fit found = fitted(
      "param a = 1.1 in 0.01..20\nparam b = 0.5 in 0.01..20\nparam h = 0.3 in 0.001..20\n"
      "param c = 0.3 in 0.01..20\nparam d = 0.4 in 0.01..20\n"
      "dx/dt = a*x - b*x*z/(1+h*x)\ndz/dt = c*x*z/(1+h*x) - d*z\ny = x\nw = z\n",
      44);
  ASSERT_EQ(found.quality.size(), 2u);
  EXPECT_LT(found.quality[0].rmse, 130.0);
  EXPECT_LT(found.quality[1].rmse, 1.65);
}

}  // namespace
}  // namespace lacuna
