// SPDX-License-Identifier: MIT
#include "diagnose/hypotheses/broken_identity.hpp"

#include <gtest/gtest.h>

#include "support/asked.hpp"

namespace lacuna {
namespace {

/// A complete model whose sensor of v has an offset and a gain.
support::Asked with_sensor(double offset, double gain) {
  Dataset data = support::hidden_record(support::nothing, 0.005);
  auto v = data.trajectories.front().states.col(1).array();
  v = offset + gain * v;
  return {.records = observed(data)};
}

TEST(BrokenIdentity, AGainIsTheIdentitysCoefficient) {
  const support::Asked asked = with_sensor(0.0, 1.25);
  CompositeModel best = asked.bare();
  best.findings = {{.name = "an assumption"}};
  const Proposals made = BrokenIdentity().propose(asked.problem(), best);
  ASSERT_EQ(made.composites.size(), 1u);
  EXPECT_EQ(made.composites[0].composite.findings.size(), 1u)
      << "what the baseline assumes already";
  EXPECT_TRUE(made.composites[0].search_first);
  const Baseline& base = *made.composites[0].composite.base;
  EXPECT_EQ(base.fit_options.free.size(), 4u) << "q, v, F and the identity's v";
  EXPECT_EQ(base.fit_options.free.back(), (CoefficientPlace{0, 0}));
  EXPECT_EQ(base.parameters, 1.0) << "the variance of its disturbance";
  EXPECT_NEAR(base.fitted.model.coefficient(0, "v"), 1.0 / 1.25, 0.01);
  EXPECT_NEAR(base.fitted.model.coefficient(1, "q"), -4.0 * 1.25, 0.05);
  ASSERT_FALSE(base.notes.empty());
  EXPECT_NE(base.notes.back().find("contradict an identity"), std::string::npos);
}

TEST(BrokenIdentity, OfAStateThatWasNotMeasuredAnIdentityIsTheDefinition) {
  Dataset data = with_sensor(0.0, 1.25).records.data;
  data.reconstructed = {false, true};
  const support::Asked asked{.records = observed(data)};
  CompositeModel best = asked.bare();
  ASSERT_FALSE(best.base->given.noise.measurement[1]);
  const Proposals made = BrokenIdentity().propose(asked.problem(), best);
  EXPECT_TRUE(made.composites.empty() && made.trail.empty());
}

}  // namespace
}  // namespace lacuna
