// SPDX-License-Identifier: MIT
#include "diagnose/hypotheses/broken_identity.hpp"

#include <gtest/gtest.h>

#include "lacuna/model/files/ode_text.hpp"
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

TEST(BrokenIdentity, WithoutReasonToDoubtItSaysHowFarTheNoiseIsInflated) {
  support::Asked asked = support::asked(support::nothing, 0.005);
  const CompositeModel bare = asked.bare();
  const Proposals made = BrokenIdentity().propose(asked.problem(), bare);
  EXPECT_TRUE(made.composites.empty());
  ASSERT_EQ(made.trail.size(), 1u);
  EXPECT_EQ(made.trail[0].quantity, "inflation of the noise");
  EXPECT_NEAR(made.trail[0].value, 1.0, 0.1) << "white noise is what neighbours show";
  EXPECT_EQ(made.trail[0].threshold, asked.options.decision.noise_inflation);
  asked.options.decision.noise_inflation = 0.5;
  const Proposals doubted = BrokenIdentity().propose(asked.problem(), bare);
  EXPECT_TRUE(doubted.composites.empty());
  ASSERT_EQ(doubted.trail.size(), 1u);
  EXPECT_EQ(doubted.trail[0].quantity, "equations disturbed") << "doubted, and found to hold";
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

TEST(BrokenIdentity, AConstantThatNobodyMeasuredIsNotDoubted) {
  // dv/dt has an offset b, a state of its own: db/dt = 0.
  const OdeModel nominal =
      parse_ode("input F\ndq/dt = v\ndv/dt = -4*q - 0.2*v + F + b\ndb/dt = 0\n", "biased");
  ASSERT_TRUE(nominal.equations()[2].empty());
  Dataset data = support::hidden_record([](double, double, double) { return 0.3; }, 0.005);
  data.states.push_back({"b", ""});
  data.reconstructed = {false, false, true};
  Matrix& states = data.trajectories[0].states;
  states.conservativeResize(Eigen::NoChange, 3);
  states.col(2).setZero();
  support::Asked asked{.records = observed(data), .nominal = nominal};
  asked.options.decision.noise_inflation = 0.5;
  const CompositeModel bare = asked.bare();
  EXPECT_EQ(bare.base->fitted.noise.disturbance[2], 0.0) << "a constant";
  EXPECT_NEAR(bare.base->fitted.records[0].path(700, 2), 0.3, 0.02);
  const Proposals made = BrokenIdentity().propose(asked.problem(), bare);
  EXPECT_TRUE(made.composites.empty());
}

}  // namespace
}  // namespace lacuna
