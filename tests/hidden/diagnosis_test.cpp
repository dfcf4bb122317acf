// SPDX-License-Identifier: MIT
// The diagnosis on a few of the hidden cases; the study of that name runs all of them.
#include <gtest/gtest.h>

#include <numbers>
#include <utility>

#include "core/base/text.hpp"
#include "hidden/support/case_builder.hpp"
#include "hidden/support/cases.hpp"
#include "hidden/support/records.hpp"
#include "hidden/support/score.hpp"
#include "lacuna/cli/configuration/registry.hpp"
#include "lacuna/diagnose/diagnose.hpp"

namespace lacuna::hidden {
namespace {

Score diagnosed(const HiddenCase& hidden, const std::vector<std::string>& effects,
                double level) {
  const auto [find, check] = make_records(hidden, level, 1);
  const Registry registry = default_registry();
  DiagnosisOptions options{.effects = {}};
  for (const std::string& effect : effects)
    options.effects.push_back(registry.make<Effect>(effect));
  return score(hidden, diagnose(hidden.nominal, find, check, options, RunContext{}),
               clean_record(hidden, 2));
}

Score diagnosed(const std::string& name, const std::vector<std::string>& effects,
                double level = 0.01) {
  return diagnosed(case_named(name), effects, level);
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
  EXPECT_EQ(found.answer.rfind("unnamed-structure", 0), 0u) << found.answer;
  EXPECT_EQ(found.spurious, 0) << found.answer;
}

/// Case turntable-cogging with its angle in another unit, of which a radian has `scale`.
HiddenCase turntable_in(const std::string& unit, double scale) {
  Plant plant{model_of("s", {{"th", unit}, {"w", unit + "/s"}}, {{"u", unit + "/s^2"}},
                       {{{"w", 1.0}}, {{"w", -3.0}, {"u", 1.0}}}),
              Vector{{0.0, 0.0}},
              scale * Vector{{1.0, 2.0}},
              0.004,
              5000,
              2.0,
              {{.size = 25.0 * scale, .low = 0.05, .high = 0.8}}};
  const std::string cogging = "sin(" + format_number(12.0 / scale) + "*th+0.4)";
  return CaseBuilder("turntable-cogging", "Turntable, its angle in " + unit, std::move(plant))
      .hide({"w", {}, {}, cogging, 5.0 * scale})
      .inexpressible()
      .build();
}

TEST(HiddenDiagnosis, TakesPolesOfAMotorForNoInputInAnyUnit) {
  constexpr double kTurn = 2.0 * std::numbers::pi;
  for (const auto& [unit, scale] : {std::pair("deg", 360.0 / kTurn), {"turn", 1.0 / kTurn}}) {
    const Score found = diagnosed(turntable_in(unit, scale), {"unmeasured-input"}, 0.001);
    EXPECT_TRUE(found.verdict) << unit << ": " << found.answer;
    EXPECT_EQ(found.spurious, 0) << unit << ": " << found.answer;
  }
}

TEST(HiddenDiagnosis, NamesPolesOfAMotor) {
  const Score found = diagnosed("turntable-cogging");
  EXPECT_TRUE(found.verdict && found.equation && found.name) << found.answer;
}

TEST(HiddenDiagnosis, LeavesACubeWhatItIsWhenAToneHasGone) {
  const Score found = diagnosed("van-der-pol-forced-cubic");
  EXPECT_TRUE(found.verdict && found.equation && found.name) << found.answer;
  EXPECT_EQ(found.spurious, 0) << found.answer;
}

TEST(HiddenDiagnosis, TonesThatOtherRecordsDoNotShowExplainNothing) {
  const Score found =
      diagnosed("oscillator-absorber", {"extra-state", "delay", "periodic-forcing"}, 0.05);
  EXPECT_EQ(found.answer.rfind("partly-explained", 0), 0u) << found.answer;
}

TEST(HiddenDiagnosis, NamesDryFrictionInItsOwnWriting) {
  const Score found = diagnosed("motor-friction-limit");
  EXPECT_TRUE(found.verdict && found.equation && found.name) << found.answer;
  EXPECT_EQ(found.answer.find("w-"), std::string::npos) << found.answer;
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
