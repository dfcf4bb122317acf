// SPDX-License-Identifier: MIT
#include "diagnose/criterion/shape_bounds.hpp"

#include <gtest/gtest.h>

#include "support/assimilated_oscillator.hpp"

namespace lacuna {
namespace {

FittedEffect stop_at(double edge) {
  return {support::stop_candidate(0.0), Vector::Constant(1, edge), -3.0, 0.01};
}

/// A lag whose time constant may be between 0.1 and 10.
FittedEffect lag_of(double tau) {
  Candidate candidate;
  candidate.form = parse_expression("slow-v");
  candidate.shapes = {{"tau", "s", 0.1, 10.0, true}, {"fraction", "", 0.05, 0.95, false}};
  candidate.memory = {
      {"slow", parse_expression("(fraction*v-slow)/tau"), parse_expression("v")}};
  return {candidate, Vector{{tau, 0.05}}, 1.0, 0.01};
}

/// A channel that is sampled late, by at most 0.4 s.
FittedEffect skew_of(double skew) {
  Candidate candidate;
  candidate.form = parse_expression("v+skew/2*a");
  candidate.shapes = {{"skew", "s", -0.4, 0.4, false}, {"edge", "m", 0.0, 1.0, false}};
  candidate.place = Place::Channel;
  return {candidate, Vector{{skew, 0.0}}, 1.0, 0.01};
}

TEST(ShapeBounds, ATimeThatTheRecordsDoNotShowIsOnABound) {
  EXPECT_FALSE(time_on_bound(lag_of(1.0), "s").has_value()) << "the fraction is no time";
  EXPECT_EQ(time_on_bound(lag_of(0.1), "s"), 0.1);
  EXPECT_EQ(time_on_bound(lag_of(10.0), "s"), 10.0);
  EXPECT_FALSE(time_on_bound(stop_at(0.0), "s").has_value()) << "an edge is no time";
  EXPECT_EQ(time_on_bound(skew_of(-0.4), "s"), -0.4);
  EXPECT_FALSE(time_on_bound(skew_of(0.1), "s").has_value());
}

TEST(ShapeBounds, ARangeEndsWhereASearchResolvesNoMore) {
  const ShapeParameter shape{"tau", "s", 0.1, 10.0, true};
  EXPECT_TRUE(is_on_bound(shape, 0.1005));
  EXPECT_FALSE(is_on_bound(shape, 0.102));
  EXPECT_TRUE(is_on_bound(shape, 9.995));
  EXPECT_FALSE(is_on_bound(shape, 9.9));
  EXPECT_TRUE(is_on_bound({"edge", "m", 0.0, 1.0, false}, 0.0009)) << "a thousandth of the range";
}

}  // namespace
}  // namespace lacuna
