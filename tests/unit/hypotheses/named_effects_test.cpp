// SPDX-License-Identifier: MIT
#include "lacuna/hypotheses/named_effects.hpp"

#include <gtest/gtest.h>

#include "support/asked.hpp"
#include "support/assimilated_oscillator.hpp"
#include "support/own_effects.hpp"

namespace lacuna {
namespace {

support::Asked asked_of(const support::Hidden& hidden) {
  return support::asked(hidden, 0.01, support::own_effects());
}

TEST(NamedEffects, TheAccountHasTheEffectOnTopOfItsBaseline) {
  const support::Asked asked = asked_of(support::dry_friction);
  const auto base = asked.baseline();
  const SearchedAccount found = searched(asked.problem(), base, asked.options.effects);
  EXPECT_EQ(found.account.base, base);
  ASSERT_EQ(found.account.named.size(), 1u);
  EXPECT_EQ(found.account.named[0].name, "dry");
  EXPECT_NEAR(found.account.named[0].coefficient, -0.3, 0.02);
  EXPECT_FALSE(leaves_structure(found.account, asked.options.decision));
  EXPECT_FALSE(found.account.refitted) << "nothing is left over";
  EXPECT_FALSE(found.rivals.empty());
}

TEST(NamedEffects, AProposalKeepsWhatTheAssumptionsFoundAndIsLeftToTheCriterion) {
  const support::Asked asked = asked_of(support::dry_friction);
  Account best = asked.bare();
  best.findings = {{.name = "an assumption"}};
  best.notes = {"a note"};
  const Proposals made = NamedEffects().propose(asked.problem(), best);
  ASSERT_EQ(made.accounts.size(), 1u);
  const Proposal& proposal = made.accounts[0];
  EXPECT_EQ(proposal.account.findings[0].name, "an assumption");
  EXPECT_EQ(proposal.account.notes, best.notes);
  EXPECT_TRUE(proposal.precedence.empty());
  EXPECT_LT(asked.options.criterion->value(evidence_of(proposal.account)),
            asked.options.criterion->value(evidence_of(best)));
}

TEST(NamedEffects, OfACompleteModelItsAccountIsNoBetterThanTheBareOne) {
  const support::Asked asked = asked_of(support::nothing);
  const Account bare = asked.bare();
  const Proposals made = NamedEffects().propose(asked.problem(), bare);
  ASSERT_EQ(made.accounts.size(), 1u);
  EXPECT_TRUE(made.accounts[0].account.named.empty());
  EXPECT_EQ(asked.options.criterion->value(evidence_of(made.accounts[0].account)),
            asked.options.criterion->value(evidence_of(bare)));
}

TEST(NamedEffects, OnlyTheEffectsThatAreGivenAreTried) {
  const support::Asked asked = asked_of(support::dry_friction);
  const SearchedAccount found = searched(asked.problem(), asked.baseline(),
                                         {support::FormEffect<support::kCubic>("q^3")});
  for (const NamedEffect& named : found.account.named) EXPECT_EQ(named.name, "cubic");
  EXPECT_TRUE(leaves_structure(found.account, asked.options.decision));
}

}  // namespace
}  // namespace lacuna
