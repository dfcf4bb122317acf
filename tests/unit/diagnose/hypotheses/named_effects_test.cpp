// SPDX-License-Identifier: MIT
#include "diagnose/hypotheses/named_effects.hpp"

#include <gtest/gtest.h>

#include "support/asked.hpp"
#include "support/assimilated_oscillator.hpp"
#include "support/own_effects.hpp"

namespace lacuna {
namespace {

support::Asked asked_of(const support::Hidden& hidden) {
  return support::asked(hidden, 0.01, support::own_effects());
}

/// The composite model that a form with a shape was chosen first, which does a little of dry
/// friction.
CompositeModel wrong_choice(const support::Asked& asked) {
  Candidate special = support::plain_candidate("v*abs(v)/(s+abs(v))");
  special.shapes = {{"s", "m/s", 0.1, 10.0, false}};
  special.starts = {Vector::Constant(1, 1.0)};
  CompositeModel composite = asked.bare();
  composite.explanation = explain_on(asked.problem(), *composite.base, composite.base->fitted,
                                     {{special, special.starts.front(), -0.1, 0.0}});
  composite.named = {{.equation = 1, .name = "special"}};
  composite.left = test_disturbances(composite.explanation.fit, asked.context);
  return composite;
}

TEST(OtherChoices, TakeThePlaceOfAFirstChoiceThatLeavesSomething) {
  const support::Asked asked = asked_of(support::dry_friction);
  CompositeModel first = wrong_choice(asked);
  first.notes = {"a note"};
  ASSERT_TRUE(has_residual_structure(first.left, asked.options.decision));
  const Proposals made = OtherChoices().propose(asked.problem(), first);
  ASSERT_EQ(made.composites.size(), 1u);
  const Proposal& proposal = made.composites[0];
  ASSERT_EQ(proposal.composite.named.size(), 1u);
  EXPECT_EQ(proposal.composite.named[0].name, "dry");
  EXPECT_EQ(proposal.composite.notes, first.notes);
  EXPECT_EQ(std::get<ByCriterion>(proposal.judged).lead, -asked.options.decision.undecided)
      << "it has fewer parameters";
  EXPECT_FALSE(made.trail.empty());
}

TEST(OtherChoices, DoNotTakeThePlaceOfWhatLeavesLessInWindows) {
  support::Asked asked = asked_of(support::dry_friction);
  CompositeModel first = wrong_choice(asked);
  std::vector<FittedEffect> both = first.explanation.effects;
  both.push_back({support::plain_candidate("sign(v)"), Vector(0), -0.3, 0.0});
  first.explanation =
      explain_on(asked.problem(), *first.base, first.base->fitted, std::move(both));
  first.explanation.fit.deviance += 2e4;  // as if it were worse from sample to sample
  EXPECT_EQ(OtherChoices().propose(asked.problem(), first).composites.size(), 1u)
      << "dry friction, which leaves as little";
  asked.options.effects = {support::FormEffect<support::kCubic>("q^3")};
  EXPECT_TRUE(OtherChoices().propose(asked.problem(), first).composites.empty())
      << "a cubic spring, which leaves more";
}

TEST(OtherChoices, TakeThePlaceOfAFirstChoiceWhoseTimeEndedWhereItsRangeDoes) {
  const support::Asked asked = asked_of(support::dry_friction);
  CompositeModel first = wrong_choice(asked);
  first.left.clear();  // as if it left nothing
  FittedEffect& chosen = first.explanation.effects[0];
  chosen.candidate.form = parse_expression("delay(q,s)-q");
  chosen.shapes[0] = 1.0;
  EXPECT_TRUE(OtherChoices().propose(asked.problem(), first).composites.empty());
  chosen.shapes[0] = chosen.candidate.shapes[0].low;
  const Proposals made = OtherChoices().propose(asked.problem(), first);
  ASSERT_EQ(made.composites.size(), 1u);
  ASSERT_EQ(made.composites[0].composite.named.size(), 1u);
  EXPECT_EQ(made.composites[0].composite.named[0].name, "dry");
}

}  // namespace
}  // namespace lacuna
