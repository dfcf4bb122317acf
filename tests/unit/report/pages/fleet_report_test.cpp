// SPDX-License-Identifier: MIT
#include "report/pages/fleet_report.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "lacuna/core/base/error.hpp"
#include "support/diagnosis_scope.hpp"

namespace lacuna {
namespace {

using ::testing::HasSubstr;

/// A diagnosis of the oscillator with these effects in dv/dt.
Diagnosis with_effects(const std::vector<std::string>& names) {
  const OdeModel model = support::oscillator();
  const Verdict verdict = names.empty() ? Verdict::NoDiscrepancy : Verdict::Explained;
  Diagnosis diagnosis{verdict, model, {}, {}, {}, {}, {}, model, {}, {}, {}, {}};
  for (const std::string& name : names) {
    NamedEffect effect;
    effect.equation = 1;
    effect.name = name;
    effect.term = "sign(v)";
    diagnosis.effects.push_back(effect);
  }
  if (!names.empty()) diagnosis.gap = Gap{"rms", 0.049, 0.0031, 0.003, 0.5, 1.0, {"r2.csv"}};
  return diagnosis;
}

std::vector<FleetAnswer> fleet() {
  return {fleet_answer("a.csv", with_effects({"coulomb-friction"})),
          fleet_answer("b.csv", with_effects({"delay", "coulomb-friction"})),
          fleet_answer("c.csv", with_effects({})),
          fleet_failure("d.csv", "d.csv: it is empty")};
}

TEST(FleetReport, TellsEachAnswerAndHowOftenEffectsOccur) {
  const std::string text = format_text(fleet());
  EXPECT_THAT(text, HasSubstr("a.csv   explained       coulomb-friction in v"));
  EXPECT_THAT(text, HasSubstr("0.049 -> 0.0031"));
  EXPECT_THAT(text, HasSubstr("c.csv   no-discrepancy  -"));
  EXPECT_THAT(text, HasSubstr("d.csv   error           d.csv: it is empty"));
  EXPECT_LT(text.find("coulomb-friction in v  2 of 4"),
            text.find("delay in v             1 of 4"));
}

TEST(FleetReport, AnEffectThatStandsTwiceInARecordCountsOnce) {
  const std::vector<FleetAnswer> one{fleet_answer("a.csv", with_effects({"delay", "delay"}))};
  EXPECT_THAT(format_text(one), HasSubstr("delay in v  1 of 1"));
}

TEST(FleetReport, CandidatesWithoutAVerdictAreNotFound) {
  Diagnosis open = with_effects({"delay"});
  open.verdict = Verdict::Undetermined;
  open.admission = {Standing::Undetermined, "noise is as slow as that"};
  EXPECT_TRUE(fleet_answer("a.csv", open).effects.empty());
}

TEST(FleetReport, AnswersGoFromProcessToProcess) {
  std::vector<FleetAnswer> given = fleet();
  given.push_back(fleet_answer("e \"1\".csv", with_effects({})));
  std::vector<FleetAnswer> taken;
  for (const FleetAnswer& answer : given) taken.push_back(unpacked(packed(answer)));
  EXPECT_EQ(format_text(taken), format_text(given));
  EXPECT_EQ(format_json(taken), format_json(given));
  for (const char* text : {"", "[]", "[1, 2]", "{", "[\"a\", \"b\", \"c\"]"})
    EXPECT_THROW(unpacked(text), ArgumentError) << text;
}

TEST(FleetReport, JsonHoldsWholeDiagnoses) {
  const auto json = nlohmann::json::parse(format_json(fleet()));
  EXPECT_EQ(json["format"], "lacuna.fleet/1");
  ASSERT_EQ(json["answers"].size(), 4U);
  EXPECT_EQ(json["answers"][0]["diagnosis"]["format"], "lacuna.diagnosis/1");
  EXPECT_THAT(json["answers"][2]["headline"].get<std::string>(), HasSubstr("No discrepancy"));
  EXPECT_TRUE(json["answers"][3]["diagnosis"].is_null());
  EXPECT_EQ(json["answers"][3]["error"], "d.csv: it is empty");
  EXPECT_EQ(json["effects"][0]["effect"], "coulomb-friction in v");
  EXPECT_EQ(json["effects"][0]["records"], 2);
}

}  // namespace
}  // namespace lacuna
