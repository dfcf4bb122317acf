// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include "diagnose/hypotheses/input_noise.hpp"
#include "diagnose/hypotheses/residual_function.hpp"
#include "support/asked.hpp"
#include "support/assimilated_oscillator.hpp"

namespace lacuna {
namespace {

FittedEffect plain_effect(const std::string& form) {
  return {support::plain_candidate(form), Vector(0), 0.0, 0.0};
}

constexpr Index kTried = 100;  // candidates of which an effect was the best

/// The oscillator with effects that are called as their forms are.
CompositeModel named(const support::Asked& asked, const std::vector<FittedEffect>& effects) {
  const Problem problem = asked.problem();
  CompositeModel composite = asked.bare();
  composite.explanation =
      explain_on(problem, *composite.base, composite.base->fitted, effects);
  for (const FittedEffect& effect : effects)
    composite.named.push_back(
        {.equation = 1, .name = effect.candidate.form.to_string(), .tried = kTried});
  composite.left = structure_left(problem, composite.explanation.fit);
  return composite;
}

/// A function of q of which no formula leaves nothing.
double bumps(double, double q, double) { return -4.0 * q * q * q + 0.4 * std::sin(9.0 * q); }

TEST(WrongShapes, AreThoseThatACurveOfTheirArgumentShowsToBeOthers) {
  const support::Asked asked = support::asked(bumps, 0.002);
  const CompositeModel composite =
      named(asked, {plain_effect("v*abs(v)"), plain_effect("q^3"), plain_effect("q^5")});
  ASSERT_TRUE(leaves_structure(composite, asked.options.decision));
  const auto wrong = wrong_shapes(asked.problem(), composite);
  ASSERT_TRUE(wrong);
  EXPECT_EQ(wrong->effects, (std::vector<std::size_t>{0, 1, 2}))
      << "the curve needs no drag beside it";
  EXPECT_EQ(wrong->better.composite, "a free curve of q in dv/dt");
  EXPECT_TRUE(wrong->better.taken);
  EXPECT_LT(wrong->better.value, wrong->better.threshold - asked.options.decision.undecided);
}

TEST(WrongShapes, IsAPlainTermWhereALawLeavesNothing) {
  const support::Asked asked = support::asked(
      [](double, double q, double) { return -3.0 * std::sin(2.0 * q); }, 0.002);
  const CompositeModel composite = named(asked, {plain_effect("q^3")});
  ASSERT_TRUE(has_residual_structure(composite.left, asked.options.decision));
  const auto wrong = wrong_shapes(asked.problem(), composite);
  ASSERT_TRUE(wrong);
  EXPECT_EQ(wrong->effects, std::vector<std::size_t>{0});
  EXPECT_EQ(wrong->better.composite, "one formula of q in dv/dt");
}

TEST(WrongShapes, AreNoneWhereTheCurveLeavesAsMuch) {
  const auto hum = [](double t, double q, double) {
    return -4.0 * q * q * q + 0.5 * std::sin(9.0 * t);
  };
  const support::Asked asked = support::asked(hum, 0.002);
  const CompositeModel composite = named(asked, {plain_effect("q^3"), plain_effect("q^5")});
  ASSERT_TRUE(leaves_structure(composite, asked.options.decision));
  EXPECT_FALSE(wrong_shapes(asked.problem(), composite)) << "what is left is no function of q";
}

}  // namespace
}  // namespace lacuna
