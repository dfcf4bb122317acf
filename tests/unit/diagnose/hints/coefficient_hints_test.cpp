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

}  // namespace
}  // namespace lacuna
