// SPDX-License-Identifier: MIT
#include "lacuna/candidates/candidate.hpp"

#include <gtest/gtest.h>

#include "lacuna/core/error.hpp"

namespace lacuna {
namespace {

Candidate delayed() {
  Candidate candidate;
  candidate.form = "a_1*delay(x,a)-b*x";
  candidate.shapes = {{"a", "s", 0.0, 2.0, false}, {"b", "", -2.0, 2.0, false}};
  return candidate;
}

TEST(Candidate, NumbersStandInPlaceOfShapes) {
  const std::vector<double> values{0.25, -1.5};
  EXPECT_EQ(bind_form(delayed(), values), parse_expression("a_1*delay(x,0.25)-(-1.5)*x"));
}

TEST(Candidate, ExponentsAreNotNames) {
  Candidate candidate;
  candidate.form = "1e5*x^2*e";
  candidate.shapes = {{"e", "", 0.0, 1.0, false}};
  const std::vector<double> values{0.5};
  EXPECT_EQ(bind_form(candidate, values), parse_expression("1e5*x^2*0.5"));
}

TEST(Candidate, EveryShapeNeedsAValue) {
  const std::vector<double> one{0.25};
  EXPECT_THROW(bind_form(delayed(), one), ArgumentError);
}

}  // namespace
}  // namespace lacuna
