// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "lacuna/diagnose/hypotheses/composite_model.hpp"
#include "lacuna/report/reports.hpp"
#include "support/diagnosis_scope.hpp"
#include "support/driven_oscillator.hpp"

namespace lacuna {
namespace {

Diagnosis made() {
  const OdeModel model = support::oscillator();
  Diagnosis diagnosis{Verdict::Explained, model, {}, {}, {}, {}, {}, model, {}, {}, {}, {}};
  diagnosis.disagreement.push_back(
      {1, 0.21, 0.03, 57.0, 1.0, 0.1, {{"v", -0.1, 0.1, {}, 31.0}, {"", 0, 0, 0.291, 12.0}}});
  NamedEffect effect;
  effect.equation = 1;
  effect.name = "coulomb-friction";
  effect.description = "dry friction opposing v";
  effect.term = "sign(v)";
  effect.coefficient = -0.4;
  effect.deviation = 0.01;
  effect.sigma = 44.0;
  effect.gap_closed = 0.93;
  effect.probability = 0.97;
  effect.alternatives.push_back({"quadratic-drag", "v*abs(v)", 0.02});
  diagnosis.effects.push_back(effect);
  diagnosis.coefficient_changes.push_back({1, "q", -4.0, -3.9, 0.01, 10.0});
  diagnosis.gap = Gap{"rms", 0.049, 0.0031, 0.003, 0.5, 1.0, {"r2.csv"}};
  return diagnosis;
}

TEST(DiagnosisReport, SaysItInAFewLines) {
  const std::string text = format_text(made());
  EXPECT_THAT(text,
              ::testing::HasSubstr("Equation v: dry friction opposing v (coulomb-friction), "
                                   "-0.4 +- 0.02 m/s^2 * sign(v), explains 93 %"));
  EXPECT_THAT(text, ::testing::HasSubstr("might also be quadratic-drag"));
  EXPECT_THAT(text, ::testing::HasSubstr("from 4.9 % to 0.31 % (noise floor 0.3 %)"));
  EXPECT_LE(std::count(text.begin(), text.end(), '\n'), 10);
}

TEST(DiagnosisReport, NoProbabilityContradictsThePlainNameThatLeads) {
  Diagnosis diagnosis = made();
  diagnosis.effects.front().probability = 0.1;
  diagnosis.effects.front().alternatives.front().probability = 0.9;
  const std::string text = format_text(diagnosis);
  EXPECT_THAT(text, ::testing::HasSubstr("It might also be quadratic-drag v*abs(v), which the "
                                         "records do not distinguish from it"));
  EXPECT_THAT(text, ::testing::Not(::testing::HasSubstr("probability")));
}

TEST(DiagnosisReport, SaysThatAGapStays) {
  Diagnosis diagnosis = made();
  diagnosis.gap->after = diagnosis.gap->before;
  EXPECT_THAT(format_text(diagnosis), ::testing::HasSubstr("the gap stays at 4.9 %"));
  diagnosis.gap->after *= 2.0;
  EXPECT_THAT(format_text(diagnosis), ::testing::HasSubstr("the gap rises from 4.9 %"));
}

TEST(DiagnosisReport, JsonHasTheKeysOfTheFormat) {
  const auto json = nlohmann::json::parse(format_json(made()));
  EXPECT_EQ(json.at("format"), "lacuna.diagnosis/1");
  EXPECT_EQ(json.at("verdict"), "explained");
  const auto& disagreement = json.at("disagreement").at(0);
  EXPECT_EQ(disagreement.at("equation"), "v");
  EXPECT_EQ(disagreement.at("where").at(0).at("range").size(), 2u);
  EXPECT_DOUBLE_EQ(disagreement.at("where").at(1).at("frequency"), 0.291);
  const auto& effect = json.at("effects").at(0);
  for (const char* key : {"equation", "name", "description", "term", "coefficient", "ci95",
                          "parameters", "sigma", "gap_closed", "probability", "alternatives"})
    EXPECT_TRUE(effect.contains(key)) << key;
  EXPECT_EQ(json.at("coefficient_changes").at(0).at("term"), "q");
  EXPECT_EQ(json.at("gap").at("records").at(0), "r2.csv");
  EXPECT_FALSE(json.at("remaining").at("structure"));
  EXPECT_EQ(json.at("augmented_model").at("format"), "lacuna.model/1");
}

TEST(DiagnosisReport, WhatHasNoErrorHasNoInterval) {
  Diagnosis diagnosis = made();
  EXPECT_EQ(nlohmann::json::parse(format_json(diagnosis))["effects"][0]["ci95"].size(), 2u);
  diagnosis.effects[0].deviation = 0.0;
  diagnosis.coefficient_changes[0].deviation = 0.0;
  const auto json = nlohmann::json::parse(format_json(diagnosis));
  EXPECT_TRUE(json["effects"][0]["ci95"].is_null());
  EXPECT_TRUE(json["coefficient_changes"][0]["ci95"].is_null());
}

TEST(DiagnosisReport, NoHeadlineDeniesAGapThatStays) {
  Diagnosis diagnosis = made();
  diagnosis.verdict = Verdict::NoDiscrepancy;
  diagnosis.effects.clear();
  diagnosis.adequacy = {Adequate::Yes, {{"v", Adequate::Yes, 100, true}}};
  EXPECT_THAT(format_text(diagnosis), ::testing::HasSubstr("fits the records to their noise"));
  diagnosis.adequacy.fits = Adequate::No;
  diagnosis.verdict = Verdict::UnnamedStructure;
  diagnosis.remaining = {.structure = true, .sigma = 0.0, .equations = {}, .details = {}};
  EXPECT_THAT(format_text(diagnosis), ::testing::HasSubstr("on others a gap stays"));
  const auto json = nlohmann::json::parse(format_json(diagnosis));
  EXPECT_EQ(json["adequacy"]["fits"], "no");
  EXPECT_EQ(json["adequacy"]["parts"][0]["noise_known"], true);
  EXPECT_TRUE(json["gap"].contains("above_floor"));
}

TEST(DiagnosisReport, ATwinIsAChoiceAndNoStructureThatIsLeft) {
  Diagnosis diagnosis = made();
  diagnosis.verdict = Verdict::PartlyExplained;
  NamedEffect offset{.equation = 0, .place = Place::Channel, .name = "sensor-offset"};
  NamedEffect force{.equation = 1, .name = "constant-offset"};
  diagnosis.effects = {force};
  diagnosis.twins = {twin_of({offset}, diagnosis.nominal)};
  EXPECT_THAT(format_text(diagnosis),
              ::testing::StartsWith("Explained but for the choice between constant-offset in "
                                    "dv/dt and sensor-offset of q."));
  const auto json = nlohmann::json::parse(format_json(diagnosis));
  EXPECT_EQ(json["verdict"], "partly-explained");
  EXPECT_EQ(json["effects"][0]["claim"], false);
  EXPECT_EQ(json["effects"][0]["not_told_apart"], nlohmann::json({"sensor-offset"}));
  EXPECT_EQ(json["dynamics_or_measurement"], true);
  diagnosis.remaining.equations = {1};
  EXPECT_THAT(format_text(diagnosis), ::testing::HasSubstr("significant structure is left"));
}

TEST(DiagnosisReport, AReservationIsSaidAsWhatItIs) {
  Diagnosis diagnosis = made();
  diagnosis.verdict = Verdict::PartlyExplained;
  diagnosis.reservations = {"a parameter sits on its bound: T = 3 of delay"};
  const std::string text = format_text(diagnosis);
  EXPECT_THAT(text, ::testing::HasSubstr("but a parameter sits on its bound"));
  EXPECT_THAT(text, ::testing::Not(::testing::HasSubstr("significant structure is left")));
}

TEST(DiagnosisReport, ARefusalSaysWhyAndWhatWouldHaveBeenSeen) {
  Diagnosis diagnosis = made();
  diagnosis.effects.clear();
  diagnosis.verdict = Verdict::Undetermined;
  diagnosis.admission = {Standing::Undetermined, "nothing moves", "use records with motion"};
  diagnosis.smallest_effects = {{1, 0.25, 0.5}};
  EXPECT_THAT(format_text(diagnosis), ::testing::StartsWith("Undetermined: nothing moves."));
  EXPECT_THAT(format_text(diagnosis), ::testing::HasSubstr("from 0.25 m/s^2 rms on (50 %"));
  const auto json = nlohmann::json::parse(format_json(diagnosis));
  EXPECT_EQ(json["verdict"], "undetermined");
  EXPECT_EQ(json["why"], "nothing moves");
  EXPECT_EQ(json["smallest_effect"][0]["rate"], 0.25);
  EXPECT_TRUE(nlohmann::json::parse(format_json(made()))["smallest_effect"].is_null());
}

TEST(DiagnosisReport, HintsComeFirst) {
  Diagnosis diagnosis = made();
  diagnosis.hints = {{HintKind::TimeUnit, "time looks long", "--time-unit ms"}};
  EXPECT_EQ(format_text(diagnosis).rfind(
                "Hint (time-unit): time looks long. Remedy: --time-unit ms.\n", 0),
            0u);
  const auto hints = nlohmann::json::parse(format_json(diagnosis))["hints"];
  ASSERT_EQ(hints.size(), 1u);
  EXPECT_EQ(hints[0]["kind"], "time-unit");
  EXPECT_EQ(hints[0]["message"], "time looks long");
  EXPECT_EQ(hints[0]["remedy"], "--time-unit ms");
}

TEST(DiagnosisReport, SaysWhyThereIsNoAnswer) {
  Diagnosis diagnosis = made();
  diagnosis.verdict = Verdict::UnnamedStructure;
  diagnosis.hints = {{HintKind::Sign, "m", "r", Withheld::Names}};
  EXPECT_THAT(format_text(diagnosis), ::testing::HasSubstr("the hint comes first"));
  diagnosis.hints = {{HintKind::Sign, "m", "r", Withheld::Answer}};
  EXPECT_THAT(format_text(diagnosis), ::testing::HasSubstr("No effect is sought"));
}

TEST(DiagnosisReport, AForceStandsBesideTheSlopeThatItIsWrittenAs) {
  Diagnosis diagnosis = made();
  diagnosis.effects.front().parameters = {{"width", "m/s", 0.05, {}}, {"force", "", 0.8, {}}};
  EXPECT_THAT(format_text(diagnosis),
              ::testing::HasSubstr("sign(v), a force of 0.8 m/s^2, explains"));
}

TEST(DiagnosisReport, WhatExplainsNextToNothingIsANote) {
  Diagnosis diagnosis = made();
  NamedEffect small = diagnosis.effects.front();
  small.description = "cubic term in q";
  small.alternatives.clear();
  small.gap_closed = 4e-4;
  diagnosis.minor_effects.push_back(small);
  EXPECT_THAT(format_text(diagnosis),
              ::testing::HasSubstr("\nNote: Equation v: cubic term in q"));
  const auto json = nlohmann::json::parse(format_json(diagnosis));
  ASSERT_EQ(json["effects"].size(), 1u);
  EXPECT_EQ(json["effects"][0]["claim"], true);
  ASSERT_EQ(json["minor_effects"].size(), 1u);
  EXPECT_EQ(json["minor_effects"][0]["description"], "cubic term in q");
  EXPECT_EQ(json["minor_effects"][0]["claim"], false);
}

TEST(DiagnosisReport, WithoutAVerdictEffectsAreCandidates) {
  Diagnosis diagnosis = made();
  diagnosis.verdict = Verdict::Undetermined;
  diagnosis.admission = {Standing::Undetermined, "noise is as slow as that"};
  const std::string text = format_text(diagnosis);
  EXPECT_EQ(text.find("Undetermined: noise is as slow as that.\n"), 0u);
  EXPECT_THAT(text,
              ::testing::HasSubstr("\nA candidate, no finding. Equation v: dry friction"));
  EXPECT_EQ(nlohmann::json::parse(format_json(diagnosis))["effects"][0]["claim"], false);
}

TEST(DiagnosisReport, OfManyCoefficientsTheMostSignificantAreListed) {
  Diagnosis diagnosis = made();
  diagnosis.coefficient_changes.clear();
  for (int i = 0; i < 9; ++i)
    diagnosis.coefficient_changes.push_back(
        {1, "q^" + std::to_string(i + 1), -4.0, -3.9, 0.01, 20.0 - 2.0 * i});  // the last: 4
  diagnosis.coefficient_changes.push_back({1, "v", -4.0, -3.9, 0.1, 1.0});
  const std::string text = format_text(diagnosis);
  EXPECT_THAT(text, ::testing::HasSubstr("coefficient of q^4 is"));
  EXPECT_THAT(text, ::testing::Not(::testing::HasSubstr("coefficient of q^5 is")));
  EXPECT_THAT(text, ::testing::HasSubstr("\nAnd 5 more"));
  EXPECT_EQ(nlohmann::json::parse(format_json(diagnosis))["coefficient_changes"].size(), 10u);
}

Diagnosis with_rivals(std::vector<Rival> rivals) {
  const OdeModel model = support::oscillator();
  Diagnosis diagnosis{Verdict::Explained, model, {}, {}, {}, {}, {}, model, {}, {}, {}, {}};
  diagnosis.rivals = std::move(rivals);
  return diagnosis;
}

TEST(DiagnosisTrail, EachCompositeHasItsNumberOrItsRule) {
  const std::string text = format_trail(with_rivals(
      {{"named-effects", "dry in dv/dt: sign(v)", 790.0, true, "significance", 12.5, 3.0},
       {"coloured-noise", "noise with a memory", 812.25, false, "extended-bic", 812.25, 790.0},
       {"unmeasured-input", "nothing is missing", {}, true, "criterion", 1.0, 2.0, "a rule"}}));
  EXPECT_EQ(text,
            "Composite models of the records, in the order in which they were judged:\n"
            "  + named-effects     dry in dv/dt: sign(v)\n"
            "      significance 12.5 against 3\n"
            "  - coloured-noise    noise with a memory\n"
            "      extended-bic 812.25 against 790\n"
            "  + unmeasured-input  nothing is missing\n"
            "      a rule\n"
            "(+ taken over what was best before, - not taken)\n");
}

}  // namespace
}  // namespace lacuna
