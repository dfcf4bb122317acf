// SPDX-License-Identifier: MIT
#include "lacuna/effects/patterns.hpp"

#include <gtest/gtest.h>

#include "lacuna/effects/forms.hpp"
#include "support/diagnosis_scope.hpp"

namespace lacuna {
namespace {

TEST(EffectPatterns, AreRecognisedWhateverTheirParametersAreCalled) {
  const Scope scope = support::oscillator_scope();
  const Expression x = parse_expression("q-F");
  const Candidate bend = shaped_candidate(formula(scope, "clip(x,-gap,gap)", {{"x", x}}), x,
                                          {"gap", "m", 0.1, 1.0, false}, starts_at({0.5}));
  EXPECT_TRUE(has_form(bend, "clip(x,-a,a)"));
  EXPECT_FALSE(has_form(bend, "clip(x,-a,b)")) << "there is no second parameter";
  EXPECT_FALSE(has_form(bend, "x-clip(x,-a,a)"));
  EXPECT_TRUE(has_form(play_of(scope, 1, Expression::variable("F")), "clip(m-x,-a,a)"));
}

TEST(EffectPatterns, ARestIsAPartOfATermOrTheWhole) {
  const Scope scope = support::oscillator_scope();
  const NamingOptions options;
  Candidate play = play_of(scope, 1, Expression::variable("q"));
  play.equation = 1;
  const auto fitted = [&](double coefficient) {
    return FittedForm{play,   play.starts.front(), coefficient, 0.01, scope.model, scope,
                      options};
  };
  EXPECT_TRUE(is_part_of_term(fitted(-2.0)));
  EXPECT_FALSE(is_whole_term(fitted(-2.0)));
  EXPECT_TRUE(is_whole_term(fitted(-4.1)));
  EXPECT_FALSE(is_part_of_term(fitted(2.0)));
  EXPECT_EQ(play.least, -8.0);
}

}  // namespace
}  // namespace lacuna
