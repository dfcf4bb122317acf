// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include "diagnose/criterion/effect_parts.hpp"
#include "diagnose/criterion/shape_bounds.hpp"
#include "lacuna/trajectories/smoother/disturbance_test.hpp"
#include "support/assimilated_oscillator.hpp"

namespace lacuna {
namespace {

Matrix gram_of(const Matrix& parts) {
  return parts.transpose() * parts / static_cast<double>(parts.rows());
}

TEST(EffectParts, ThreeMayCancelThoughNoTwoDo) {
  Matrix parts(2, 3);
  parts << 1.0, 1.0, -2.0, 1.0, -1.0, 0.0;
  const Cancellation found = largest_cancellation({{"a", "b", "c"}, 1, gram_of(parts)});
  EXPECT_NEAR(found.left, 0.0, 1e-12);
  EXPECT_EQ(found.terms.size(), 3u);
}

TEST(EffectParts, AnEffectHasToBeAmongThem) {
  Matrix parts(2, 3);
  parts << 1.0, 2.0, -2.0, -1.0, 2.0, -2.0;
  const Cancellation found = largest_cancellation({{"a", "b", "c"}, 1, gram_of(parts)});
  EXPECT_GT(found.left, 0.3) << "what two nominal terms do to each other is no effect's";
  EXPECT_EQ(largest_cancellation({{"a"}, 1, Matrix::Ones(1, 1)}).left, 1.0);
}

TEST(EffectParts, CoefficientsMoveOutOfScale) {
  const Assimilation fit = support::assimilated(support::hidden_record(support::nothing, 0.01));
  const auto moved_from = [&](double factor, const DecisionOptions& decision = {}) {
    const OdeModel model = support::oscillator();
    std::vector<Equation> equations = model.equations();
    for (WeightedTerm& summand : equations[1])
      if (summand.term.name() == "q") summand.coefficient *= factor;
    const OdeModel given{model.states(), model.inputs(), equations, model.time_unit()};
    return moved_coefficients(fit, given, fit.free.size(), decision);
  };
  EXPECT_TRUE(moved_from(1.0).empty());
  ASSERT_EQ(moved_from(-1.0).size(), 1u);
  EXPECT_TRUE(moved_from(-1.0)[0].changes_sign());
  EXPECT_EQ(moved_from(-1.0)[0].term, "q");
  EXPECT_TRUE(moved_from(-20.0).empty()) << "a minor part of what was given";
  ASSERT_EQ(moved_from(0.09).size(), 1u);
  EXPECT_FALSE(moved_from(0.09)[0].changes_sign());
  EXPECT_TRUE(moved_from(0.11).empty());
  EXPECT_TRUE(moved_from(-1.0, {.significance = 1e6}).empty()) << "not distinguished from 0";
}

TEST(EffectParts, ExplanationsAreApartByWhatTheyAddAlongThePath) {
  const Assimilation fit = support::assimilated(support::hidden_record(support::nothing, 0.01));
  const auto with = [&](const std::string& form, double coefficient) {
    return Explanation{{{support::plain_candidate(form), Vector(0), coefficient, 0.0}}, fit};
  };
  const OdeModel nominal = support::oscillator();
  const auto v = fit.records[0].slots.col(1).array();
  const double rms = std::sqrt(v.square().mean()) / rate_rms(fit)[1];
  EXPECT_NEAR(apart(with("v", 0.5), with("v", 0.2), nominal, 1), 0.3 * rms, 1e-9);
  EXPECT_EQ(apart(with("v", 0.5), with("clip(v,-100,100)", 0.5), nominal, 1), 0.0);
  Explanation remembers = with("v", 0.5);
  remembers.effects[0].candidate.memory = {MemoryState{}};
  EXPECT_TRUE(std::isinf(apart(remembers, with("v", 0.5), nominal, 1)));
}

TEST(EffectParts, ActWhereTheyAreMoreThanNothing) {
  const Assimilation fit = support::assimilated(support::hidden_record(support::nothing, 0.01));
  const auto& slots = fit.records[0].slots;
  FittedEffect stop{support::stop_candidate(0.0), Vector::Constant(1, -0.1), 3.0};
  const double deepest = -0.1 - slots.col(0).minCoeff();
  const double expected =
      static_cast<double>((slots.col(0).array() < -0.1 - 0.01 * deepest).count()) /
      static_cast<double>(slots.rows());
  EXPECT_NEAR(acting_fraction(stop, fit, 0.01), expected, 1e-12);
  EXPECT_GT(expected, 0.1);
  EXPECT_LT(expected, 0.9);
}

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
