// SPDX-License-Identifier: MIT
#include "report/pages/invariant_text.hpp"

#include <gtest/gtest.h>

#include "lacuna/model/files/ode_text.hpp"

namespace lacuna {
namespace {

TEST(RelationText, ReadsLikeAnEquation) {
  EXPECT_EQ(relation_text({{{"x^2", 1.0, 0.0}, {"y^2", 1.0003, 0.001}}, 4.0012, 0.011, 0.01}),
            "x^2 + y^2 = 4.001 +- 0.022");
  EXPECT_EQ(relation_text({{{"x", 1.0, 0.0}, {"y", -0.5012, 5e-5}}, -1.0, 0.1, 0.1}),
            "x - 0.5012*y = -1 +- 0.2");
  EXPECT_EQ(relation_text({{{"x", 1.0, 0.0}, {"y", 0.5012, 0.002}}, -1.0, 0.1, 0.1}),
            "x + 0.5*y = -1 +- 0.2");
  EXPECT_EQ(relation_text({{{"z", 1.0, 0.0}}, 3.0, 0.0, 0.0}), "z = 3");
  EXPECT_EQ(relation_text({{{"z", 1.0, 0.0}}, 7.5e-12, 2e71, 2e71}), "z = 0 +- 3.9e+71");
}

TEST(RelationText, SaysWhatCannotBeToldApart) {
  EXPECT_EQ(relation_sentence({{{"S", 1.0, 0.0}, {"I", 1.0, 0.001}}, 1.0, 0.01, 0.01}),
            "S + I = 1 +- 0.02 on these data: S, I and a constant cannot be distinguished");
}

TEST(TrappingSentence, ReadsLikeAnInequality) {
  const OdeModel model = parse_ode("dx/dt = -x\ndy/dt = -y\n", "a.ode");
  EXPECT_EQ(trapping_sentence(model, {Vector{{1e-9, -2.5}}, Vector{{1.0, 0.25}}, 101.33, 1.0}),
            "All paths come into x^2 + 0.25*(y + 2.5)^2 <= 101^2 and stay");
}

}  // namespace
}  // namespace lacuna
