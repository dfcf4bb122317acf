// SPDX-License-Identifier: MIT
#include "trajectories/fit/delay_fit.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/model/files/ode_text.hpp"
#include "lacuna/trajectories/fit/fit.hpp"

namespace lacuna {
namespace {

constexpr double kLate = 2.5, kTau = 8.0, kGain = 1.5, kNoise = 0.02;

/// tau dx/dt = k u(t - d) - x with u held at levels, solved exactly from jump to jump.
/// @param memory of the noise from sample to sample.
Dataset late_record(std::uint64_t seed, double memory = 0.0) {
  constexpr Index kSamples = 400, kLength = 20;
  Random random(seed);
  Trajectory record;
  record.time = Vector::LinSpaced(kSamples, 0.0, kSamples - 1.0);
  record.states.resize(kSamples, 1);
  record.inputs.resize(kSamples, 1);
  for (Index i = 0; i < kSamples; ++i)
    record.inputs(i, 0) = i % kLength == 0 && i > 0 ? random.normal()
                          : i == 0                  ? 0.0
                                                    : record.inputs(i - 1, 0);
  double x = 0.0, noise = 0.0;
  const auto rest = [&](double level, double time) {
    x = level + (x - level) * std::exp(-time / kTau);
  };
  for (Index i = 0; i < kSamples; ++i) {
    noise = memory * noise + kNoise * std::sqrt(1.0 - memory * memory) * random.normal();
    record.states(i, 0) = x + noise;
    // Half a sample of what acted three samples ago, then half of what acted two ago.
    rest(kGain * record.inputs(std::max<Index>(i - 3, 0), 0), 0.5);
    rest(kGain * record.inputs(std::max<Index>(i - 2, 0), 0), 0.5);
  }
  Dataset data;
  data.states = {{"x", ""}};
  data.inputs = {{"u", "", Hold::Zero}};
  data.trajectories = {record};
  return data;
}

SystemModel late_system(const std::string& delay) {
  return parse_ode_system("input u hold zero\nparam tau = 5\nparam k = 1\nparam d = " + delay +
                              "\ndx/dt = (k*delay(u,d) - x)/tau\n",
                          "made");
}

const FittedParameter& late_number(const Fit& found, const std::string& name) {
  for (const FittedParameter& one : found.numbers)
    if (one.name == name) return one;
  throw std::out_of_range(name);
}

TEST(DelayFit, FindsADelayAndItsErrorWithTheOthers) {
  double delays = 0.0, squares = 0.0, errors = 0.0, taus = 0.0, tau_errors = 0.0;
  constexpr int kDraws = 6;
  for (int draw = 0; draw < kDraws; ++draw) {
    const Fit found = fit(late_system("6 in 0..20"), late_record(10 + draw), {});
    const FittedParameter &d = late_number(found, "d"), &tau = late_number(found, "tau");
    ASSERT_TRUE(d.standard_error && d.ci95 && tau.standard_error);
    EXPECT_NEAR(d.value, kLate, 4.0 * *d.standard_error);
    EXPECT_NEAR(tau.value, kTau, 4.0 * *tau.standard_error);
    EXPECT_NEAR(late_number(found, "k").value, kGain, 0.02);
    delays += (d.value - kLate) / kDraws;
    squares += std::pow((d.value - kLate) / *d.standard_error, 2);
    taus += std::pow((tau.value - kTau) / *tau.standard_error, 2);
    errors += *d.standard_error / kDraws;
    tau_errors += *tau.standard_error / kDraws;
    EXPECT_EQ(found.numbers.size(), 3u);
    EXPECT_EQ(found.numbers[2].name, "d") << "in the order of the model";
    EXPECT_DOUBLE_EQ(found.model.parameters()[2].value, d.value);
  }
  // Chi squared of 6 draws: 99.9 % below 22.5.
  EXPECT_LT(squares, 22.5);
  EXPECT_LT(taus, 22.5);
  EXPECT_LT(std::abs(delays), 0.05);
  // A delay that is known leaves less open: the errors of the others are smaller then.
  const Fit known = fit(late_system("2.5 fixed"), late_record(10), {});
  EXPECT_LT(*late_number(known, "tau").standard_error, tau_errors);
  EXPECT_GT(errors, 0.0);
}

TEST(DelayFit, NoiseWithMemoryMakesADelayAsUncertainAsItIs) {
  double squares = 0.0, errors = 0.0;
  constexpr int kDraws = 8;
  for (int draw = 0; draw < kDraws; ++draw) {
    const Fit found = fit(late_system("2.2 in 0..6"), late_record(60 + draw, 0.9), {});
    const FittedParameter& d = late_number(found, "d");
    ASSERT_TRUE(d.standard_error && d.ci95);
    squares += std::pow((d.value - kLate) / *d.standard_error, 2);
    errors += *d.standard_error / kDraws;
    const FittedParameter& tau = late_number(found, "tau");
    EXPECT_NEAR(tau.value, kTau, 4.0 * *tau.standard_error);
  }
  // Chi squared of 8 draws: 99.9 % between 0.7 and 26.1.
  EXPECT_LT(squares, 26.1);
  EXPECT_GT(squares, 0.7);
  // Least squares with the true correlation, J^+ R J^+T of the exact solution, have 0.028 on the
  // average of such inputs; as if values were independent it is 0.0136.
  EXPECT_GT(errors, 0.021);
  EXPECT_LT(errors, 0.036);
}

TEST(DelayFit, IsOneOfTheUnknowns) {
  const Fit found = fit(late_system("2.2 in 0..6"), late_record(80), {});
  EXPECT_EQ(found.degrees_of_freedom, 400.0 - 4.0) << "tau, k, d and the initial state";
}

/// A prior that is far narrower than what the record shows draws the estimate to its mean, of
/// the delay and of a parameter beside it, wherever fits before it ended.
TEST(DelayFit, WhatIsKnownBeforeStaysWhatItWas) {
  const Fit found = fit(late_system("2 +- 0.0001 in 0..20"), late_record(30), {});
  EXPECT_NEAR(late_number(found, "d").value, 2.0, 2e-3);
  const SystemModel narrow = parse_ode_system(
      "input u hold zero\nparam tau = 7 +- 0.0001\nparam k = 1\nparam d = 1 in 0..20\n"
      "dx/dt = (k*delay(u,d) - x)/tau\n",
      "made");
  EXPECT_NEAR(late_number(fit(narrow, late_record(31), {}), "tau").value, 7.0, 2e-3);
}

/// A range whose twelve twelfths are more than it, as doubles are added.
TEST(DelayFit, HoldsItsRange) {
  const Fit found = fit(late_system("0.5 in 0..0.92"), late_record(20), {});
  EXPECT_NEAR(late_number(found, "d").value, 0.92, 2e-3);
  EXPECT_EQ(late_number(found, "d").bound, "max");
}

TEST(DelayFit, OneForEachRecordIsRefused) {
  EXPECT_THROW(fit(late_system("2 per record"), late_record(21), {}), ModelError);
}

TEST(DelayFit, BandsAndPredictionsTakeTheDelayAsItIs) {
  const Fit found = fit(late_system("2 in 0..10"), late_record(22), {}, {.bands = true});
  ASSERT_EQ(found.bands.size(), 1u);
  EXPECT_TRUE(found.bands[0].value.allFinite());
  Dataset conditions = late_record(23);
  EXPECT_TRUE(predict(found, conditions)[0].value.allFinite());
}

}  // namespace
}  // namespace lacuna
