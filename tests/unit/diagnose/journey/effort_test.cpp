// SPDX-License-Identifier: MIT
// A diagnosis that is not done to its end.
#include <gtest/gtest.h>

#include <chrono>

#include "lacuna/diagnose/journey/diagnose.hpp"
#include "support/assimilated_oscillator.hpp"
#include "support/own_effects.hpp"

namespace lacuna {
namespace {

TEST(DiagnosisEffort, PastTheDeadlineTheAnswerIsThatTheSearchIsNotFinished) {
  RunContext context;
  context.deadline = std::chrono::steady_clock::now();
  DiagnosisOptions options;
  options.effects = support::own_effects();
  const Diagnosis diagnosis =
      diagnose(support::oscillator(), support::hidden_record(support::dry_friction, 0.01, 3),
               support::hidden_record(support::dry_friction, 0.01, 4, -0.7), options, context);
  EXPECT_EQ(diagnosis.verdict, Verdict::Incomplete);
  EXPECT_EQ(diagnosis.admission.standing, Standing::Incomplete);
  EXPECT_NE(diagnosis.admission.why.find("effects"), std::string::npos);
  EXPECT_TRUE(diagnosis.effects.empty());
  EXPECT_FALSE(diagnosis.gap.has_value());
  EXPECT_EQ(answer_from(diagnosis.stages), "coefficients");
  EXPECT_EQ(diagnosis.notes.back(), left_out_line(diagnosis.stages));
}

TEST(DiagnosisEffort, WhatAQuickRunNamesIsNoWholeExplanation) {
  DiagnosisOptions options;
  options.effects = support::own_effects();
  options.effort = Thoroughness::Quick;
  const Diagnosis diagnosis =
      diagnose(support::oscillator(), support::hidden_record(support::dry_friction, 0.01, 3),
               support::hidden_record(support::dry_friction, 0.01, 4, -0.7), options, {});
  ASSERT_EQ(diagnosis.effects.size(), 1u);
  EXPECT_EQ(diagnosis.effects[0].name, "dry");
  EXPECT_EQ(diagnosis.verdict, Verdict::PartlyExplained);
  EXPECT_NE(left_out_line(diagnosis.stages).find("other assumptions"), std::string::npos);
}

TEST(DiagnosisEffort, ThatNoKnownEffectExplainsTheRecordsIsNoAnswerOfAQuickRun) {
  DiagnosisOptions options;
  options.effects = {};
  const auto diagnosed = [&](Thoroughness effort) {
    options.effort = effort;
    return diagnose(support::oscillator(),
                    support::hidden_record(support::dry_friction, 0.01, 3),
                    support::hidden_record(support::dry_friction, 0.01, 4, -0.7), options, {})
        .verdict;
  };
  EXPECT_EQ(diagnosed(Thoroughness::Quick), Verdict::Incomplete);
  EXPECT_EQ(diagnosed(Thoroughness::Normal), Verdict::UnnamedStructure);
}

}  // namespace
}  // namespace lacuna
