// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "core/base/random.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/core/statistics/interval.hpp"
#include "lacuna/data/records/marks.hpp"
#include "lacuna/dynamics/integration/simulate.hpp"
#include "lacuna/model/files/model_file.hpp"
#include "lacuna/trajectories/fit/fit.hpp"
#include "trajectories/fit/prediction/value_limits.hpp"

namespace lacuna {
namespace {

// Bands beside those of linear regression, which are exact, and beside draws.
constexpr const char* kLine = "param a = 1\ndx/dt = a\n";

/// A record of one state at given times.
Dataset record_of(const Vector& time, const Vector& values) {
  Dataset data{"s", {{"x", "V"}}, {}, {}, {}};
  data.trajectories = {
      {"record", time, Matrix(values), Matrix(time.size(), 0), Matrix()}};
  return data;
}

/// x = 1 + 2 t with noise of 0.5.
Dataset line(std::uint64_t seed, Index samples = 12) {
  Random random(seed);
  const Vector time = sample_times(0.0, 0.5, samples);
  Vector values = 1.0 + 2.0 * time.array();
  for (double& value : values) value += 0.5 * random.normal();
  return record_of(time, values);
}

Fit fitted(const std::string& model, const Dataset& data) {
  FitOptions options;
  options.bands = true;
  return fit(parse_ode_system(model, "m.ode"), data, {}, options);
}

// Regression of a straight line: the variance of its value at t is s^2 (1/n + (t - mean)^2 / S).
TEST(FitBands, OfALineAreThoseOfLinearRegression) {
  const Dataset data = line(3);
  const Fit found = fitted(kLine, data);
  const Trajectory& record = data.trajectories[0];
  const Vector centred = record.time.array() - record.time.mean(), x = record.states.col(0);
  const double slope = centred.dot(x) / centred.squaredNorm();
  const Vector run = x.mean() + slope * centred.array();
  const double n = 12.0, s = (x - run).norm() / std::sqrt(n - 2.0);
  const double reach = student_quantile_95(n - 2.0);
  ASSERT_EQ(found.bands.size(), 1u);
  const FitBands& bands = found.bands[0];
  ASSERT_EQ(bands.quantities.size(), 1u);
  EXPECT_EQ(bands.quantities[0].name, "x");
  for (Index i = 0; i < record.samples(); ++i) {
    const double error = s * std::sqrt(1.0 / n + centred[i] * centred[i] / centred.squaredNorm());
    const double value = bands.value(i, 0), wide = reach * std::hypot(s, error);
    EXPECT_NEAR(value, run[i], 0.01 * error) << "a search ends that near";
    EXPECT_NEAR(bands.error(i, 0), error, 1e-3 * error);
    EXPECT_NEAR(bands.high(i, 0) - value, reach * error, 2e-3 * reach * error);
    EXPECT_NEAR(value - bands.low(i, 0), reach * error, 2e-3 * reach * error);
    EXPECT_NEAR(bands.most(i, 0) - value, wide, 2e-3 * wide);
    EXPECT_NEAR(value - bands.least(i, 0), wide, 2e-3 * wide);
  }
}

TEST(FitBands, AreThereWhereTheyAreWanted) {
  EXPECT_TRUE(fit(parse_ode_system(kLine, "m.ode"), line(3), {}).bands.empty());
}

// An exponential has bands by the derivatives of its value: those of finite differences of
// simulate() are the same.
TEST(FitBands, AreTheDeltaMethodWithExactDerivatives) {
  Random random(4);
  const Vector time = sample_times(0.0, 0.2, 40);
  Vector values = 5.0 * (-0.7 * time.array()).exp();
  for (double& value : values) value += 0.1 * random.normal();
  const Fit found = fitted("param k = 1\ndx/dt = -k*x\ninitial x = 5 fixed\n",
                           record_of(time, values));
  const double k = found.numbers.at(0).value, error = std::sqrt(found.spread.covariance(0, 0));
  ASSERT_EQ(found.bands.at(0).time, time);
  ASSERT_EQ(time.size(), 40);
  for (Index i = 0; i < time.size(); ++i)
    EXPECT_NEAR(found.bands[0].error(i, 0), 5.0 * time[i] * std::exp(-k * time[i]) * error,
                1e-4 * error);
}

TEST(FitBands, OfAStateThatNothingShowsHaveNoEnds) {
  const Fit found = fitted("param a = 1\ndx/dt = a\ndz/dt = -z\n",
                           [] {
                             Dataset data = line(3);
                             data.states.push_back({"z", ""});
                             data.reconstructed = {false, true};
                             Trajectory& record = data.trajectories[0];
                             record.states.conservativeResize(Eigen::NoChange, 2);
                             record.states.col(1).setZero();
                             record.marks = Matrix::Zero(record.samples(), 2);
                             record.marks.col(1).setConstant(number_of(Mark::Missing));
                             return data;
                           }());
  EXPECT_TRUE(std::isnan(found.bands[0].error(0, 1)));
  EXPECT_TRUE(std::isnan(found.bands[0].high(0, 1)));
  EXPECT_TRUE(std::isfinite(found.bands[0].error(0, 0)));
}

// From a known start the variance of a line at t is that of its slope times t^2.
TEST(Predict, OfALineFromAnotherStartIsThatOfItsSlope) {
  const Dataset data = line(3);
  const Fit found = fitted(kLine, data);
  const Vector time = sample_times(1.0, 2.0, 5);
  const std::vector<FitBands> predicted = predict(found, record_of(time, Vector::Constant(5, 7.0)));
  ASSERT_EQ(predicted.size(), 1u);
  const double slope = found.numbers[0].value, error = *found.numbers[0].standard_error;
  for (Index i = 0; i < time.size(); ++i) {
    EXPECT_NEAR(predicted[0].value(i, 0), 7.0 + slope * (time[i] - 1.0), 1e-6);
    EXPECT_NEAR(predicted[0].error(i, 0), error * (time[i] - 1.0), 2e-3 * error);
    EXPECT_GT(predicted[0].most(i, 0), predicted[0].high(i, 0));
  }
}

TEST(Predict, StartsAreThoseOfTheModelWhereTheRecordHasNone) {
  Dataset data = line(3);
  const Fit found =
      fitted("param a = 1\ndx/dt = a\ninitial x = 1 deviation 0.3\n", data);
  Trajectory& record = data.trajectories[0];
  record.marks = Matrix::Constant(record.samples(), 1, number_of(Mark::Missing));
  const FitBands bands = predict(found, data).at(0);
  EXPECT_DOUBLE_EQ(bands.value(0, 0), 1.0);
  EXPECT_NEAR(bands.error(0, 0), 0.3, 1e-9);
  const double slope = std::sqrt(found.spread.covariance(0, 0)), last = record.time[11];
  EXPECT_NEAR(bands.error(11, 0), std::hypot(0.3, slope * last), 1e-6);
  const Fit without = fitted(kLine, line(3));
  EXPECT_THROW(predict(without, data), DataError);
}

TEST(Predict, NumbersOfSingleRecordsAreRefused) {
  Dataset data = line(3);
  data.trajectories.push_back(line(4).trajectories[0]);
  const Fit found = fitted("param a = 1 per_record\ndx/dt = a\n", data);
  EXPECT_EQ(found.bands.size(), 2u);
  EXPECT_THROW(predict(found, data), ModelError);
}

// Logistic growth: of 300 records, bands contain the true run, and a new value, in 90 %.
TEST(Predict, BandsContainWhatTheySay) {
  constexpr int kDraws = 300;
  const Vector time = sample_times(0.0, 0.4, 25);
  const auto truth = [](double x, double t) {
    return 10.0 / (1.0 + (10.0 / x - 1.0) * std::exp(-t));
  };
  const SystemModel system = parse_ode_system(
      "param r = 1\nparam K = 10\ndx/dt = r*x*(1-x/K)\ninitial x = 0.5 fixed\n", "m.ode");
  const Vector ahead = sample_times(0.0, 1.0, 6);
  int inside = 0, value_inside = 0, all = 0;
  for (std::uint64_t draw = 1; draw <= kDraws; ++draw) {
    Random random(draw);
    Vector values(time.size());
    for (Index i = 0; i < time.size(); ++i)
      values[i] = truth(0.5, time[i]) + 0.5 * random.normal();
    FitOptions options;
    options.effort = Thoroughness::Quick;
    const Fit found = fit(system, record_of(time, values), {}, options);
    const FitBands bands = predict(found, record_of(ahead, Vector::Constant(6, 1.0))).at(0);
    for (const Index i : {1, 3, 5}) {
      const double run = truth(1.0, ahead[i]), value = run + 0.5 * random.normal();
      inside += run >= bands.low(i, 0) && run <= bands.high(i, 0) ? 1 : 0;
      value_inside += value >= bands.least(i, 0) && value <= bands.most(i, 0) ? 1 : 0;
      ++all;
    }
  }
  // One standard deviation of the first share is 1.7 % where the three times of a draw agree.
  EXPECT_NEAR(inside / static_cast<double>(all), 0.90, 0.05);
  EXPECT_NEAR(value_inside / static_cast<double>(all), 0.90, 0.03);
}

constexpr double kReach = 1.6448536269514722;  // the 95 % quantile of a normal number

double below(double q) { return 0.5 * std::erfc(-q / std::numbers::sqrt2); }

TEST(RunLimits, AreSymmetricOrByTheSameFactor) {
  EXPECT_DOUBLE_EQ(run_limits(3.0, 0.5, 2.0, false)[0], 2.0);
  EXPECT_DOUBLE_EQ(run_limits(3.0, 0.5, 2.0, false)[1], 4.0);
  const auto factor = run_limits(3.0, 0.3, 2.0, true);
  EXPECT_NEAR(factor[1] / 3.0, std::exp(0.2), 1e-12);
  EXPECT_NEAR(factor[0] * factor[1], 9.0, 1e-12);
}

TEST(ValueLimits, VariancesAdd) {
  const auto constant = value_limits({.constant = 0.4}, 2.0, 0.3, kReach);
  EXPECT_NEAR(constant[1] - 2.0, kReach * 0.5, 1e-12);
  EXPECT_NEAR(2.0 - constant[0], kReach * 0.5, 1e-12);
  const NoiseLaw proportional{.form = NoiseForm::Proportional, .fraction = 0.2};
  EXPECT_NEAR(value_limits(proportional, 2.0, 0.3, kReach)[1] - 2.0, kReach * 0.5, 1e-9);
  const NoiseLaw poisson{.form = NoiseForm::Poisson, .constant = 0.08};
  EXPECT_NEAR(value_limits(poisson, 2.0, 0.3, kReach)[1] - 2.0, kReach * 0.5, 1e-9);
}

TEST(ValueLimits, OfLognormalNoiseAreThoseOfTheLogarithm) {
  const NoiseLaw law{.form = NoiseForm::LogNormal, .fraction = 0.4};
  const auto limits = value_limits(law, 2.0, 0.6, kReach);
  EXPECT_NEAR(std::log(limits[1] / 2.0), kReach * 0.5, 1e-12);
  EXPECT_NEAR(std::log(limits[0] / 2.0), -kReach * 0.5, 1e-12);
}

TEST(ValueLimits, OfStudentsNoiseHaveItsQuantile) {
  const NoiseLaw law{.form = NoiseForm::Student, .constant = 0.5, .freedom = 5.0};
  EXPECT_NEAR(value_limits(law, 2.0, 0.0, kReach)[1] - 2.0, 0.5 * student_quantile_95(5.0),
              1e-12);
}

TEST(ValueLimits, WhatIsBeyondALimitIsTheLimit) {
  const NoiseLaw law{.constant = 1.0, .below = 1.5, .above = 2.5};
  const auto limits = value_limits(law, 2.0, 0.0, kReach);
  EXPECT_EQ(limits[0], 1.5);
  EXPECT_EQ(limits[1], 2.5);
}

TEST(ValueLimits, OfTruncatedNoiseHaveFivePercentOfTheRecordedValuesBeyond) {
  const NoiseLaw law{.constant = 0.4, .below = 1.8, .above = 2.6, .truncated = true};
  const auto limits = value_limits(law, 2.0, 0.3, kReach);
  const auto share = [&](double value) {
    const double low = below((1.8 - 2.0) / 0.5), high = below((2.6 - 2.0) / 0.5);
    return (below((value - 2.0) / 0.5) - low) / (high - low);
  };
  EXPECT_NEAR(share(limits[0]), 0.05, 1e-6);
  EXPECT_NEAR(share(limits[1]), 0.95, 1e-6);
  const NoiseLaw logs{
      .form = NoiseForm::LogNormal, .fraction = 0.5, .below = 2.0, .truncated = true};
  const auto of_logs = value_limits(logs, 2.0, 0.0, kReach);
  EXPECT_NEAR(2.0 * (1.0 - below(std::log(of_logs[1] / 2.0) / 0.5)), 0.05, 1e-6);
  EXPECT_GT(of_logs[0], 2.0);
}

}  // namespace
}  // namespace lacuna
