// SPDX-License-Identifier: MIT
#include "diagnose/journey/answer.hpp"

#include <gtest/gtest.h>

#include "support/asked.hpp"
#include "support/assimilated_oscillator.hpp"

namespace lacuna {
namespace {

Gap gap(double before, double after) {
  Gap made;
  made.before = before;
  made.after = after;
  made.noise_floor = made.white_floor = 1.0;
  return made;
}

class Answer : public ::testing::Test {
 protected:
  /// The composite model that names a form in dv/dt, with structure of a significance left.
  CompositeModel composite(const std::string& form, double left = 0.0) const {
    CompositeModel made = asked_.bare();
    const Candidate candidate = support::plain_candidate(form);
    made.explanation.effects = {{candidate, Vector(0), -0.3, 0.01}};
    made.named = {{.equation = 1, .name = "dry"}};
    made.explanation.fit.noise.disturbance.setZero();  // it explains all there is
    made.left = {{1, 10.0, left, 1.0, 0.5}};
    return made;
  }
  CompositeModel nameless(double left) const {
    CompositeModel made = asked_.bare();
    made.left = {{1, 10.0, left, 1.0, 0.5}};
    return made;
  }
  HoldoutEvaluation evaluated(const CompositeModel& judged, const std::optional<Gap>& other,
                              bool continued = false) const {
    return evaluate_holdout(asked_.problem(), judged, other, continued);
  }
  Diagnosis answer(CompositeModel judged, const HoldoutEvaluation& evaluation = {}) const {
    return make_answer(asked_.problem(), {std::move(judged)}, {}, evaluation);
  }

  support::Asked asked_ = support::asked(support::nothing);
};

TEST_F(Answer, OtherRecordsConfirmLowerOrRefuteNames) {
  const CompositeModel friction = composite("sign(v)");
  EXPECT_TRUE(evaluated(friction, gap(10.0, 1.5)).note.empty());
  const HoldoutEvaluation little = evaluated(friction, gap(10.0, 9.0));
  EXPECT_TRUE(little.lower && !little.withdraw);
  const HoldoutEvaluation refuted = evaluated(friction, gap(10.0, 11.0));
  EXPECT_TRUE(refuted.withdraw);
  EXPECT_EQ(refuted.note.substr(0, 13), "with dry in v");
}

TEST_F(Answer, OtherRecordsHearAssumptionsLikeNames) {
  CompositeModel late = nameless(0.0);
  late.findings = {{.equation = 1, .name = "late"}};
  EXPECT_FALSE(evaluated(late, gap(10.0, 1.5)).lower);
  const HoldoutEvaluation little = evaluated(late, gap(10.0, 9.0));
  EXPECT_TRUE(little.lower && !little.withdraw);
  const HoldoutEvaluation refuted = evaluated(late, gap(10.0, 11.0));
  EXPECT_TRUE(refuted.withdraw);
  EXPECT_EQ(refuted.note.substr(0, 14), "with late in v");
}

TEST_F(Answer, AFormInTwoEquationsHasToHoldOnOtherRecords) {
  CompositeModel shared = composite("sign(v)");
  Gap open = gap(10.0, 1.8);
  open.above_floor = 5.0;
  EXPECT_FALSE(evaluated(shared, open).withdraw);
  shared.hypothesis = "shared-process";
  EXPECT_TRUE(evaluated(shared, open).withdraw);
  EXPECT_FALSE(evaluated(shared, gap(10.0, 1.2)).withdraw);
}

TEST_F(Answer, ThresholdsDecideWhatOtherRecordsSay) {
  const CompositeModel friction = composite("sign(v)");
  asked_.options.decision.negligible = 0.2;
  EXPECT_FALSE(evaluated(friction, gap(10.0, 11.0)).withdraw) << "a tenth more is none";
  asked_.options.decision = {};
  // (100 - 40) / (100 - 1) of the square above the floor goes.
  EXPECT_FALSE(evaluated(friction, gap(10.0, std::sqrt(40.0))).lower);
  asked_.options.decision.major = 0.7;
  EXPECT_TRUE(evaluated(friction, gap(10.0, std::sqrt(40.0))).lower);
}

/// Four windows of ten samples in which two models are off by so much.
Gap in_windows(double before, const std::vector<double>& after) {
  const auto samples = static_cast<Index>(10 * after.size());
  GapRecord run;
  run.time = Vector::LinSpaced(samples, 0.0, static_cast<double>(samples - 1));
  run.measured = run.time.array().sin().matrix();
  run.before = (run.measured.array() + before).matrix();
  run.after = run.measured;
  for (std::size_t w = 0; w < after.size(); ++w)
    run.after.middleRows(static_cast<Index>(10 * w), 10).array() += after[w];
  run.length = 10;
  Gap made = gap(1.05, 1.0);
  made.runs = {run};
  return made;
}

TEST_F(Answer, AGainOnOtherRecordsIsComparedWithItsScatter) {
  // Gains of 30 and 40 twice: 35 over the root of (100 / 3) / 4.
  const auto gain = deviations_of_gain(in_windows(2.0, {1.0, 0.0, 1.0, 0.0}));
  ASSERT_TRUE(gain.has_value());
  EXPECT_NEAR(*gain, 35.0 / std::sqrt(100.0 / 12.0), 1e-9);
  EXPECT_FALSE(deviations_of_gain(in_windows(2.0, {1.0})).has_value()) << "one has no scatter";
}

TEST_F(Answer, NamesHaveToShowBeyondAFitOfCoefficients) {
  const Problem problem = asked_.problem();
  const CompositeModel friction = composite("sign(v)");
  const auto withdrawn = [&](const CompositeModel& judged, const Gap& other) {
    return evaluate_names(problem, judged, other).withdraw;
  };
  EXPECT_FALSE(withdrawn(friction, in_windows(2.0, {1.0, 0.0, 1.0, 0.0})));
  const Gap unseen = in_windows(1.0, {0.9, 1.1, 0.8, 1.2});
  EXPECT_TRUE(withdrawn(friction, unseen)) << "its gains are as often losses";
  Gap shown = unseen;
  shown.before = 1.5;
  EXPECT_FALSE(withdrawn(friction, shown)) << "the gap that is there is closed";
  EXPECT_TRUE(withdrawn(friction, gap(2.0, 2.2))) << "worse than coefficients alone";
  EXPECT_FALSE(withdrawn(composite("sin(t)"), unseen)) << "need not come again";
  EXPECT_FALSE(withdrawn(nameless(0.0), unseen));
}

TEST_F(Answer, NamesBesideAGapThatStaysHaveToCloseMostOfIt) {
  const CompositeModel friction = composite("sign(v)");
  const auto withdrawn = [&](const Gap& other) {
    return evaluate_names(asked_.problem(), friction, other).withdraw;
  };
  EXPECT_FALSE(withdrawn(gap(10.0, 3.2))) << "91 % of 99 go";
  EXPECT_TRUE(withdrawn(gap(10.0, 3.5))) << "89 % of 99 go";
  EXPECT_FALSE(withdrawn(gap(3.0, 1.4))) << "none stays, by DecisionOptions::explained_gap";
  asked_.options.decision.least_closed = 0.5;
  EXPECT_FALSE(withdrawn(gap(10.0, 3.5)));
  EXPECT_FALSE(evaluate_names(asked_.problem(), composite("sin(t)"), gap(10.0, 9.0)).withdraw)
      << "need not come again";
}

TEST_F(Answer, WhatIsLessThanTheNoiseIsNotToldFromRounding) {
  const Problem problem = asked_.problem();
  CompositeModel friction = composite("sign(v)");
  const Gap below = in_windows(1.05, {1.0, 0.9, 1.0, 0.9});
  const auto is_withdrawn = [&](const Gap& other) {
    return evaluate_names(problem, friction, other).withdraw;
  };
  EXPECT_FALSE(is_withdrawn(below));
  friction.explanation.fit.noise.lattice = {0.0, 0.1};
  EXPECT_TRUE(is_withdrawn(below));
  Gap shown = below;
  shown.before = 1.5;
  EXPECT_FALSE(is_withdrawn(shown));
}

TEST_F(Answer, SamplesThatRepeatNeedMoreThanALittle) {
  CompositeModel friction = composite("sign(v)");
  Baseline base = *friction.base;
  BoundRecords coarse = *base.records;
  for (Channel& channel : coarse.channels) channel.repeats = 0.9;
  ASSERT_TRUE(mostly_repeats(coarse));
  base.records = std::make_shared<const BoundRecords>(coarse);
  friction.base = std::make_shared<const Baseline>(base);
  EXPECT_TRUE(evaluated(friction, gap(10.0, 9.0)).withdraw);
  EXPECT_FALSE(evaluated(friction, gap(10.0, 1.5)).withdraw);
}

TEST_F(Answer, WhatNeedNotComeAgainIsNotAskedForIt) {
  const HoldoutEvaluation other = evaluated(composite("sin(5*t)"), gap(10.0, 11.0));
  EXPECT_TRUE(other.lower && !other.withdraw);
  EXPECT_FALSE(evaluated(composite("sin(5*t)"), gap(10.0, 1.5)).lower);
  EXPECT_FALSE(evaluated(nameless(0.0), gap(10.0, 11.0)).withdraw) << "there is no name";
  EXPECT_TRUE(evaluated(composite("sin(5*t)"), std::nullopt).lower) << "nothing was compared";
}

TEST_F(Answer, WhatOnlyOneRecordShowsHasToLeaveWhiteNoiseThere) {
  const Gap worse = gap(10.0, 11.0);
  EXPECT_TRUE(evaluated(composite("sin(5*t)", 10.0), worse).withdraw);
  EXPECT_FALSE(evaluated(composite("sin(5*t)", 10.0), gap(10.0, 1.5)).withdraw);
  CompositeModel remembering = composite("sin(5*t)");
  remembering.explanation.fit.noise.coloured.resize(2);
  remembering.explanation.fit.noise.coloured[1] = ColouredNoise{0.1, 2.0};
  EXPECT_TRUE(evaluated(remembering, worse).withdraw);
}

TEST_F(Answer, WhatDependsOnTimeGoesOnInTheRestOfARecord) {
  EXPECT_TRUE(evaluated(composite("sin(5*t)"), gap(10.0, 9.0), true).withdraw);
  EXPECT_FALSE(evaluated(composite("sin(5*t)"), gap(10.0, 1.5), true).withdraw);
}

TEST_F(Answer, WhatDependsOnTimeHasToShowOnOtherRecordsByItself) {
  CompositeModel both = composite("sign(v)");
  both.explanation.effects.push_back(composite("sin(5*t)").explanation.effects[0]);
  both.named.push_back({.equation = 0, .name = "hum"});
  const auto evaluated = [&](double without) {
    return evaluate_time(asked_.problem(), both, gap(10.0, without), gap(10.0, 1.0));
  };
  EXPECT_TRUE(evaluated(1.04).lower);
  EXPECT_FALSE(evaluated(1.04).withdraw);
  EXPECT_NE(evaluated(0.9).note.find("(hum in q)"), std::string::npos) << evaluated(0.9).note;
  EXPECT_FALSE(evaluated(1.06).lower);
  EXPECT_FALSE(evaluated(INFINITY).lower) << "without it there is no model";
  asked_.options.decision.negligible = 0.1;
  EXPECT_TRUE(evaluated(1.06).lower);
}

TEST_F(Answer, AnInputThatFollowsEverySampleExplainsNothing) {
  CompositeModel driven = composite("u");
  driven.explanation.effects[0].candidate.memory = {
      {"u", parse_expression("-u"), parse_expression("0"), true}};
  EXPECT_TRUE(evaluated(driven, gap(10.0, 11.0)).withdraw) << "others are worse with it";
  EXPECT_FALSE(evaluated(driven, gap(10.0, 9.0)).withdraw);
  EXPECT_TRUE(evaluated(driven, gap(10.0, 9.0)).lower);
  EXPECT_FALSE(evaluated(driven, gap(10.0, 1.5)).lower);
  Baseline base = *driven.base;
  base.fit_options.hidden = {false, true};
  driven.base = std::make_shared<const Baseline>(base);
  EXPECT_TRUE(evaluated(driven, gap(10.0, 9.0)).withdraw) << "of a state that nobody measured";
}

TEST_F(Answer, AModelThatRunsAwayGetsNoName) {
  Gap away = gap(10.0, 1.5);
  away.free_before = {2.0, 10.0};
  away.free_after = {1.5, 10.0};
  EXPECT_TRUE(evaluated(composite("sign(v)"), away).withdraw);
  CompositeModel driven = composite("u");
  driven.explanation.effects[0].candidate.memory = {
      {"u", parse_expression("-u"), parse_expression("0"), true}};
  EXPECT_FALSE(evaluated(driven, away).withdraw) << "no worse than without it";
  away.free_after = {50.0, 10.0};
  EXPECT_TRUE(evaluated(driven, away).withdraw);
}

TEST_F(Answer, TheVerdictIsNamesAndWhatIsLeft) {
  EXPECT_EQ(answer(composite("sign(v)")).verdict, Verdict::Explained);
  EXPECT_EQ(answer(composite("sign(v)", 5.0)).verdict, Verdict::PartlyExplained);
  EXPECT_EQ(answer(nameless(5.0)).verdict, Verdict::UnnamedStructure);
  EXPECT_EQ(answer(nameless(0.0)).verdict, Verdict::NoDiscrepancy);
  asked_.options.decision.significance = 6.0;
  EXPECT_EQ(answer(composite("sign(v)", 5.0)).verdict, Verdict::Explained);
  EXPECT_EQ(answer(nameless(5.0)).verdict, Verdict::NoDiscrepancy);
}

TEST_F(Answer, CoefficientsAreOffFromBothThresholdsOn) {
  asked_ = support::asked([](double, double q, double) { return 0.4 * q; });
  EXPECT_EQ(answer(nameless(0.0)).verdict, Verdict::CoefficientsOnly);
  asked_.options.decision.effect_size = 0.5;  // 0.4 q is about a tenth of the rate
  EXPECT_EQ(answer(nameless(0.0)).verdict, Verdict::NoDiscrepancy);
}

TEST_F(Answer, WhatExplainsHardlyAnythingStandsApart) {
  CompositeModel judged = composite("sign(v)");
  for (const char* form : {"v*abs(v)", "q^3"})
    judged.explanation.effects.push_back(
        {support::plain_candidate(form), Vector(0), -0.1, 0.01});
  judged.named = {{.equation = 1, .name = "first", .gap_closed = 4e-4},
                  {.equation = 1, .name = "second", .gap_closed = 0.9},
                  {.equation = 1, .name = "third", .gap_closed = 2e-3}};
  judged.findings = {{.equation = 1, .name = "fourth", .gap_closed = -1e-5}};
  const auto names = [](const std::vector<NamedEffect>& effects) {
    std::string all;
    for (const NamedEffect& effect : effects) all += effect.name + " ";
    return all;
  };
  const Diagnosis found = answer(judged);
  EXPECT_EQ(names(found.effects), "second third ");
  EXPECT_EQ(names(found.minor_effects), "first fourth ");
  judged.findings.clear();
  judged.named.resize(1);
  judged.explanation.effects.resize(1);
  const Diagnosis alone = answer(judged);
  EXPECT_EQ(names(alone.effects), "first ") << "by itself it is the finding";
  EXPECT_TRUE(alone.minor_effects.empty());
}

TEST_F(Answer, WindowsWithoutASolutionAndNoiseWithAMemoryAreNoted) {
  CompositeModel judged = nameless(0.0);
  judged.explanation.fit.noise.coloured[0] = ColouredNoise{0.05, 2.0};
  Gap other = gap(2.0, 1.0);
  other.diverged = 3;
  const Diagnosis result = make_answer(asked_.problem(), {judged}, other, {});
  ASSERT_GE(result.notes.size(), 2u);
  const auto& notes = result.notes;
  EXPECT_NE(notes[notes.size() - 2].find("in 3 windows"), std::string::npos);
  EXPECT_NE(notes.back().find("q 0.05 m over 2 s"), std::string::npos) << notes.back();
}

TEST_F(Answer, TheAdequacyIsThatOfTheEquationsAndOfOtherRecords) {
  const Diagnosis fine = answer(nameless(0.0));
  EXPECT_EQ(fine.adequacy.fits, Adequate::Yes);
  ASSERT_EQ(fine.adequacy.parts.size(), 2u);
  EXPECT_EQ(fine.adequacy.samples(), 2 * asked_.problem().records.data.samples());
  const Diagnosis left = answer(nameless(5.0));
  EXPECT_EQ(left.adequacy.fits, Adequate::No);
  EXPECT_EQ(left.adequacy.parts[0].fits, Adequate::Yes);
  EXPECT_EQ(left.adequacy.parts[1].fits, Adequate::No);
  Gap open = gap(10.0, 9.0);
  open.above_floor = 9.0;
  EXPECT_EQ(make_answer(asked_.problem(), {nameless(0.0)}, open, {}).adequacy.fits,
            Adequate::No);
}

TEST_F(Answer, WhatStaysOpenOnOtherRecordsIsStructureWithoutAName) {
  Gap open = gap(10.0, 9.0);
  open.above_floor = 9.0;
  const Diagnosis elsewhere = make_answer(asked_.problem(), {nameless(0.0)}, open, {});
  EXPECT_EQ(elsewhere.verdict, Verdict::UnnamedStructure);
  EXPECT_TRUE(elsewhere.remaining.structure);
  EXPECT_TRUE(elsewhere.remaining.equations.empty());
  EXPECT_EQ(elsewhere.augmented.coefficient(1, "q"), -4.0) << "the model stays as it was";
  EXPECT_EQ(make_answer(asked_.problem(), {nameless(0.0)}, gap(1.2, 1.1), {}).verdict,
            Verdict::NoDiscrepancy);
}

TEST_F(Answer, CoefficientsBesideWhatHasNoNameStayWhereOthersGetWorse) {
  const auto with_gap = [&](double after) {
    CompositeModel judged = nameless(5.0);
    OdeModel& model = judged.explanation.fit.model;
    std::vector<Equation> equations = model.equations();
    for (WeightedTerm& summand : equations[1]) summand.coefficient *= 1.5;
    model = model.with_equations(std::move(equations));
    return make_answer(asked_.problem(), {judged}, gap(10.0, after), {});
  };
  const Diagnosis worse = with_gap(14.0), better = with_gap(7.0);
  EXPECT_EQ(worse.verdict, Verdict::UnnamedStructure);
  EXPECT_EQ(worse.gap->after, 10.0);
  EXPECT_EQ(worse.augmented.coefficient(1, "q"), -4.0);
  EXPECT_TRUE(worse.coefficient_changes.empty());
  EXPECT_NE(worse.notes.back().find("stay as given"), std::string::npos) << worse.notes.back();
  EXPECT_EQ(better.gap->after, 7.0);
  EXPECT_NEAR(better.augmented.coefficient(1, "q"), -6.0, 0.01);
}

TEST_F(Answer, AModelWhoseHiddenEquationIsTurnedOffLacksStructure) {
  EXPECT_EQ(answer(support::turned_off(nameless(0.0), 1)).verdict, Verdict::UnnamedStructure);
  EXPECT_EQ(answer(support::turned_off(composite("sign(v)"), 1)).verdict,
            Verdict::PartlyExplained);
}

}  // namespace
}  // namespace lacuna
