// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "diagnose/criterion/holdout.hpp"
#include "lacuna/core/base/options.hpp"
#include "lacuna/diagnose/criterion/criterion.hpp"
#include "lacuna/diagnose/criterion/extended_bic.hpp"
#include "lacuna/diagnose/criterion/options.hpp"

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

}  // namespace
}  // namespace lacuna
