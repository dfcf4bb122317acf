// SPDX-License-Identifier: MIT
#include "lacuna/core/statistics/interval.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/base/random.hpp"
#include "core/statistics/determined.hpp"
#include "core/statistics/gaussian_information.hpp"
#include "core/statistics/robust_statistics.hpp"
#include "core/statistics/serial_correlation.hpp"
#include "core/statistics/significance.hpp"
#include "core/statistics/truncated_normal.hpp"
#include "lacuna/core/base/error.hpp"

namespace lacuna {
namespace {

/// Values of printed tables of Student's distribution, as many digits as they have.
TEST(StudentQuantile, AgreesWithTables) {
  EXPECT_NEAR(student_quantile_975(1.0), 12.7062047, 1e-7);
  EXPECT_NEAR(student_quantile_975(2.0), 4.3026527, 1e-7);
  EXPECT_NEAR(student_quantile_975(3.0), 3.1824463, 1e-7);
  EXPECT_NEAR(student_quantile_975(5.0), 2.5705818, 1e-7);
  EXPECT_NEAR(student_quantile_975(10.0), 2.2281389, 1e-7);
  EXPECT_NEAR(student_quantile_975(30.0), 2.0422725, 1e-7);
  EXPECT_NEAR(student_quantile_975(1e9), 1.9599640, 1e-7);
}

TEST(StudentQuantile, OfABandAgreesWithTables) {
  EXPECT_NEAR(student_quantile_95(1.0), 6.3137515, 1e-7);
  EXPECT_NEAR(student_quantile_95(10.0), 1.8124611, 1e-7);
  EXPECT_NEAR(student_quantile_95(1e9), 1.6448536, 1e-7);
  EXPECT_THROW(student_quantile_95(0.5), ArgumentError);
}

TEST(StudentQuantile, GoesOnBetweenWholeDegreesOfFreedom) {
  const double between = student_quantile_975(1.5);
  EXPECT_LT(between, 0.6 * student_quantile_975(1.0));
  EXPECT_GT(between, student_quantile_975(2.0));
}

TEST(NormalQuantile, IsTheLimitOfStudents) {
  EXPECT_NEAR(std::erf(kNormalQuantile975 / std::sqrt(2.0)), 0.95, 1e-15);
  EXPECT_NEAR(student_quantile_975(1e15), kNormalQuantile975, 1e-14);
}

TEST(Interval95, LiesAboutTheEstimate) {
  const auto normal = interval95(3.0, 0.5);
  EXPECT_DOUBLE_EQ(normal[0], 3.0 - 0.5 * kNormalQuantile975);
  EXPECT_DOUBLE_EQ(normal[1], 3.0 + 0.5 * kNormalQuantile975);
  EXPECT_EQ(interval95(3.0, 0.5, 2.0), (std::array<double, 2>{2.0, 4.0}));
}

TEST(Significance, TailOfChiSquaredIsThatOfTheTables) {
  EXPECT_NEAR(std::exp(log_chi_squared_tail(3.841459, 1.0)), 0.05, 1e-6);
  EXPECT_NEAR(std::exp(log_chi_squared_tail(11.344867, 3.0)), 0.01, 1e-6);
  EXPECT_NEAR(std::exp(log_chi_squared_tail(0.1, 2.0)), std::exp(-0.05), 1e-9);
  EXPECT_NEAR(log_chi_squared_tail(1e5, 2.0), -5e4, 1e-6);
}

TEST(Significance, OneCandidateKeepsItsSigma) {
  EXPECT_NEAR(sigma_of_gain(9.0, 1.0, 1.0), 3.0, 1e-6);
  EXPECT_NEAR(sigma_of_gain(2500.0, 1.0, 1.0), 50.0, 1e-6);
}

TEST(Significance, ManyCandidatesCost) {
  EXPECT_LT(sigma_of_gain(16.0, 1.0, 500.0), 2.4);
  EXPECT_EQ(sigma_of_gain(4.0, 1.0, 1000.0), 0.0);
  EXPECT_LT(sigma_of_gain(16.0, 3.0, 1.0), sigma_of_gain(16.0, 1.0, 1.0));
}

TEST(Determined, IsWhatHasAnErrorBelowAMillionTimesItsSize) {
  EXPECT_TRUE(is_determined(-2.0, 1.9e6));
  EXPECT_FALSE(is_determined(-2.0, 2.1e6));
  EXPECT_FALSE(is_determined(7.5e-12, 2e71));
  EXPECT_FALSE(is_determined(1.0, std::nan("")));
  EXPECT_TRUE(is_determined(0.0, 3.0)) << "what is 0 has no size";
}

constexpr double kInfinity = std::numeric_limits<double>::infinity();

double below(double q) { return 0.5 * std::erfc(-q / std::numbers::sqrt2); }

double density(double q) {
  return std::isinf(q) ? 0.0 : std::exp(-0.5 * q * q) / std::sqrt(2.0 * std::numbers::pi);
}

double times(double limit, double power, double at) {
  return std::isinf(limit) ? 0.0 : std::pow(limit, power) * at;
}

// Moments of the recurrence E z^k = (k - 1) E z^(k-2) + (a^(k-1) f(a) - b^(k-1) f(b)) / P.
TEST(TruncatedNormal, MomentsAreThoseOfTheRecurrence) {
  for (const auto& [low, high] : std::array<std::array<double, 2>, 6>{{{-kInfinity, kInfinity},
                                                                       {-1.0, 2.0},
                                                                       {0.5, kInfinity},
                                                                       {-kInfinity, -1.5},
                                                                       {-0.2, 0.3},
                                                                       {2.0, 2.5}}}) {
    const double p = below(high) - below(low), a = density(low) / p, b = density(high) / p;
    const double m1 = a - b, m2 = 1.0 + times(low, 1.0, a) - times(high, 1.0, b);
    const double m3 = 2.0 * m1 + times(low, 2.0, a) - times(high, 2.0, b);
    const double m4 = 3.0 * m2 + times(low, 3.0, a) - times(high, 3.0, b);
    const TruncatedNormal found = truncated_normal(low, high);
    EXPECT_NEAR(found.log_probability, std::log(p), 1e-8);
    EXPECT_NEAR(found.mean, m1, 1e-8);
    EXPECT_NEAR(found.variance, m2 - m1 * m1, 1e-8);
    EXPECT_NEAR(found.third, m3 - 3.0 * m1 * m2 + 2.0 * std::pow(m1, 3), 1e-7);
    EXPECT_NEAR(found.fourth, m4 - 4.0 * m1 * m3 + 6.0 * m1 * m1 * m2 - 3.0 * std::pow(m1, 4),
                1e-7);
  }
}

// Far out the density is exponential: mean 1/q behind the limit, variance 1/q^2.
TEST(TruncatedNormal, FarOutItIsExponential) {
  for (const double q : {1e3, 1e6}) {
    const TruncatedNormal above = truncated_normal(q, kInfinity);
    EXPECT_NEAR((above.mean - q) * q, 1.0, 1e-3);
    EXPECT_NEAR(above.variance * q * q, 1.0, 1e-5);
    EXPECT_NEAR(above.third * q * q * q, 2.0, 1e-4);
    EXPECT_NEAR(above.fourth * q * q * q * q, 9.0, 1e-3);
    const TruncatedNormal under = truncated_normal(-kInfinity, -q);
    EXPECT_DOUBLE_EQ(under.log_probability, above.log_probability);
    EXPECT_DOUBLE_EQ(under.mean, -above.mean);
    EXPECT_NEAR(under.third * q * q * q, -2.0, 1e-4);
  }
}

TEST(TruncatedNormal, BetweenNarrowLimitsItIsUniform) {
  const TruncatedNormal found = truncated_normal(1.0, 1.0 + 1e-6);
  EXPECT_NEAR(found.mean, 1.0 + 5e-7, 1e-12);
  EXPECT_NEAR(found.variance * 12e12, 1.0, 1e-6);
  EXPECT_NEAR(found.log_probability, std::log(1e-6 * density(1.0)), 1e-6);
}

Vector normal_values(Index n, Random& random) {
  Vector values(n);
  for (double& value : values) value = random.normal();
  return values;
}

TEST(NormalQuantiles, AreThoseOfTheNormalDistribution) {
  const Vector quantiles = normal_quantiles(5);
  const Vector expected{{-1.281552, -0.524401, 0.0, 0.524401, 1.281552}};
  EXPECT_LT((quantiles - expected).norm(), 1e-5);
  EXPECT_EQ(normal_quantiles(0).size(), 0);
  EXPECT_THROW(normal_quantiles(-1), ArgumentError);
}

TEST(NormalScores, DependOnRanksAlone) {
  const Vector quantiles = normal_quantiles(4);
  const Vector scores = normal_scores(Vector{{3.0, -1.0, 1e300, 0.0}}, quantiles);
  EXPECT_EQ(scores, (Vector{{quantiles[2], quantiles[0], quantiles[3], quantiles[1]}}));
  const Vector equal = normal_scores(Vector{{2.0, 5.0, 2.0, 7.0}}, quantiles);
  EXPECT_DOUBLE_EQ(equal[0], 0.5 * (quantiles[0] + quantiles[1]));
  EXPECT_DOUBLE_EQ(equal[2], equal[0]);
  EXPECT_THROW(normal_scores(Vector::Ones(3), quantiles), ArgumentError);
}

/// A correlation of 0.6: log(1 / 0.64) / 2 = 0.2231.
TEST(GaussianInformation, IsThatOfTheCorrelation) {
  Random random(1);
  const Vector x = normal_values(200000, random), noise = normal_values(200000, random);
  EXPECT_NEAR(gaussian_information(x, 0.6 * x + 0.8 * noise), 0.2231, 0.003);
  EXPECT_NEAR(gaussian_information(x, noise), 0.0, 1e-4);
  EXPECT_EQ(gaussian_information(x, Vector::Constant(200000, 0.1)), 0.0);
  EXPECT_EQ(gaussian_information({}, {}), 0.0);
  EXPECT_THROW(gaussian_information(x, Vector::Ones(3)), ArgumentError);
}

TEST(SignedInformation, ShowsWhatIsNotAroundZero) {
  Random random(2);
  const Vector one = Vector::Constant(100, 0.1);
  int taken = 0;
  for (int draw = 0; draw < 400; ++draw) {
    const double value = 200.0 * signed_information(normal_values(100, random), one);
    taken += log_chi_squared_tail(value, 1.0) < std::log(0.1);
  }
  EXPECT_NEAR(taken, 40, 20);
  const Vector off = normal_values(100, random).array() + 1.0;
  EXPECT_GT(signed_information(off, one), 0.1);
  EXPECT_EQ(signed_information(-off, one), signed_information(off, one));
  EXPECT_GT(signed_information(off, off), 10.0);
  EXPECT_EQ(signed_information(off, Vector::Zero(100)), 0.0);
  EXPECT_THROW(signed_information(off, Vector::Zero(5)), ArgumentError);
}

TEST(RobustStatistics, MedianIsTheMeanOfTheTwoMiddleValues) {
  EXPECT_EQ(median({5.0, 1.0, 3.0}), 3.0);
  EXPECT_EQ(median({5.0, 1.0, 3.0, 2.0}), 2.5);
}

TEST(RobustStatistics, UpperMedianIsOneOfTheValues) {
  EXPECT_EQ(upper_median({5.0, 1.0, 3.0}), 3.0);
  EXPECT_EQ(upper_median({5.0, 1.0, 3.0, 2.0}), 3.0);
}

TEST(RobustStatistics, QuantilesAreValues) {
  std::vector<double> values{4.0, 0.0, 3.0, 1.0, 2.0};
  EXPECT_EQ(quantile(values, 0.0), 0.0);
  EXPECT_EQ(quantile(values, 0.5), 2.0);
  EXPECT_EQ(quantile(values, 0.8), 3.0);
  EXPECT_EQ(quantile(values, 1.0), 4.0);
}

/// Few sizes are partitioned, many are counted by their leading bits.
TEST(RobustStatistics, MedianSizeIsTheUpperMedianOfFewAndOfMany) {
  for (const std::size_t count : {7U, 4095U, 4096U, 20001U}) {
    Random random(count);
    std::vector<double> sizes(count);
    for (double& size : sizes) size = std::abs(random.normal()) * std::exp(random.normal());
    std::vector<double> sorted = sizes;
    std::sort(sorted.begin(), sorted.end());
    EXPECT_EQ(median_size(sizes), sorted[count / 2]) << count;
  }
}

TEST(RobustStatistics, MagnitudesHaveNoSign) {
  EXPECT_EQ(magnitudes(Vector{{-2.0, 0.0, 3.0}}), (std::vector<double>{2.0, 0.0, 3.0}));
}

TEST(RobustStatistics, NormalDeviationIgnoresFewThatAreFarOff) {
  Random random(3);
  std::vector<double> sizes(20000);
  for (double& size : sizes) size = 2.0 * std::abs(random.normal());
  std::fill_n(sizes.begin(), 200, 1e6);
  EXPECT_NEAR(normal_deviation(sizes), 2.0, 0.06);
}

/// r_i = memory r_(i-1) + white noise; rho_l = memory^l.
Vector first_order_series(double memory, Index n) {
  Random random(3);
  Vector series(n);
  double value = 0.0;
  for (double& entry : series) entry = value = memory * value + random.normal();
  return series;
}

TEST(SerialCorrelation, WhiteNoiseHasNone) {
  const SerialCorrelation found = serial_correlation(first_order_series(0.0, 20000));
  EXPECT_NEAR(found.time, 1.0, 0.01);
  EXPECT_EQ(found.reach, 5);
}

TEST(SerialCorrelation, ChanceIsNotCountedAsCorrelation) {
  // Squares of chance add 5 / 100 to the sum of a series of 100; without them it scatters by
  // sqrt(5 * 2) / 100 around 0, of which the half above counts, twice.
  Random random(8);
  double sum = 0.0;
  for (int draw = 0; draw < 400; ++draw) {
    Vector series(100);
    for (double& entry : series) entry = random.normal();
    sum += serial_correlation(series).time;
  }
  EXPECT_NEAR(sum / 400.0,
              1.0 + 2.0 * std::sqrt(10.0) / 100.0 / std::sqrt(2.0 * std::numbers::pi), 0.03);
}

TEST(SerialCorrelation, SumsTheSquaresOfAFirstOrderSeries) {
  const double memory = 0.9;
  const double expected = (1.0 + memory * memory) / (1.0 - memory * memory);
  const SerialCorrelation found = serial_correlation(first_order_series(memory, 200000));
  EXPECT_NEAR(found.time, expected, 0.1 * expected);
  EXPECT_NEAR(static_cast<double>(found.reach), 5.0 * expected, 0.6 * expected);
}

TEST(SerialCorrelation, EndsAtAQuarterOfTheSeries) {
  EXPECT_EQ(serial_correlation(Vector::Ones(100)).reach, 25);
  EXPECT_EQ(serial_correlation(Vector::Zero(100)).time, 1.0);
  EXPECT_EQ(serial_correlation(Vector()).reach, 0);
}

}  // namespace
}  // namespace lacuna
