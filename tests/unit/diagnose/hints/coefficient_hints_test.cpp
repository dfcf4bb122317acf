// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lacuna/diagnose/hints/hints.hpp"
#include "support/diagnosis_scope.hpp"

namespace lacuna {
namespace {

/// The hint that a coefficient of dv/dt of the driven oscillator gives.
std::optional<Hint> hint_for(const std::string& term, double ratio, double deviation = 1e-3) {
  return coefficient_hint(support::oscillator(), support::oscillator_record(),
                          {1, term, ratio, deviation}, {});
}

TEST(CoefficientHint, TellsTheUnitOrSignOfAnInput) {
  const auto unit = hint_for("F", 0.0998);
  ASSERT_TRUE(unit);
  EXPECT_EQ(unit->kind, HintKind::ChannelUnit);
  EXPECT_THAT(unit->message, ::testing::HasSubstr("F looks 10 times too large"));
  EXPECT_EQ(unit->withheld, Withheld::Nothing);
  const auto sign = hint_for("F", -1.02);
  ASSERT_TRUE(sign);
  EXPECT_EQ(sign->kind, HintKind::Sign);
}

TEST(CoefficientHint, SaysNothingOfOtherNumbers) {
  EXPECT_FALSE(hint_for("F", 1.0));
  EXPECT_FALSE(hint_for("F", 8.5));
  EXPECT_FALSE(hint_for("F", -0.8));
  EXPECT_FALSE(hint_for("F", 10.0, 2.0)) << "not known well enough";
  EXPECT_FALSE(hint_for("q", 1000.0)) << "the unit of q would change the identity too";
  EXPECT_FALSE(hint_for("v", -1.0));
}

/// What all coefficients of the driven oscillator, dq/dt = v and dv/dt in q, v and F, say of
/// time.
std::optional<Hint> clock_hint_for(double q, double v, double force, bool measured = false) {
  Dataset data = support::oscillator_record();
  if (!measured) data.reconstructed = {false, true};
  return clock_hint(support::oscillator(), data,
                    {{1, "q", q, 1e-3}, {1, "v", v, 1e-3}, {1, "F", force, 1e-3}}, {});
}

TEST(ClockHint, FollowsThePowersOfTimeInEachCoefficient) {
  // v is made of q: in a time that is 3 times too long it is a third, and its rate a ninth.
  const auto hint = clock_hint_for(1.0 / 9.0, 1.0 / 3.0, 1.0 / 9.0);
  ASSERT_TRUE(hint);
  EXPECT_EQ(hint->kind, HintKind::TimeUnit);
  EXPECT_THAT(hint->message, ::testing::HasSubstr("all rates are 3 times too small"));
  EXPECT_EQ(hint->withheld, Withheld::Nothing);
}

TEST(ClockHint, NeedsAllCoefficientsAndAFactorThatIsNoUnit) {
  EXPECT_FALSE(clock_hint_for(1.0 / 9.0, 1.0 / 3.0, 1.0 / 5.0));
  EXPECT_FALSE(clock_hint_for(1.0 / 9.0, 1.0 / 3.0, -1.0 / 9.0));
  EXPECT_FALSE(clock_hint_for(1.2 * 1.2, 1.2, 1.2 * 1.2)) << "may be a mass";
  EXPECT_FALSE(clock_hint_for(1.0 / 9.0, 1.0 / 3.0, 1.0 / 9.0, true)) << "dq/dt = v holds";
}

}  // namespace
}  // namespace lacuna
