// SPDX-License-Identifier: MIT
#include "forms/candidate/tone.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "support/diagnosis_scope.hpp"

namespace lacuna {
namespace {

TEST(Tone, ComesToTwoPeriodsInTheRecord) {
  const Scope scope = support::oscillator_scope();  // of 10 s
  EXPECT_TRUE(is_tone({0, 0.2, 0.0}, scope));
  EXPECT_FALSE(is_tone({0, 0.19, 0.0}, scope));
}

TEST(Tone, BeginsAtTheLineWithinTheResolutionOfTheRecord) {
  const Candidate tone = tone_candidate({1, 3.0, 0.5}, support::oscillator_scope());
  EXPECT_EQ(tone.form, parse_expression("sin(2*pi*frequency*t+phase)"));
  EXPECT_EQ(tone.equation, 1);
  EXPECT_EQ(tone.place, Place::Rate);
  ASSERT_EQ(tone.shapes.size(), 2u);
  EXPECT_NEAR(tone.shapes[0].low, 2.9, 1e-12);
  EXPECT_NEAR(tone.shapes[0].high, 3.1, 1e-12);
  EXPECT_EQ(tone.shapes[0].unit, "1/s");
  EXPECT_NEAR(tone.shapes[1].high - tone.shapes[1].low, 2.0 * std::numbers::pi, 1e-12);
  ASSERT_EQ(tone.starts.size(), 1u);
  EXPECT_EQ(tone.starts[0], (Vector{{3.0, 0.5}}));
}

TEST(Tone, LeavesNamesOfTheModelAlone) {
  Scope scope = support::oscillator_scope();
  scope.model = parse_model(R"({"format": "lacuna.model/1", "time_unit": "s",
    "states": [{"name": "phase", "unit": ""}], "inputs": [],
    "equations": [{"state": "phase", "terms": [{"term": "1", "coefficient": 1.0}]}]})",
                            "turning");
  const Candidate tone = tone_candidate({0, 3.0, 0.5}, scope);
  EXPECT_NE(tone.shapes[1].name, "phase");
}

}  // namespace
}  // namespace lacuna
