// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include "lacuna/core/base/error.hpp"
#include "lacuna/diagnose/criterion/extended_bic.hpp"
#include "support/asked.hpp"
#include "support/assimilated_oscillator.hpp"

namespace lacuna {
namespace {

TEST(Baseline, OutliersAreLeftOutAndNoted) {
  Dataset data = support::hidden_record(support::nothing, 0.01);
  data.trajectories[0].states(700, 0) += 5.0;
  const support::Asked asked{.records = observed(data)};
  const auto base = asked.baseline();
  ASSERT_FALSE(base->notes.empty());
  EXPECT_EQ(base->notes[0], "1 outlier of q was left out");
  EXPECT_EQ(base->fitted.used, 2 * 1501 - 1);
  EXPECT_NEAR(*base->fitted.noise.measurement[0], 0.01, 0.001) << "5 is no noise";
}

TEST(Baseline, TheCriterionSeesEveryParameter) {
  const support::Asked asked = support::asked(support::dry_friction);
  auto base = *asked.baseline();
  base.parameters = 2.0;
  const Explanation made{{{support::stop_candidate(0.0), Vector::Zero(1), 1.0, 0.1}},
                         base.fitted};
  const double expected = base.fitted.deviance +
                          (3.0 + 2.0 + 2.0) * std::log(static_cast<double>(base.fitted.used));
  EXPECT_NEAR(criterion_of(asked.problem(), base, made), expected, 1e-9 * std::abs(expected));
  EXPECT_EQ(base.fitted.used, 2 * 1501);
}

TEST(Baseline, EffectsAreFittedOnTopOfIt) {
  const support::Asked asked = support::asked(support::dry_friction);
  const auto base = asked.baseline();
  const std::vector<FittedEffect> effects = {
      {support::plain_candidate("sign(v)"), Vector(0), 0.0, 0.0}};
  const Problem problem = asked.problem();
  const Explanation exact = explain_on(problem, *base, base->fitted, effects);
  const Explanation rough = explain_roughly_on(problem, *base, base->fitted, effects);
  for (const Explanation* found : {&exact, &rough}) {
    EXPECT_NEAR(found->effects[0].coefficient, -0.3, 0.02);
    EXPECT_LT(std::abs(found->effects[0].coefficient + 0.3), 3.0 * found->effects[0].deviation);
  }
  EXPECT_LE(exact.fit.deviance, rough.fit.deviance + 0.1);
}

}  // namespace
}  // namespace lacuna
