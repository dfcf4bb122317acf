// SPDX-License-Identifier: MIT
#include "diagnose/candidates/screening.hpp"

#include <gtest/gtest.h>

#include "support/assimilated_oscillator.hpp"

namespace lacuna {
namespace {

TEST(Screening, WhatIsKnownIsNotScreenedAgain) {
  const Assimilation fit =
      support::assimilated(support::hidden_record(support::dry_friction, 0.01));
  const Screening screening(fit);
  const std::vector<Candidate> few{support::plain_candidate("q^3"),
                                   support::stop_candidate(0.0)};
  std::vector<Candidate> more = few;
  more.push_back(support::plain_candidate("sign(v)"));
  const auto expect_same = [](const ScreenedCandidate& a, const ScreenedCandidate& b) {
    EXPECT_EQ(a.candidate.form, b.candidate.form);
    EXPECT_NEAR(a.gain, b.gain, 1e-9 * b.gain);
    EXPECT_NEAR(a.coefficient, b.coefficient, 1e-9 * std::abs(b.coefficient));
    EXPECT_EQ(a.tried, b.tried);
    EXPECT_EQ(a.shapes.size(), b.shapes.size());
  };
  ScreeningMemory memory;
  screen(few, screening, {}, RunContext{}, &memory);
  const auto expected = screen(more, screening, {}, RunContext{});
  const auto found = screen(more, screening, {}, RunContext{}, &memory);
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) expect_same(found[i], expected[i]);
  const Assimilation other =
      support::assimilated(support::hidden_record(support::nothing, 0.01));
  EXPECT_NE(screening.key(), Screening(other).key());
  const auto apart = screen(few, Screening(other), {}, RunContext{}, &memory);
  const auto alone = screen(few, Screening(other), {}, RunContext{});
  for (std::size_t i = 0; i < apart.size(); ++i) expect_same(apart[i], alone[i]);
}

TEST(Screening, ScoresOfACompleteModelAreChiSquared) {
  const Assimilation fit = support::assimilated(support::hidden_record(support::nothing, 0.01));
  const Screening screening(fit);
  for (const std::string form : {"q^3", "sign(v)", "q*v", "1", "t*q", "F^2"})
    EXPECT_LT(screening.score(support::plain_candidate(form), {}).gain, 12.0) << form;
}

}  // namespace
}  // namespace lacuna
