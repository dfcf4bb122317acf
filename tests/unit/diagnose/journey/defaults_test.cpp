// SPDX-License-Identifier: MIT
// A diagnosis that is asked for with no more than a model and records.
#include <gtest/gtest.h>

#include "lacuna/diagnose/journey/diagnose.hpp"
#include "support/driven_oscillator.hpp"

namespace lacuna {
namespace {

double rubbing(double, double, double v) { return v > 0.0 ? -0.3 : 0.3; }

void expect_friction(const Diagnosis& found) {
  EXPECT_EQ(found.verdict, Verdict::Explained);
  ASSERT_EQ(found.effects.size(), 1u);
  EXPECT_EQ(found.effects[0].name, "coulomb-friction");
  EXPECT_NEAR(found.effects[0].coefficient, -0.3, 0.02);
}

TEST(DefaultDiagnosis, TriesEveryEffectAndEveryHypothesis) {
  const DiagnosisOptions options{};
  EXPECT_EQ(options.effects.size(), standard_effects().size());
  EXPECT_EQ(options.hypotheses.size(), standard_hypotheses().size());
  EXPECT_GT(options.effects.size(), 20u);
  expect_friction(diagnose(support::oscillator(), support::hidden_record(rubbing, 0.01)));
}

TEST(DefaultDiagnosis, NoEffectsNameNone) {
  const Diagnosis found = diagnose(support::oscillator(), support::hidden_record(rubbing, 0.01),
                                   {}, {.effects = {}});
  EXPECT_TRUE(found.effects.empty());
  EXPECT_NE(found.verdict, Verdict::NoDiscrepancy);
}

TEST(DefaultDiagnosis, FindsColumnsByTheirNames) {
  const Dataset record = support::hidden_record(rubbing, 0.01);
  Dataset reversed = record;
  std::swap(reversed.states[0], reversed.states[1]);
  reversed.trajectories[0].states = record.trajectories[0].states.rowwise().reverse();
  reversed.rate_of.clear();
  expect_friction(diagnose(support::oscillator(), reversed));
  reversed.states = {{"other", ""}, {"another", ""}};
  EXPECT_THROW(diagnose(support::oscillator(), reversed, record), DataError);
}

}  // namespace
}  // namespace lacuna
