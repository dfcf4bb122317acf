// SPDX-License-Identifier: MIT
// What is known of parameters and starts before a record is seen.
#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/dynamics/integration/simulate.hpp"
#include "lacuna/model/files/ode_text.hpp"
#include "lacuna/trajectories/fit/fit.hpp"

namespace lacuna {
namespace {

/// x = rate * t, measured with noise.
Dataset line_record(double rate, double first, std::uint64_t seed) {
  constexpr Index kSamples = 200;
  Random random(seed);
  Dataset data{"s", {{"x", ""}}, {}, {}, {}};
  Trajectory record{"line", sample_times(first, 0.01, kSamples), Matrix(kSamples, 1),
                    Matrix(kSamples, 0), Matrix()};
  for (Index i = 0; i < kSamples; ++i)
    record.states(i, 0) = rate * record.time[i] + 0.1 * random.normal();
  data.trajectories = {record};
  return data;
}

// The posterior of a linear model with normal noise is known: precisions add up, means are
// weighted by them.
TEST(KnownBefore, WhatIsKnownOfAParameterBeforeWeighsAsItsPrecision) {
  const Dataset data = line_record(2.0, 0.0, 3);
  const Trajectory& line = data.trajectories[0];
  for (const double deviation : {0.003, 0.01, 100.0}) {
    const std::string text = "param a = 1.998 +- " + std::to_string(deviation) +
                             "\ndx/dt = a\ninitial x = 0 at 0 fixed\n";
    const Fit found = fit(parse_ode_system(text, "m.ode"), data, {});
    const double sigma = found.quality[0].rmse;
    const double information = line.time.squaredNorm() / (sigma * sigma);
    const double prior = 1.0 / (deviation * deviation);
    const double mean = (line.time.dot(line.states.col(0)) / (sigma * sigma) + 1.998 * prior) /
                        (information + prior);
    const FittedParameter& a = found.numbers.at(0);
    EXPECT_NEAR(a.value, mean, 1e-4) << deviation;
    ASSERT_TRUE(a.standard_error) << deviation;
    EXPECT_NEAR(*a.standard_error, 1.0 / std::sqrt(information + prior),
                0.05 * *a.standard_error)
        << deviation;
    ASSERT_EQ(found.model.parameters().size(), 1u);
    EXPECT_FALSE(found.model.parameters()[0].deviation) << "part of the estimate now";
  }
}

// Correlated residuals say how far a parameter may be off by the record; where the prior says
// far more than that, its deviation is the error.
TEST(KnownBefore, APriorIsPartOfTheErrorWhereResidualsAreCorrelated) {
  Dataset data = line_record(2.0, 0.0, 3);
  Trajectory& line = data.trajectories[0];
  line.states.col(0).array() += 0.3 * (8.0 * line.time.array()).sin();
  const Fit found = fit(parse_ode_system("param a = 2 +- 0.0003\ndx/dt = a\n"
                                         "initial x = 0 at 0 fixed\n",
                                         "m.ode"),
                        data, {});
  EXPECT_FALSE(found.quality[0].white);
  ASSERT_TRUE(found.numbers.at(0).standard_error);
  EXPECT_NEAR(*found.numbers.at(0).standard_error, 0.0003, 0.00005);
}

// The product of a lognormal and a normal density has its maximum where the sum of both scores
// is 0.
TEST(KnownBefore, AFactorIsANormalPriorOfTheLogarithm) {
  const Dataset data = line_record(2.0, 0.0, 3);
  const Trajectory& line = data.trajectories[0];
  const double log_factor = std::log(1.002);
  const Fit found = fit(parse_ode_system("param a = 1.99 */ 1.002\ndx/dt = a\n"
                                         "initial x = 0 at 0 fixed\n",
                                         "m.ode"),
                        data, {});
  const double sigma = found.quality[0].rmse;
  const auto score = [&](double a) {
    return line.time.dot(line.states.col(0) - a * line.time) / (sigma * sigma) -
           std::log(a / 1.99) / (log_factor * log_factor * a);
  };
  double low = 1.9, high = 2.1;
  while (high - low > 1e-9) (score(0.5 * (low + high)) > 0.0 ? low : high) = 0.5 * (low + high);
  EXPECT_NEAR(found.numbers.at(0).value, low, 1e-4);
  const double information =
      line.time.squaredNorm() / (sigma * sigma) + 1.0 / std::pow(log_factor * low, 2);
  ASSERT_TRUE(found.numbers[0].standard_error);
  EXPECT_NEAR(*found.numbers[0].standard_error, 1.0 / std::sqrt(information),
              0.05 / std::sqrt(information));
  EXPECT_FALSE(found.model.parameters().at(0).factor) << "part of the estimate now";
}

TEST(KnownBefore, APriorHoldsTheParameterOfEachRecord) {
  Dataset data = line_record(2.0, 0.0, 3);
  data.trajectories.push_back(line_record(3.0, 0.0, 4).trajectories[0]);
  const Fit found = fit(
      parse_ode_system("param a = 2.5 +- 0.001 per_record\ndx/dt = a\ninitial x = 0 fixed\n",
                       "m.ode"),
      data, {});
  ASSERT_EQ(found.numbers.at(0).per_record.size(), 2u);
  EXPECT_NEAR(found.numbers.at(0).per_record[0], 2.5, 0.05);
  EXPECT_NEAR(found.numbers.at(0).per_record[1], 2.5, 0.05);
}

TEST(KnownBefore, TheStartOfTheModelMayLieBeforeTheFirstSample) {
  const Dataset data = line_record(2.0, 0.5, 3);
  const SystemModel system =
      parse_ode_system("param a = 1\ndx/dt = a\ninitial x = 0 at 0 fixed\n", "m.ode");
  const Fit found = fit(system, data, {});
  EXPECT_NEAR(found.numbers.at(0).value, 2.0, 4.0 * *found.numbers.at(0).standard_error);
  EXPECT_TRUE(found.quality[0].white);
  const Fit given_later = fit(system, data, {}, {.start_time = 0.5});
  EXPECT_GT(given_later.numbers.at(0).value, 2.1) << "0 at the first sample, where x is 1";
  EXPECT_THROW(fit(system, data, {}, {.start_time = 0.6}), DataError) << "behind a sample";
}

}  // namespace
}  // namespace lacuna
