// SPDX-License-Identifier: MIT
#include "identify/validation/judgement.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace lacuna {
namespace {

using ::testing::HasSubstr;

PredictionError error_of(double error, double noise, bool seen, double motion,
                         double freedom = 400.0) {
  return {"x", error, noise, seen, motion, freedom, 0.0};
}

Validation judged(const PredictionError& one_step, const PredictionError& windows) {
  Validation validation{.samples = 500, .refitted = true};
  validation.one_step = {0.01, 200, 0, {one_step}};
  validation.windows = {1.0, 20, 0, {windows}};
  judge({}, validation);
  return validation;
}

TEST(Judgement, AnErrorAboveTheNoiseIsAnApproximationOrNone) {
  EXPECT_EQ(judged(error_of(0.01, 0.01, true, 0.02), error_of(0.03, 0.01, true, 1.0)).verdict,
            ValidationVerdict::Approximation);
  EXPECT_EQ(judged(error_of(0.01, 0.01, true, 0.02), error_of(0.3, 0.01, true, 1.0)).verdict,
            ValidationVerdict::WrongLibrary);
  EXPECT_EQ(judged(error_of(0.002, 1e-4, true, 0.01), error_of(1e-4, 1e-4, true, 1.0)).verdict,
            ValidationVerdict::Approximation);
}

TEST(Judgement, ChanceIsAllowedForFewSamples) {
  const PredictionError fine = error_of(0.01, 0.01, true, 1.0);
  EXPECT_EQ(judged(fine, error_of(0.015, 0.01, true, 1.0, 35.0)).verdict,
            ValidationVerdict::FitsToNoise);
  EXPECT_EQ(judged(fine, error_of(0.015, 0.01, true, 1.0, 3000.0)).verdict,
            ValidationVerdict::Approximation);
}

TEST(Judgement, NeighboursInCommonAreStructureHoweverSmall) {
  const PredictionError fine = error_of(0.01, 0.01, true, 1.0);
  PredictionError above = error_of(0.0115, 0.01, true, 1.0);
  EXPECT_EQ(judged(fine, above).verdict, ValidationVerdict::FitsToNoise);
  above.correlation = 0.25;  // five standard deviations of 400 values
  EXPECT_EQ(judged(fine, above).verdict, ValidationVerdict::Approximation);
  above.error = 0.0101;
  EXPECT_EQ(judged(fine, above).verdict, ValidationVerdict::FitsToNoise);
}

TEST(Judgement, WithoutNoiseTheResolutionDecides) {
  const PredictionError fine = error_of(1e-9, 1e-10, false, 0.01);
  EXPECT_EQ(judged(fine, error_of(1e-5, 1e-10, false, 1.0)).verdict,
            ValidationVerdict::FitsToNoise);
  EXPECT_EQ(judged(fine, error_of(1e-3, 1e-10, false, 1.0)).verdict,
            ValidationVerdict::Approximation);
}

TEST(Judgement, TheOptionsAreWhatDecides) {
  const auto with = [](const ValidationOptions& options, double error, double correlation) {
    Validation validation{.samples = 500, .refitted = true};
    validation.windows = {1.0, 20, 0, {error_of(error, 0.01, true, 1.0)}};
    validation.windows.states[0].correlation = correlation;
    judge(options, validation);
    return validation.verdict;
  };
  EXPECT_EQ(with({}, 0.013, 0.0), ValidationVerdict::Approximation);
  EXPECT_EQ(with({.noise_slack = 0.2}, 0.013, 0.0), ValidationVerdict::FitsToNoise);
  EXPECT_EQ(with({.scatter = 6.0}, 0.013, 0.0), ValidationVerdict::FitsToNoise);
  EXPECT_EQ(with({}, 0.0112, 0.25), ValidationVerdict::Approximation);
  EXPECT_EQ(with({.structure = 4.0}, 0.0112, 0.25), ValidationVerdict::FitsToNoise);
  EXPECT_EQ(with({.resolution = 0.02}, 0.013, 0.0), ValidationVerdict::FitsToNoise);
  EXPECT_EQ(with({.wrong_fraction = 0.005}, 0.013, 0.0), ValidationVerdict::WrongLibrary);
}

TEST(Judgement, WithoutNoiseErrorsThatDoNotAddUpAreNotOfTheModel) {
  const PredictionError digits = error_of(1e-5, 1e-10, false, 0.01);  // 1e-3 of a step
  EXPECT_EQ(judged(digits, error_of(1e-5, 1e-10, false, 1.0)).verdict,
            ValidationVerdict::FitsToNoise);
  EXPECT_EQ(judged(digits, error_of(1e-3, 1e-10, false, 1.0)).verdict,
            ValidationVerdict::Approximation);
  Validation steps_only{.samples = 500, .refitted = true};
  steps_only.one_step = {0.01, 200, 0, {digits}};
  judge({}, steps_only);
  EXPECT_EQ(steps_only.verdict, ValidationVerdict::Approximation);
}

TEST(Judgement, NoiseThatIsNotKnownCannotBeHeldAgainstAModel) {
  const PredictionError fine = error_of(1e-9, 1e-10, false, 0.01);
  const Validation validation = judged(fine, error_of(0.02, 0.03, false, 1.0));
  EXPECT_EQ(validation.verdict, ValidationVerdict::Undecided);
  EXPECT_THAT(validation.sentence, HasSubstr("they do not show"));
  EXPECT_EQ(judged(fine, error_of(0.2, 0.03, false, 1.0)).verdict,
            ValidationVerdict::WrongLibrary);
}

TEST(Judgement, FewSamplesTellNothing) {
  const PredictionError few = error_of(0.01, 0.01, true, 1.0, 4.0);
  const Validation validation = judged(few, few);
  EXPECT_EQ(validation.verdict, ValidationVerdict::Undecided);
  EXPECT_THAT(validation.sentence, HasSubstr("only 500 samples are held out"));
  Validation fitted{.samples = 41};
  fitted.windows = {1.0, 4, 0, {few}};
  judge({}, fitted);
  EXPECT_EQ(fitted.verdict, ValidationVerdict::Undecided);
  EXPECT_THAT(fitted.sentence, HasSubstr("could be held out, and on the 41 samples"));
}

TEST(Judgement, AStateWithoutFreedomDoesNotCount) {
  Validation validation{.samples = 500, .refitted = true};
  PredictionError alone = error_of(5.0, 0.01, true, 1.0, 0.5);
  alone.state = "y";
  validation.windows = {1.0, 20, 0, {error_of(0.01, 0.01, true, 1.0), alone}};
  judge({}, validation);
  EXPECT_EQ(validation.verdict, ValidationVerdict::FitsToNoise) << validation.sentence;
}

TEST(Judgement, ErrorsAreToldInNoiseUpToThreeTimesOfItAndElseInMotion) {
  const auto told = [](double error, double noise) {
    const PredictionError state = error_of(error, noise, true, 1.0);
    return judged(state, state).sentence;
  };
  EXPECT_THAT(told(0.029, 0.01), HasSubstr("2.9 times the noise of x"));
  // What is no noise: sqrt(0.035^2 - 0.01^2).
  EXPECT_THAT(told(0.035, 0.01), HasSubstr("3.4 % of the motion of x"));
  EXPECT_THAT(told(0.4567, 0.01), HasSubstr("46 % of the motion of x"));
  EXPECT_THAT(told(1.234, 0.01), HasSubstr("123 % of the motion of x"));
}

TEST(Judgement, WhatWasFittedProvesNothing) {
  const PredictionError fine = error_of(0.01, 0.01, true, 1.0);
  Validation validation;
  validation.one_step = {0.01, 200, 0, {fine}};
  judge({}, validation);
  EXPECT_EQ(validation.verdict, ValidationVerdict::Undecided);
  validation.one_step.states[0].error = 0.5;
  judge({}, validation);
  EXPECT_EQ(validation.verdict, ValidationVerdict::WrongLibrary);
}

TEST(Judgement, WindowsWithoutASolutionRefuteTheLibrary) {
  Validation validation{.refitted = true};
  validation.windows = {1.0, 20, 15, {error_of(0.01, 0.01, true, 1.0)}};
  judge({}, validation);
  EXPECT_EQ(validation.verdict, ValidationVerdict::WrongLibrary);
}

TEST(Judgement, TheAdequacyIsTheVerdictByStates) {
  Validation validation{.samples = 500, .refitted = true};
  const PredictionError fine = error_of(0.01, 0.01, true, 1.0);
  PredictionError off = error_of(0.03, 0.01, true, 1.0),
                  still = error_of(0.01, 0.01, true, 0.01);
  off.state = "y";
  still.state = "z";
  validation.windows = {1.0, 20, 0, {fine, off, still}};
  judge({}, validation);
  EXPECT_EQ(validation.adequacy.fits, Adequate::No);
  ASSERT_EQ(validation.adequacy.parts.size(), 3u);
  EXPECT_EQ(validation.adequacy.parts[0].fits, Adequate::Yes);
  EXPECT_EQ(validation.adequacy.parts[1].fits, Adequate::No);
  EXPECT_EQ(validation.adequacy.parts[2].fits, Adequate::Undetermined) << "it does not move";
  EXPECT_EQ(validation.adequacy.samples(), 1500);

  validation.windows = {1.0, 20, 0, {fine, still}};
  judge({}, validation);
  EXPECT_EQ(validation.verdict, ValidationVerdict::FitsToNoise);
  EXPECT_EQ(validation.adequacy.fits, Adequate::Yes);
  validation.windows.lost = 15;
  judge({}, validation);
  EXPECT_EQ(validation.adequacy.fits, Adequate::No);
  EXPECT_EQ(validation.adequacy.parts[0].fits, Adequate::No) << "there is no solution";
}

TEST(Judgement, WindowsInWhichNoRunBeginsRefuteNothingAndConfirmNothing) {
  for (const double error : {0.01, 5.0}) {
    Validation validation{.samples = 500, .refitted = true};
    validation.windows = {1.0, 20, 0, {error_of(error, 0.01, true, 1.0)}, 15};
    judge({}, validation);
    EXPECT_EQ(validation.verdict, ValidationVerdict::Undecided);
    EXPECT_EQ(validation.adequacy.fits, Adequate::Undetermined);
    EXPECT_THAT(validation.sentence, HasSubstr("15 of 20 windows"));
    validation.windows.unstarted = 5;
    judge({}, validation);
    EXPECT_NE(validation.verdict, ValidationVerdict::Undecided) << "there are enough others";
  }
}

TEST(Judgement, WhatALimitCutIsIncompleteWhereItCouldChangeTheVerdict) {
  const auto verdict = [](double error, const char* why) {
    Validation validation{.samples = 500, .refitted = true};
    validation.windows = {1.0, 20, 0, {error_of(error, 0.01, true, 1.0)}};
    judge({}, validation, {{"equations"}, {"forms", false, why}});
    return validation;
  };
  EXPECT_EQ(verdict(0.01, kTimeIsUp).verdict, ValidationVerdict::FitsToNoise);
  for (const double error : {0.03, 5.0}) {
    const Validation cut = verdict(error, kTimeIsUp);
    EXPECT_EQ(cut.verdict, ValidationVerdict::Incomplete);
    EXPECT_THAT(cut.sentence, HasSubstr("left out: forms"));
    EXPECT_EQ(cut.adequacy.fits, Adequate::No) << "of the model as it is";
  }
  EXPECT_EQ(verdict(0.03, kIsQuick).verdict, ValidationVerdict::Approximation);
  EXPECT_EQ(verdict(5.0, kIsQuick).verdict, ValidationVerdict::Incomplete)
      << "not all libraries were tried";
}

}  // namespace
}  // namespace lacuna
