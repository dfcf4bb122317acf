// SPDX-License-Identifier: MIT
#include "lacuna/candidates/screening.hpp"

#include <gtest/gtest.h>

#include "support/assimilated_oscillator.hpp"

namespace lacuna {
namespace {

TEST(Screening, TheHiddenTermGainsMost) {
  const Assimilation fit =
      support::assimilated(support::hidden_record(support::dry_friction, 0.01));
  const Screening screening(fit);
  const auto found =
      screen({support::plain_candidate("q^3"), support::plain_candidate("sign(v)"),
              support::plain_candidate("v^3"), support::plain_candidate("1")},
             screening, ScreeningOptions{}, RunContext{});
  EXPECT_EQ(found.front().candidate.form, parse_expression("sign(v)"));
  EXPECT_NEAR(found.front().coefficient, -0.3, 0.03);
  EXPECT_GT(found.front().gain, 50.0);
}

TEST(Screening, NominalTermsGainNothing) {
  const Assimilation fit =
      support::assimilated(support::hidden_record(support::dry_friction, 0.01));
  const Screening screening(fit);
  EXPECT_LT(screening.score(support::plain_candidate("2*v"), {}).gain, 1e-3);
}

TEST(Screening, ScoresOfACompleteModelAreChiSquared) {
  const Assimilation fit = support::assimilated(support::hidden_record(support::nothing, 0.01));
  const Screening screening(fit);
  for (const std::string form : {"q^3", "sign(v)", "q*v", "1", "t*q", "F^2"})
    EXPECT_LT(screening.score(support::plain_candidate(form), {}).gain, 12.0) << form;
}

TEST(Screening, SearchesShapes) {
  const Assimilation fit = support::assimilated(support::hidden_record(
      [](double, double q, double) { return -3.0 * std::min(q + 0.2, 0.0); }, 0.005));
  const Screening screening(fit);
  ScreenedCandidate found = screening.at_starts(support::stop_candidate(0.1));
  const double before = found.gain;
  screening.polish(found);
  EXPECT_GT(found.gain, before);
  EXPECT_NEAR(found.shapes[0], -0.2, 0.1);
}

}  // namespace
}  // namespace lacuna
