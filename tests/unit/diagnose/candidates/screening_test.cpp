// SPDX-License-Identifier: MIT
// Candidates that are screened, and the names of what is fitted.
#include <gtest/gtest.h>

#include "diagnose/candidates/name_table.hpp"
#include "diagnose/candidates/screening.hpp"
#include "lacuna/effects/families.hpp"
#include "support/assimilated_oscillator.hpp"
#include "support/effect_forms.hpp"

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

/// Two bends between an arm and its drive, of which the nominal model has the slope 60.
struct Bends {
  Scope scope = support::scope_of(support::model_of_lines(
      {{"q", {{"v", 1.0}}}, {"v", {{"q", -60.0}, {"u", 60.0}}}}, {"u"}));
  NamingOptions options;

  std::vector<std::string> names(double coefficient,
                                 const std::vector<Stage<Effect>>& effects) const {
    const FittedEffect fitted{
        support::candidate_of<kPiecewiseLinear>(scope, 1, "clip(q-u,-edge,edge)"),
        Vector::Constant(1, 0.3), coefficient, 0.1};
    std::vector<std::string> result;
    for (const Name& name : NameTable{effects, scope, options}.names_of(fitted, scope.model))
      result.push_back(name.name);
    return result;
  }
};

TEST(NameTable, NamesFollowFromTheFittedNumbers) {
  const Bends bends;
  const std::vector<Stage<Effect>> effects{FamilyEffect<kDeadZone>(),
                                           FamilyEffect<kPiecewiseLinear>()};
  EXPECT_EQ(bends.names(30.0, effects), std::vector<std::string>{"piecewise-linear"});
  EXPECT_EQ(bends.names(60.0, effects), std::vector<std::string>{"dead-zone"});
}

}  // namespace
}  // namespace lacuna
