// SPDX-License-Identifier: MIT
#include "forms/candidate/tone.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "support/diagnosis_scope.hpp"

namespace lacuna {
namespace {

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

}  // namespace
}  // namespace lacuna
