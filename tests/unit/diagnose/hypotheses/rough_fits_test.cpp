// SPDX-License-Identifier: MIT
#include "diagnose/hypotheses/rough_fits.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "support/asked.hpp"
#include "support/assimilated_oscillator.hpp"

namespace lacuna {
namespace {

TEST(RoughFits, ComeInTheOrderOfTheCriterionWithoutThoseThatFail) {
  const support::Asked asked = support::asked(support::dry_friction, 0.01);
  const std::shared_ptr<const Baseline> base = asked.baseline();
  const auto start_with = [&](const std::string& form) {
    FittedEffect effect{support::plain_candidate(form), Vector(0), 0.0, 0.0};
    effect.candidate.equation = 1;
    return FitStart{{effect}, &base->fitted};
  };
  const FitStart present = start_with("v");  // the model has this term already
  const std::vector<Explanation> fits = rough_fits(
      asked.problem(), *base, {start_with("v^3"), present, start_with("sign(v)")});
  ASSERT_EQ(fits.size(), 2u);
  EXPECT_EQ(fits[0].effects[0].candidate.form.to_string(), "sign(v)");
  EXPECT_EQ(fits[1].effects[0].candidate.form.to_string(), "v^3");
  EXPECT_LT(fits[0].fit.deviance, fits[1].fit.deviance);
}

TEST(RoughFits, BeginFromTheirOwnStarts) {
  const support::Asked asked = support::asked(support::dry_friction, 0.01);
  const std::shared_ptr<const Baseline> base = asked.baseline();
  FittedEffect effect{support::plain_candidate("sign(v)"), Vector(0), 0.0, 0.0};
  effect.candidate.equation = 1;
  const Explanation from_given =
      explain_roughly_on(asked.problem(), *base, base->given, {effect});
  const Explanation from_fitted =
      explain_roughly_on(asked.problem(), *base, base->fitted, {effect});
  ASSERT_NE(from_given.fit.deviance, from_fitted.fit.deviance);
  const std::vector<Explanation> fits = rough_fits(
      asked.problem(), *base, {{{effect}, &base->given}, {{effect}, &base->fitted}});
  ASSERT_EQ(fits.size(), 2u);
  EXPECT_EQ(fits[0].fit.deviance, std::min(from_given.fit.deviance, from_fitted.fit.deviance));
  EXPECT_EQ(fits[1].fit.deviance, std::max(from_given.fit.deviance, from_fitted.fit.deviance));
}

}  // namespace
}  // namespace lacuna
