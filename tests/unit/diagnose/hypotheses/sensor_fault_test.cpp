// SPDX-License-Identifier: MIT
#include "diagnose/hypotheses/sensor_fault.hpp"

#include <gtest/gtest.h>

#include "support/asked.hpp"
#include "support/assimilated_oscillator.hpp"
#include "support/own_effects.hpp"

namespace lacuna {
namespace {

inline constexpr StageInfo kSkew{"skew", "A skew for tests", ""};

/// v is measured with a summand of sign(v).
class Skew final : public Configured<Effect, EffectOptions<kSkew>> {
  std::string_view do_typical_cause() const override { return "a test"; }
  std::vector<Candidate> do_candidates(const Scope&, Index equation) const override {
    if (equation != 1) return {};
    Candidate candidate = support::plain_candidate("sign(v)");
    candidate.place = Place::Channel;
    return {candidate};
  }
};

/// A composite model of records with dry friction that blames the sensor of v and leaves
/// structure.
CompositeModel with_fault(const support::Asked& asked) {
  CompositeModel best = asked.bare();
  const Candidate skew = Skew().candidates(best.base->scope, 1).front();
  best.explanation =
      explain_on(asked.problem(), *best.base, best.base->fitted, {{skew, Vector(0), 0.0, 0.0}});
  best.named = {{.equation = 1, .name = "skew"}};
  best.rounds = {{7, "skew", 9.0, true}};
  best.left = {{1, 100.0, 9.0, 1.0, 0.5}};
  return best;
}

support::Asked friction() {
  support::Asked asked = support::asked(support::dry_friction, 0.01, support::own_effects());
  asked.options.effects.push_back(Skew());
  return asked;
}

TEST(SensorFault, DynamicsThatExplainMostTakeItsPlace) {
  const support::Asked asked = friction();
  const Proposals made = SensorFault().propose(asked.problem(), with_fault(asked));
  ASSERT_EQ(made.composites.size(), 1u);
  const CompositeModel& composite = made.composites[0].composite;
  EXPECT_EQ(composite.hypothesis, "sensor-fault");
  ASSERT_EQ(composite.named.size(), 1u);
  EXPECT_EQ(composite.named[0].name, "dry");
  EXPECT_TRUE(composite.explanation.fit.channel_terms.empty());
  EXPECT_EQ(composite.rounds.front().tried, 7) << "the rounds before come first";
  EXPECT_TRUE(std::holds_alternative<ByRule>(made.composites[0].judged));
}

}  // namespace
}  // namespace lacuna
