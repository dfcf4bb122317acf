// SPDX-License-Identifier: MIT
// The diagnosis on a few of the hidden cases; the study of that name runs all of them.
#include <gtest/gtest.h>

#include "hidden/support/cases.hpp"
#include "hidden/support/records.hpp"
#include "hidden/support/score.hpp"
#include "lacuna/config/registry.hpp"
#include "lacuna/diagnosis/diagnose.hpp"

namespace lacuna::hidden {
namespace {

Score diagnosed(const std::string& name, const std::vector<std::string>& effects,
                double level = 0.01) {
  const HiddenCase hidden = case_named(name);
  const auto [find, check] = make_records(hidden, level, 1);
  const Registry registry = default_registry();
  DiagnosisOptions options;
  for (const std::string& effect : effects)
    options.effects.push_back(registry.make<Effect>(effect));
  return score(hidden, diagnose(hidden.nominal, find, check, options, RunContext{}),
               clean_record(hidden, 2));
}

Score diagnosed(const std::string& name) {
  return diagnosed(name, default_registry().names(Effect::kKind));
}

TEST(HiddenDiagnosis, NamesAHardeningSpring) {
  const Score found = diagnosed("oscillator-hardening");
  EXPECT_TRUE(found.verdict && found.equation && found.name) << found.answer;
  EXPECT_EQ(found.spurious, 0) << found.answer;
  EXPECT_NEAR(found.size.value(), 1.0, 0.1);
}

TEST(HiddenDiagnosis, NamesASkewedChannelAndNothingElse) {
  const Score found = diagnosed("filter-skew");
  EXPECT_TRUE(found.verdict && found.name) << found.answer;
  EXPECT_EQ(found.spurious, 0) << found.answer;
}

TEST(HiddenDiagnosis, NamesOneFrictionCurveByOneName) {
  const Score found = diagnosed("motor-stribeck");
  EXPECT_TRUE(found.verdict && found.equation && found.name) << found.answer;
  EXPECT_EQ(found.spurious, 0) << found.answer;
}

TEST(HiddenDiagnosis, TellsAnInputThatWasNotMeasured) {
  const Score found = diagnosed("rlc-unseen-drive", {"unmeasured-input", "periodic-forcing"});
  EXPECT_TRUE(found.verdict && found.equation && found.name) << found.answer;
}

TEST(HiddenDiagnosis, TakesARandomFactorForNoInput) {
  const Score found = diagnosed("oscillator-switching", {"unmeasured-input"}, 0.001);
  EXPECT_TRUE(found.verdict) << found.answer;
  EXPECT_EQ(found.spurious, 0) << found.answer;
}

TEST(HiddenDiagnosis, TakesPolesOfAMotorForNoInput) {
  const Score found = diagnosed("turntable-cogging", {"unmeasured-input"}, 0.001);
  EXPECT_TRUE(found.verdict) << found.answer;
  EXPECT_EQ(found.spurious, 0) << found.answer;
}

TEST(HiddenDiagnosis, NamesASpringBetweenBodiesThatTheGroundHoldsToo) {
  const Score found = diagnosed("masses-hard-coupling", {"cubic-stiffness", "cubic-term"});
  EXPECT_TRUE(found.verdict && found.equation && found.name) << found.answer;
  EXPECT_EQ(found.spurious, 0) << found.answer;
}

TEST(HiddenDiagnosis, TakesNoiseWithAMemoryForNoEffect) {
  const Score found = diagnosed("nerve-null-coloured");
  EXPECT_TRUE(found.verdict) << found.answer;
}

TEST(HiddenDiagnosis, TellsWrongCoefficientsFromMissingStructure) {
  const Score found = diagnosed("oscillator-off");
  EXPECT_TRUE(found.verdict) << found.answer;
}

TEST(HiddenDiagnosis, NamesNothingWhereNothingIsMissing) {
  const Score found = diagnosed("pendulum-null");
  EXPECT_TRUE(found.verdict) << found.answer;
}

}  // namespace
}  // namespace lacuna::hidden
