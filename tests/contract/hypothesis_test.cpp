// SPDX-License-Identifier: MIT
#include "lacuna/diagnose/hypotheses/hypothesis.hpp"

#include "contract/contract.hpp"
#include "effects/families.hpp"
#include "support/assimilated_oscillator.hpp"

namespace lacuna::contract {
namespace {

class EveryHypothesis : public testing::TestWithParam<StageVariant> {
 protected:
  /// What it proposes against the bare composite model of a record with something hidden in it.
  Proposals proposals(const support::Hidden& hidden) {
    records_ = observed(support::hidden_record(hidden, 0.01, 3));
    return stage_of<Hypothesis>(GetParam())->propose(problem(), bare());
  }

  Problem problem() const { return {nominal_, records_, options_, context_}; }

  CompositeModel bare() const {
    const Problem asked = problem();
    return bare_composite(asked, "bare",
                          std::make_shared<const Baseline>(plain_baseline(asked)));
  }

  OdeModel nominal_ = support::oscillator();
  BoundRecords records_;
  DiagnosisOptions options_{
      .effects = {FamilyEffect<kCoulombFriction>{}, FamilyEffect<kUnmeasuredInput>{}}};
  RunContext context_;
};

TEST_P(EveryHypothesis, ProposesCompositesOfTheSameRecords) {
  for (const Proposal& proposal : proposals(support::dry_friction).composites) {
    const CompositeModel& composite = proposal.composite;
    ASSERT_NE(composite.base, nullptr);
    EXPECT_EQ(composite.base->records->data.samples(), records_.data.samples());
    EXPECT_TRUE(std::isfinite(options_.criterion->value(evidence_of(composite))));
    EXPECT_TRUE(composite.named.empty() ||
                composite.named.size() == composite.explanation.effects.size());
  }
}

TEST_P(EveryHypothesis, SignsWhatItProposesAndDeclines) {
  const Proposals made = proposals(support::dry_friction);
  for (const Proposal& proposal : made.composites)
    EXPECT_EQ(proposal.composite.hypothesis, stage_of<Hypothesis>(GetParam())->info().name);
  for (const Rival& rival : made.trail) {
    EXPECT_EQ(rival.hypothesis, stage_of<Hypothesis>(GetParam())->info().name);
    EXPECT_FALSE(rival.quantity.empty());
  }
}

TEST_P(EveryHypothesis, NamesNothingWhereNothingIsMissing) {
  for (const Proposal& proposal : proposals(support::nothing).composites)
    EXPECT_TRUE(proposal.composite.named.empty()) << proposal.composite.named.front().name;
}

TEST_P(EveryHypothesis, DoesNotDependOnTheNumberOfThreads) {
  const Proposals one = proposals(support::dry_friction);
  context_.threads = 3;
  const Proposals three = proposals(support::dry_friction);
  ASSERT_EQ(one.composites.size(), three.composites.size());
  for (std::size_t i = 0; i < one.composites.size(); ++i)
    EXPECT_EQ(one.composites[i].composite.explanation.fit.deviance,
              three.composites[i].composite.explanation.fit.deviance);
}

TEST_P(EveryHypothesis, EndsWhenAsked) {
  records_ = observed(support::hidden_record(support::dry_friction, 0.01, 3));
  const CompositeModel best = bare();
  std::stop_source source;
  source.request_stop();
  context_.stop = source.get_token();
  EXPECT_THROW(stage_of<Hypothesis>(GetParam())->propose(problem(), best), Cancelled);
}

INSTANTIATE_TEST_SUITE_P(Registry, EveryHypothesis,
                         testing::ValuesIn(available(Hypothesis::kKind)), test_name);

}  // namespace
}  // namespace lacuna::contract
