// SPDX-License-Identifier: MIT
// The journey with hypotheses and a criterion made for it: who is asked when, what decides,
// what the trail keeps.
#include "diagnose/journey/journey.hpp"

#include <gtest/gtest.h>

#include <chrono>

#include "support/asked.hpp"
#include "support/assimilated_oscillator.hpp"

namespace lacuna {
namespace {

using Phase = Hypothesis::Phase;

inline constexpr StageInfo kFirst{"first", "For tests", ""}, kSecond{"second", "For tests", ""},
    kDevianceOnly{"deviance-only", "For tests", ""};

/// Whatever costs nothing.
class DevianceOnly final : public Configured<Criterion, NoOptions<kDevianceOnly>> {
  double do_penalty(const Evidence&) const override { return 0.0; }
};

/// Proposes the best composite model with another deviance, and notes that it was asked.
template <const StageInfo& Info>
class Claims final : public Configured<Hypothesis, NoOptions<Info>> {
 public:
  Claims(Phase phase, double gain, std::optional<ByRule> rule = {})
      : phase_(phase), gain_(gain), rule_(std::move(rule)) {}

 private:
  Phase do_phase() const override { return phase_; }
  Proposals do_propose(const Problem&, const CompositeModel& best) const override {
    Proposal proposal{best};
    proposal.composite.hypothesis = Info.name;
    proposal.composite.explanation.fit.deviance -= gain_;
    proposal.composite.notes.push_back(std::string(Info.name));
    if (phase_ == Phase::Assumptions)
      proposal.composite.findings.push_back({.name = std::string(Info.name)});
    if (rule_) proposal.judged = *rule_;
    return {{std::move(proposal)},
            {{std::string(Info.name), "declined", {}, false, "reason", 1.0, 2.0}}};
  }
  Phase phase_;
  double gain_;
  std::optional<ByRule> rule_;
};

class Journey : public ::testing::Test {
 protected:
  Judged judged(Phase phase, const std::vector<Stage<Hypothesis>>& hypotheses) {
    const Problem problem{nominal_, records_, options_, context_};
    CompositeModel bare = bare_composite(problem, "bare", base(problem));
    return judge_phase(problem, in_order(hypotheses), phase, {std::move(bare)});
  }

  static std::shared_ptr<const Baseline> base(const Problem& problem) {
    static const Baseline made = plain_baseline(problem);
    return std::make_shared<const Baseline>(made);
  }

  OdeModel nominal_ = support::oscillator();
  BoundRecords records_ = observed(support::hidden_record(support::nothing, 0.01, 3));
  DiagnosisOptions options_{.criterion = DevianceOnly{}};
  RunContext context_;
};

TEST_F(Journey, TheCriterionDecides) {
  const Judged result = judged(Phase::Effects, {Claims<kFirst>(Phase::Effects, 5.0),
                                                Claims<kSecond>(Phase::Effects, -1.0)});
  EXPECT_EQ(result.best.hypothesis, "first");
  ASSERT_EQ(result.trail.size(), 4u);  // each declines one composite model and puts one forward
  EXPECT_TRUE(result.trail[1].taken);
  EXPECT_FALSE(result.trail[3].taken);
  EXPECT_EQ(result.trail[3].quantity, "deviance-only");
  EXPECT_NEAR(result.trail[3].value - result.trail[3].threshold, 1.0, 1e-6);
}

TEST_F(Journey, ARuleGoesBeforeTheNumberAndIsInTheTrail) {
  const Judged result =
      judged(Phase::Effects, {Claims<kFirst>(Phase::Effects, 5.0),
                              Claims<kSecond>(Phase::Effects, -1.0, ByRule{"it is a test"})});
  EXPECT_EQ(result.best.hypothesis, "second");
  EXPECT_EQ(result.trail.back().rule, "it is a test");
  EXPECT_TRUE(result.trail.back().taken);
}

TEST_F(Journey, EffectsAreSoughtOnTopOfAnAssumptionThatHasWon) {
  const Judged won = judged(Phase::Assumptions, {Claims<kFirst>(Phase::Effects, 1.0),
                                                 Claims<kSecond>(Phase::Assumptions, 5.0)});
  EXPECT_EQ(won.best.hypothesis, "second");
  EXPECT_EQ(won.best.notes, (std::vector<std::string>{"second", "first"}));
  const Judged lost = judged(Phase::Assumptions, {Claims<kFirst>(Phase::Effects, 1.0),
                                                  Claims<kSecond>(Phase::Assumptions, -5.0)});
  EXPECT_EQ(lost.best.hypothesis, "bare");
  EXPECT_TRUE(lost.best.notes.empty());
}

TEST_F(Journey, AnAssumptionThatDoesAsWellIsADoubt) {
  const auto doubts = [&](double gain) {
    std::vector<std::string> said;
    for (const Twin& twin :
         judged(Phase::Assumptions, {Claims<kSecond>(Phase::Assumptions, gain)}).best.twins)
      said.push_back(twin.sentence);
    return said;
  };
  EXPECT_EQ(doubts(5.0),
            std::vector<std::string>{"the records allow as well (bare): nothing is missing"});
  EXPECT_EQ(doubts(-5.0),
            std::vector<std::string>{"the records allow as well (second): second"});
  EXPECT_TRUE(doubts(15.0).empty());
  EXPECT_TRUE(doubts(-15.0).empty());
}

TEST_F(Journey, NamesThatDoNotExplainMostAreWithdrawn) {
  const Problem problem{nominal_, records_, options_, context_};
  CompositeModel composite = bare_composite(problem, "bare", base(problem));
  composite.named.push_back({.equation = 1, .name = "dry"});
  composite.left = {{1, 100.0, 9.0, 1.0, 0.5}};
  const Judged settled = settle_composite(problem, problem.context, {}, {composite});
  EXPECT_TRUE(settled.best.named.empty());
  ASSERT_EQ(settled.trail.size(), 1u);
  EXPECT_FALSE(settled.trail[0].taken);
}

/// A ripple of the force over q, called by the powers of a series of it.
CompositeModel called_a_series(const Problem& problem) {
  CompositeModel composite =
      bare_composite(problem, "bare", std::make_shared<const Baseline>(plain_baseline(problem)));
  std::vector<FittedEffect> effects;
  for (const char* power : {"q^3", "q^5", "q^7"}) {
    effects.push_back({support::plain_candidate(power), Vector(0), 0.0, 0.0});
    composite.named.push_back({.equation = 1, .name = power});
  }
  composite.explanation =
      explain_on(problem, *composite.base, composite.base->fitted, effects);
  composite.left = test_disturbances(composite.explanation.fit, problem.context);
  return composite;
}

TEST_F(Journey, NamesOfFunctionsThatAreOthersAreGivenBackWhileThereIsTime) {
  const support::Asked asked = support::asked(support::ripple, 0.002);
  const Problem problem = asked.problem();
  const CompositeModel composite = called_a_series(problem);
  ASSERT_TRUE(leaves_structure(composite, problem.options.decision));
  ASSERT_TRUE(closes_most(composite, problem));
  const std::vector<Stage<Hypothesis>> all = standard_hypotheses();
  const Judged settled = settle_composite(problem, problem.context, all, {composite});
  EXPECT_TRUE(settled.best.named.empty());
  ASSERT_FALSE(settled.trail.empty());
  EXPECT_EQ(settled.trail[0].composite, "one formula of q in dv/dt");
  ASSERT_TRUE(settled.best.unnamed);
  EXPECT_NE(settled.best.unnamed->formula.find("sin("), std::string::npos);
  RunContext late;
  late.deadline = std::chrono::steady_clock::now();
  EXPECT_EQ(settle_composite(problem, late, all, {composite}).best.named.size(), 3u);
  const Judged bare = settle_composite(problem, late, all, {asked.bare()});
  ASSERT_TRUE(bare.best.unnamed) << "every answer has a description";
  EXPECT_EQ(bare.best.unnamed->formula, "") << "that took time";
}

TEST_F(Journey, WhatOtherRecordsRefuteGoesNamesFirst) {
  const Problem problem{nominal_, records_, options_, context_};
  Baseline assumed = *base(problem);
  assumed.parameters = 1.0;
  CompositeModel composite =
      bare_composite(problem, "second", std::make_shared<const Baseline>(assumed));
  composite.named = {{.equation = 1, .name = "dry"}};
  composite.findings = {{.equation = 1, .name = "late"}};
  const CompositeModel nameless = without_claims(problem, composite, false);
  EXPECT_TRUE(nameless.named.empty());
  EXPECT_EQ(nameless.findings.size(), 1u);
  EXPECT_EQ(nameless.base->parameters, 1.0) << "on the same assumption";
  EXPECT_EQ(without_claims(problem, composite, true).base->parameters, 0.0);
  const CompositeModel plain = without_claims(problem, nameless, false);
  EXPECT_TRUE(plain.findings.empty());
  EXPECT_EQ(plain.base->parameters, 0.0);
}

}  // namespace
}  // namespace lacuna
