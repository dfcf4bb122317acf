// SPDX-License-Identifier: MIT
#include "lacuna/effects/forms.hpp"

#include <gtest/gtest.h>

#include "support/diagnosis_scope.hpp"

namespace lacuna {
namespace {

TEST(EffectForms, PatternsAreFilledAndOwnNamesKeptApart) {
  const Scope scope = support::oscillator_scope();
  EXPECT_EQ(formula(scope, "clip(x,-edge,edge)", {{"x", parse_expression("q-F")}}),
            parse_expression("clip(q-F,-edge,edge)"));
  EXPECT_EQ(formula(scope, "x/q", {{"x", Expression::variable("q")}}),
            parse_expression("q/q_"));
}

TEST(EffectForms, StartsSpanTheirRange) {
  const std::vector<Vector> starts = geometric_starts(1.0, 100.0, 3);
  ASSERT_EQ(starts.size(), 3u);
  EXPECT_NEAR(starts[1][0], 10.0, 1e-12);
  EXPECT_LE(starts[2][0], 100.0);
  EXPECT_EQ(starts_at({2.0, 3.0})[1][0], 3.0);
}

}  // namespace
}  // namespace lacuna
