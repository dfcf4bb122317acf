// SPDX-License-Identifier: MIT
#include "data/records/columns/derivative_agreement.hpp"

#include <gtest/gtest.h>

#include "lacuna/core/base/error.hpp"
#include "unit/data/records/columns/rate_columns.hpp"

namespace lacuna {
namespace {

using testing::lotka_volterra;
using testing::named_columns;
using testing::states_and_rates;

const std::vector<std::string> kNames{"x", "y", "dx", "dy"};

Trajectory cycle(Index n = 1000) {
  return states_and_rates(lotka_volterra, Vector{{0.4, 0.7}}, n,
                          20.0 / static_cast<double>(n));
}

Dataset columns_of(Trajectory record, double noise = 0.0) {
  return named_columns({std::move(record)}, {0, 1, 2, 3}, kNames, noise);
}

/// The derivative of x by another rule.
Dataset by_differences(Index before, Index after) {
  Trajectory record = cycle();
  const Vector x = record.states.col(0);
  for (Index i = 1; i + 1 < record.samples(); ++i)
    record.states(i, 2) = (x[i + after] - x[i - before]) /
                          (record.time[i + after] - record.time[i - before]);
  return columns_of(std::move(record));
}

bool agrees(const Dataset& data, Index derivative, Index of) {
  return is_derivative(data, analyse_noise(data), derivative, of);
}

TEST(IsDerivative, HoldsForDifferencesOfNeighbours) {
  EXPECT_TRUE(agrees(by_differences(0, 1), 2, 0));
  EXPECT_TRUE(agrees(by_differences(1, 0), 2, 0));
  EXPECT_TRUE(agrees(by_differences(1, 1), 2, 0));
}

TEST(IsDerivative, HoldsForAStraightLineAndUnevenTimes) {
  Trajectory record = cycle();
  record.states.col(2).setConstant(3.0);
  for (Index i = 0; i < record.samples(); ++i) record.time[i] += i % 2 == 0 ? 0.0 : 0.008;
  record.states.col(1) = record.time.array().sin();
  record.states.col(3) = record.time.array().cos();
  record.states.col(0) = 3.0 * record.time;
  const Dataset data = columns_of(std::move(record));
  EXPECT_TRUE(agrees(data, 2, 0));
  EXPECT_TRUE(agrees(data, 3, 1));
}

TEST(IsDerivative, FailsForOneOfAnotherSize) {
  for (const double factor : {-1.0, 0.7, 1.3, 1000.0}) {
    Trajectory record = cycle();
    record.states.col(2) *= factor;
    EXPECT_FALSE(agrees(columns_of(std::move(record), 0.01), 2, 0)) << factor;
  }
}

TEST(IsDerivative, FailsWherePartOfTheRecordIsAnother) {
  Trajectory record = cycle();
  record.states.col(2).segment(400, 200).reverseInPlace();
  EXPECT_FALSE(agrees(columns_of(std::move(record)), 2, 0));
}

TEST(IsDerivative, FailsWhereARippleStandsOnIt) {
  Trajectory record = cycle();
  record.states.col(2).array() += 0.5 * (20.0 * record.time.array()).sin();
  EXPECT_FALSE(agrees(columns_of(std::move(record)), 2, 0));
}

TEST(IsDerivative, NeedsEnoughSamplesAndNumbers) {
  EXPECT_FALSE(agrees(columns_of(rows_of(cycle(), 0, 5)), 2, 0));
  Dataset data = columns_of(cycle());
  data.trajectories[0].states(7, 0) = std::nan("");
  const std::vector<StateNoise> noise(4);
  EXPECT_FALSE(is_derivative(data, noise, 2, 0));
  EXPECT_THROW(is_derivative(data, noise, 4, 0), ArgumentError);
  EXPECT_THROW(is_derivative(data, {}, 2, 0), ArgumentError);
}

}  // namespace
}  // namespace lacuna
