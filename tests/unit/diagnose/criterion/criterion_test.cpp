// SPDX-License-Identifier: MIT
// The criterion of a diagnosis, and what an effect contributes.
#include "lacuna/diagnose/criterion/criterion.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "diagnose/criterion/effect_parts.hpp"
#include "diagnose/criterion/extended_bic.hpp"
#include "diagnose/criterion/holdout.hpp"
#include "diagnose/criterion/shape_bounds.hpp"
#include "lacuna/core/base/options.hpp"
#include "lacuna/diagnose/criterion/options.hpp"
#include "lacuna/trajectories/smoother/disturbance_test.hpp"
#include "support/assimilated_oscillator.hpp"

namespace lacuna {
namespace {

inline constexpr StageInfo kTwo{"two", "Two a parameter, for tests", ""};

struct TwoOptions {
  static constexpr const StageInfo& kInfo = kTwo;
  void describe(OptionVisitor&) {}
};

class Two final : public Configured<Criterion, TwoOptions> {
  double do_penalty(const Evidence& evidence) const override {
    return 2.0 * evidence.parameters;
  }
};

TEST(Criterion, IsTheDevianceAndThePenalty) {
  EXPECT_DOUBLE_EQ(Two{}.value({10.0, 3.0, 100.0, 0.0}), 16.0);
  EXPECT_DOUBLE_EQ(Two{}.penalty({10.0, 3.0, 100.0, 0.0}), 6.0);
}

TEST(Criterion, AFitThatFailedIsTheWorst) {
  for (const double deviance :
       {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()})
    EXPECT_EQ(Two{}.value({deviance, 1.0, 10.0, 0.0}), std::numeric_limits<double>::infinity());
}

TEST(Criterion, RefusesCountsThatAreNone) {
  EXPECT_THROW(Two{}.value({0.0, -1.0, 10.0, 0.0}), ArgumentError);
  EXPECT_THROW(Two{}.value({0.0, 1.0, std::nan(""), 0.0}), ArgumentError);
  EXPECT_THROW(Two{}.penalty({0.0, 1.0, 10.0, -0.1}), ArgumentError);
}

TEST(ExtendedBic, PaysLogOfTheSamplesForAParameter) {
  // 3 parameters, e^2 samples.
  EXPECT_NEAR(ExtendedBic{}.penalty({0.0, 3.0, std::exp(2.0), 0.0}), 6.0, 1e-12);
}

TEST(ExtendedBic, PaysForBeingTheBestOfMany) {
  // Two effects, each the best of e^3: 2 (3 + 3).
  EXPECT_NEAR(ExtendedBic{}.penalty({0.0, 0.0, 100.0, 6.0}), 12.0, 1e-12);
  EXPECT_DOUBLE_EQ(ExtendedBic({.choice = 0.0}).penalty({0.0, 0.0, 100.0, 6.0}), 0.0);
}

TEST(ExtendedBic, IsTheLaplaceApproximationOfTheEvidenceOfAGaussianMean) {
  // n observations of unit variance with a mean that has a unit-information prior: the exact
  // evidence differs from exp(-BIC/2) by a bounded factor, whatever n.
  const auto exact = [](double n, double mean) {
    const double with = -0.5 * n * mean * mean / (1.0 + n) - 0.5 * std::log1p(n);
    const double without = -0.5 * n * mean * mean;
    return with - without;  // log evidence ratio, prior N(0, 1)
  };
  const auto approximate = [](double n, double mean) {
    const ExtendedBic bic;
    return 0.5 * (bic.value({n * mean * mean, 0.0, n, 0.0}) - bic.value({0.0, 1.0, n, 0.0}));
  };
  for (const double n : {100.0, 1e4, 1e6})
    EXPECT_NEAR(exact(n, 0.3), approximate(n, 0.3), 0.1) << n;
}

TEST(ExtendedBic, RefusesAChoiceOutOfItsRange) {
  EXPECT_THROW(ExtendedBic({.choice = 1.5}), ConfigError);
}

HoldoutVerdict verdict(double before, double after, double floor) {
  return holdout_verdict({before, after, floor}, DecisionOptions{});
}

TEST(Holdout, HalfOfTheSquareAboveTheFloorHasToGo) {
  // Above the floor of 0.6 stand 1 - 0.36 = 0.64; half of it goes at after^2 = 0.68.
  EXPECT_EQ(verdict(1.0, 0.82, 0.6), HoldoutVerdict::Confirmed);
  EXPECT_EQ(verdict(1.0, 0.83, 0.6), HoldoutVerdict::Little);
}

TEST(Holdout, WhereThereIsHardlyAGapThereIsNothingToShow) {
  EXPECT_EQ(verdict(1.09, 1.08, 1.0), HoldoutVerdict::Confirmed);
  EXPECT_EQ(verdict(1.09, 1.09, 1.0), HoldoutVerdict::Little) << "nothing shrinks";
  EXPECT_EQ(verdict(1.11, 1.11, 1.0), HoldoutVerdict::Little);
}

TEST(DecisionOptions, StayInTheirRanges) {
  DecisionOptions options;
  options.major = 1.5;
  EXPECT_THROW(StandardDecision{options}, ConfigError);
}

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
  const ShapeParameter jump{"width", "m", 0.1, 10.0, true, true};
  EXPECT_FALSE(is_on_bound(jump, 0.1)) << "as good as a jump";
  EXPECT_TRUE(is_on_bound(jump, 10.0));
  EXPECT_TRUE(is_on_bound({"edge", "m", 0.0, 1.0, false}, 0.0009))
      << "a thousandth of the range";
}

}  // namespace
}  // namespace lacuna
