// SPDX-License-Identifier: MIT
#include "diagnose/journey/reservations.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "support/asked.hpp"
#include "support/assimilated_oscillator.hpp"

namespace lacuna {
namespace {

Gap gap_of(double after, double above) {
  Gap made;
  made.before = 10.0;
  made.after = after;
  made.noise_floor = made.white_floor = 1.0;
  made.above_floor = above;
  return made;
}

class Reservations : public ::testing::Test {
 protected:
  CompositeModel composite(const FittedEffect& effect) const {
    CompositeModel made = asked_.bare();
    made.explanation.effects = {effect};
    made.named = {{.equation = 1, .name = "stop"}};
    made.explanation.fit.noise.disturbance.setZero();  // it explains all there is
    return made;
  }
  FittedEffect stop(double edge) const {
    return {support::stop_candidate(0.0), Vector::Constant(1, edge), -3.0, 0.01};
  }
  std::vector<std::string> said(const CompositeModel& judged,
                                const std::optional<Gap>& other = {}) const {
    return reservations(asked_.problem(), judged, other);
  }
  static bool speaks_of(const std::vector<std::string>& said, const std::string& what) {
    return said.size() == 1 && said[0].find(what) != std::string::npos;
  }

  support::Asked asked_ = support::asked(support::nothing);
};

TEST_F(Reservations, NoneWhereNamesAndNumbersAreAsTheyShouldBe) {
  EXPECT_TRUE(said(composite(stop(-0.1)), gap_of(1.2, 9.0)).empty());
  EXPECT_TRUE(speaks_of(said(asked_.bare(), gap_of(5.0, 9.0)), "5 times its noise floor"))
      << "something acts there that the records that were used do not show";
}

TEST_F(Reservations, TheGapStaysOpenByMoreThanChance) {
  const CompositeModel bare = asked_.bare();
  EXPECT_TRUE(said(bare, gap_of(1.4, 9.0)).empty());
  EXPECT_TRUE(speaks_of(said(bare, gap_of(1.6, 4.0)), "1.6 times its noise floor"));
  EXPECT_TRUE(said(bare, gap_of(1.6, 2.0)).empty());
  EXPECT_TRUE(said(bare, gap_of(1.9, 0.0)).empty());
  EXPECT_TRUE(speaks_of(said(bare, gap_of(2.1, 0.0)), "2.1 times its noise"))
      << "no scatter hides a gap of twice the noise";
  asked_.options.decision.explained_gap = 2.0;
  EXPECT_TRUE(said(bare, gap_of(1.6, 4.0)).empty());
}

TEST_F(Reservations, BesideNamesNoScatterExcusesAGap) {
  const CompositeModel judged = composite(stop(-0.1));
  EXPECT_TRUE(said(judged, gap_of(1.29, 9.0)).empty()) << "noise with a memory makes that";
  EXPECT_TRUE(speaks_of(said(judged, gap_of(1.31, 0.0)), "1.31 times its noise floor"));
  asked_.options.decision.noise_inflation = 1.4;
  EXPECT_TRUE(said(judged, gap_of(1.31, 0.0)).empty());
  CompositeModel fault = asked_.bare();
  fault.findings = {{.equation = 1, .name = "sensor-lag"}};
  EXPECT_TRUE(said(fault, gap_of(1.45, 0.0)).empty()) << "an approximation";
}

TEST_F(Reservations, WhereNothingIsNamedWhatHasAMemoryIsNoNoise) {
  Gap slow = gap_of(5.0, 9.0);
  slow.white_floor = 0.1;
  EXPECT_TRUE(speaks_of(said(asked_.bare(), slow), "at 50 times its noise floor"));
  EXPECT_TRUE(speaks_of(said(composite(stop(-0.1)), slow),
                        "at 5 times its noise floor, with noise that has a memory"));
}

TEST_F(Reservations, AModelThatRunsAwayIsNone) {
  Gap away = gap_of(1.0, 0.0);
  EXPECT_FALSE(runs_away(away, asked_.options.decision)) << "nothing was compared";
  away.free_after = {0.4, 10.0};
  EXPECT_FALSE(runs_away(away, asked_.options.decision));
  away.free_after = {1.2, 10.0};
  EXPECT_TRUE(runs_away(away, asked_.options.decision));
  EXPECT_TRUE(speaks_of(said(composite(stop(-0.1)), away), "1.2 times their spread"));
  away.free_after = {INFINITY, 10.0};
  EXPECT_TRUE(runs_away(away, asked_.options.decision));
  asked_.options.decision.diverging = 2.0;
  away.free_after = {1.2, 10.0};
  EXPECT_FALSE(runs_away(away, asked_.options.decision));
}

TEST_F(Reservations, NamesWithWhichTheModelIsDisturbedAsBeforeAreSaid) {
  asked_ = support::asked(support::ripple);  // the stop stands for nothing of it
  CompositeModel judged = composite(stop(-0.1));
  EXPECT_TRUE(said(judged).empty());
  judged.explanation.fit.noise.disturbance = 0.98 * judged.base->fitted.noise.disturbance;
  EXPECT_TRUE(speaks_of(said(judged), "only 4 %"));
  asked_.options.decision.minor = 0.03;
  EXPECT_TRUE(said(judged).empty());
}

TEST_F(Reservations, AShapeOnItsBoundIsSaid) {
  FittedEffect effect = stop(-0.1);
  effect.candidate.shapes[0].low = -0.1;
  EXPECT_TRUE(speaks_of(said(composite(effect)), "sits on its bound: edge"));
  effect.candidate.shapes[0].low = -0.11;
  EXPECT_TRUE(said(composite(effect)).empty());
}

TEST_F(Reservations, TermsThatCancelAreSaid) {
  CompositeModel judged = composite(stop(-0.1));
  judged.explanation.effects.push_back(judged.explanation.effects[0]);
  judged.explanation.effects[1].coefficient *= -1.01;
  judged.named.push_back(judged.named[0]);
  EXPECT_TRUE(speaks_of(said(judged), "nearly cancel"));
  asked_.options.decision.cancelling = 1e-3;
  EXPECT_TRUE(said(judged).empty());
}

TEST_F(Reservations, CoefficientsOfAnotherSignOrSizeAreSaid) {
  const CompositeModel judged = composite(stop(-0.1));
  OdeModel given = asked_.nominal;
  std::vector<Equation> equations = given.equations();
  for (WeightedTerm& summand : equations[1])
    if (summand.term.name() == "q") summand.coefficient *= -1.0;
  asked_.nominal = {given.states(), given.inputs(), equations, given.time_unit()};
  const std::vector<std::string> turned = said(judged);
  ASSERT_FALSE(turned.empty());
  EXPECT_NE(turned.front().find("changes its sign: 4 to -4"), std::string::npos)
      << turned.front();
}

TEST_F(Reservations, AHiddenStateWhoseEquationIsTurnedOffIsSaid) {
  const CompositeModel judged = support::turned_off(asked_.bare(), 1);
  EXPECT_TRUE(speaks_of(said(judged), "only without dv/dt")) << "nothing has a name";
  EXPECT_EQ(equations_turned_off(asked_.problem(), judged), std::vector<Index>{1});
  EXPECT_TRUE(equations_turned_off(asked_.problem(), asked_.bare()).empty());
  CompositeModel one_left = judged;
  OdeModel& fitted = one_left.explanation.fit.model;
  std::vector<Equation> equations = fitted.equations();
  equations[1][0].coefficient *= 11.0;
  fitted = fitted.with_equations(equations);
  EXPECT_TRUE(said(one_left).empty()) << "a term that is still there moves the state";
  asked_.options.decision.out_of_scale = 200.0;
  EXPECT_TRUE(said(judged).empty());
}

TEST_F(Reservations, CoefficientsThatChangeMuchBesideHiddenStatesAreSaid) {
  CompositeModel judged = composite(stop(-0.1));
  OdeModel given = asked_.nominal;
  std::vector<Equation> equations = given.equations();
  for (WeightedTerm& summand : equations[1])
    if (summand.term.name() == "v") summand.coefficient *= 3.0;  // the fit has a third of it
  asked_.nominal = given.with_equations(equations);
  EXPECT_TRUE(said(judged).empty()) << "every state is measured";
  Baseline base = *judged.base;
  base.fit_options.hidden = {false, true};
  judged.base = std::make_shared<const Baseline>(base);
  EXPECT_TRUE(speaks_of(said(judged), "the nominal coefficient of v in dv/dt changes from -0.6"));
  asked_.options.decision.rescaled = 4.0;
  EXPECT_TRUE(said(judged).empty());
  asked_.options.decision.rescaled = 2.0;
  judged.explanation.effects[0].candidate.form = parse_expression("tanh(v)*q");
  EXPECT_TRUE(said(judged).empty()) << "the effect may stand in the place of the term";
}

TEST_F(Reservations, AnEffectOfFewSamplesIsSaid) {
  const CompositeModel bare = asked_.bare();
  Vector q = bare.explanation.fit.records[0].slots.col(0);
  std::sort(q.begin(), q.end());
  FittedEffect rare = stop(q[q.size() / 200]);  // half a per cent lies below
  rare.candidate.shapes[0].low = -10.0;
  EXPECT_TRUE(speaks_of(said(composite(rare)), "of the samples only"));
  asked_.options.decision.acting = 0.0;
  EXPECT_TRUE(said(composite(rare)).empty());
}

TEST_F(Reservations, ALawThatLeavesLittleButNotByChanceIsSaid) {
  CompositeModel judged = composite(stop(-0.1));
  const auto leaves = [&](double sigma, double relative) {
    judged.left = {{.equation = 1, .sigma = sigma, .relative = relative}};
    return said(judged);
  };
  EXPECT_TRUE(speaks_of(leaves(7.8, 4.6e-4), "structure in dv/dt that is small (0.046 %"));
  EXPECT_TRUE(leaves(2.9, 4.6e-4).empty()) << "chance does that";
  EXPECT_TRUE(leaves(178.0, 9e-5).empty()) << "solvers and interpolated inputs leave that";
  EXPECT_TRUE(leaves(7.8, 2e-3).empty()) << "the verdict counts it as structure";
  judged.explanation.effects[0].candidate.form = parse_expression("sign(v)");
  EXPECT_TRUE(leaves(9.5, 6.4e-4).empty()) << "when it jumps is known to a step";
  judged.explanation.effects[0].candidate.form = parse_expression("v^3");
  judged.named.clear();
  EXPECT_TRUE(leaves(7.8, 4.6e-4).empty()) << "nothing claims to explain";
}

TEST_F(Reservations, OneChannelDoesNotConfirmTwoEffectsBesideAHiddenState) {
  CompositeModel two = composite(stop(-0.1));
  two.named.push_back({.equation = 0, .name = "another"});
  two.explanation.effects.push_back(stop(-0.1));
  EXPECT_TRUE(said(two).empty()) << "every state is measured";
  Baseline base = *two.base;
  base.fit_options.hidden = {false, true};
  two.base = std::make_shared<const Baseline>(std::move(base));
  asked_.records.data.reconstructed = {false, true};
  EXPECT_TRUE(speaks_of(said(two), "2 effects beside hidden states, and one channel"));
  two.named[1].name = "stop";
  EXPECT_TRUE(said(two).empty()) << "one process in two equations";
}

}  // namespace
}  // namespace lacuna
