// SPDX-License-Identifier: MIT
#include "trajectories/fit/delay_fit.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.hpp"
#include "dynamics/integration/runge_kutta.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/dynamics/integration/simulate.hpp"
#include "lacuna/model/files/model_file.hpp"
#include "lacuna/trajectories/fit/fit.hpp"
#include "support/one_record.hpp"
#include "trajectories/fit/starts/fit_windows.hpp"

namespace lacuna {
namespace {

using ::testing::Contains;
using ::testing::EndsWith;
using ::testing::HasSubstr;

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
  return support::one_record({{"x", ""}}, {{"u", "", Hold::Zero}}, record);
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

// Records over which errors grow too much for any free run, with all states measured.
constexpr const char* kChaos = "dx/dt = a*y*z\ndy/dt = x - b*y\ndz/dt = c - x*y\n";

/// Sprott's case B (Phys. Rev. E 50:R647, 1994) for 200 units of time: errors grow by e^42.
Dataset chaotic_record(double noise, std::uint64_t seed, Index samples = 2000) {
  constexpr Index kParts = 10;
  const SystemModel truth = parse_ode_system(
      std::string("param a = 1.1\nparam b = 0.9\nparam c = 1.2\n") + kChaos, "truth.ode");
  const Vector fine = sample_times(0.0, 0.1 / kParts, samples * kParts);
  const Solution orbit = simulate(truth.model(), Rk4{}, Vector{{0.5, 0.8, -0.3}}, fine);
  Random random(seed);
  Trajectory record;
  record.source = "made";
  record.time = sample_times(0.0, 0.1, samples);
  record.states.resize(samples, 3);
  for (Index k = 0; k < 3; ++k) {
    for (Index n = 0; n < samples; ++n) record.states(n, k) = orbit.states(n * kParts, k);
    const Vector x = record.states.col(k);
    const double deviation = noise * std::sqrt((x.array() - x.mean()).square().mean());
    for (double& value : record.states.col(k)) value += deviation * random.normal();
  }
  Dataset data;
  data.states = {{"x", ""}, {"y", ""}, {"z", ""}};
  data.trajectories = {record};
  return data;
}

SystemModel chaos_from(const std::string& before) {
  return parse_ode_system(before + kChaos, "m.ode");
}

TEST(FitInWindows, NumbersOfALongChaoticRecord) {
  for (const double noise : {0.02, 0.06}) {
    const Fit found = fit(chaos_from("param a = 1.4\nparam b = 0.65\nparam c = 1.55\n"),
                          chaotic_record(noise, 3), {});
    const double truth[] = {1.1, 0.9, 1.2};
    ASSERT_EQ(found.numbers.size(), 3u);
    for (std::size_t i = 0; i < 3; ++i) {
      const FittedParameter& one = found.numbers[i];
      ASSERT_TRUE(one.standard_error && one.ci95) << one.name;
      EXPECT_LT(std::abs(one.value - truth[i]), 4.0 * *one.standard_error) << one.name;
      EXPECT_LT(*one.standard_error, 0.02 * truth[i]) << one.name;
    }
    EXPECT_EQ(found.numbers[1].start, 0.65) << "as given";
    EXPECT_GT(found.records.size(), 3u);
    EXPECT_THAT(found.records, Contains(EndsWith("made, piece 2")));
    EXPECT_EQ(found.initial.size(), found.records.size());
    EXPECT_THAT(found.notes, Contains(HasSubstr("pieces were fitted")));
    EXPECT_TRUE(standing_of(found).open.empty());
  }
}

TEST(FitInWindows, ARecordThatAFreeRunMeetsStaysWhole) {
  const Fit found = fit(chaos_from("param a = 1.4\nparam b = 0.65\nparam c = 1.55\n"),
                        chaotic_record(0.02, 4, 200), {});
  EXPECT_THAT(found.records, ::testing::ElementsAre("made"));
  EXPECT_NEAR(found.numbers[0].value, 1.1, 4.0 * *found.numbers[0].standard_error);
}

TEST(FitInWindows, AModelThatLacksSomethingIsNotCut) {
  const Fit found = fit(
      parse_ode_system("param a = 1\ndx/dt = a*y*z\ndy/dt = x - y\ndz/dt = 1 + 0*x\n", "m.ode"),
      chaotic_record(0.02, 5, 600), {}, {.effort = Thoroughness::Quick});
  EXPECT_EQ(found.records.size(), 1u);
}

TEST(FitInWindows, RecordsAreCutWhereWindowsBegin) {
  Dataset data = chaotic_record(0.0, 1, 10);
  data.trajectories.push_back(data.trajectories[0]);
  const Dataset cut = cut_at(data, {0, 4, 10, 13, 17});
  std::vector<Index> samples;
  for (const Trajectory& record : cut.trajectories) samples.push_back(record.samples());
  EXPECT_THAT(samples, ::testing::ElementsAre(4, 6, 3, 4, 3));
  EXPECT_EQ(cut.trajectories[1].time[0], data.trajectories[0].time[4]);
  EXPECT_EQ(cut.trajectories[4].source, "made, piece 3");
}

}  // namespace
}  // namespace lacuna
