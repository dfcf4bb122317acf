// SPDX-License-Identifier: MIT
#include "data/records/lattice.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace lacuna {
namespace {

/// A slow sine in steps, as text with digits of `digit` has them.
Dataset stepped(double step, double digit, double reach = 15.0) {
  Dataset data;
  data.states = {{"T", ""}};
  Trajectory record;
  record.time = Vector::LinSpaced(400, 0.0, 399.0);
  record.states.resize(400, 1);
  for (Index i = 0; i < 400; ++i) {
    const double value = 21.0 + reach * std::sin(0.02 * static_cast<double>(i));
    record.states(i, 0) = digit * std::round(step * std::round(value / step) / digit);
  }
  data.trajectories = {record};
  return data;
}

TEST(Lattice, OfAConverterIsFoundBehindTheDigitsOfTheText) {
  for (const double step : {0.3223, 0.2417, 0.0977, 1.0 / 7.0})
    EXPECT_NEAR(*lattice_of(stepped(step, 0.01), 0), step, 0.001 * step);
}

TEST(Lattice, OfDigitsAloneIsTheDigit) {
  EXPECT_NEAR(*lattice_of(stepped(0.01, 0.01), 0), 0.01, 1e-9);
  EXPECT_NEAR(*lattice_of(stepped(0.25, 1e-4), 0), 0.25, 1e-9);
}

TEST(Lattice, IsFoundBehindFewSignificantDigits) {
  // An encoder of 4096 steps a turn, printed with five digits.
  Dataset data = stepped(2.0 * std::acos(-1.0) / 4096.0, 1e-12, 1.3);
  for (Trajectory& record : data.trajectories) {
    record.states.array() -= 21.0;
    for (double& value : record.states.reshaped()) {
      std::array<char, 32> text{};
      std::snprintf(text.data(), text.size(), "%.5g", value);
      value = std::strtod(text.data(), nullptr);
    }
  }
  EXPECT_NEAR(*lattice_of(data, 0), 2.0 * std::acos(-1.0) / 4096.0, 1e-6);
}

TEST(Lattice, IsNoneOfFewLevels) {
  EXPECT_FALSE(lattice_of(stepped(5.0, 0.01), 0));
}

/// Values that are spread without a step have the digits of their text and no other.
TEST(Lattice, OfSparseValuesIsTheDigit) {
  Dataset data = stepped(0.01, 0.01);
  Matrix& states = data.trajectories[0].states;
  for (Index i = 0; i < states.rows(); ++i)
    states(i, 0) = 0.01 * std::round(100.0 * std::fmod(7.123 * static_cast<double>(i), 97.0));
  EXPECT_NEAR(*lattice_of(data, 0), 0.01, 1e-9);
}

/// The smallest gap is twice the spacing, and so are hundreds of others.
TEST(Lattice, OfManyLevelsIsThatOfTheirLargeGapsToo) {
  Dataset data = stepped(0.01, 0.01);
  Matrix& states = data.trajectories[0].states;
  double level = 0.0;
  for (Index i = 0; i < states.rows(); ++i) {
    states(i, 0) = 0.01 * level;
    level += i % 4 == 3 ? 3.0 : 2.0;
  }
  ASSERT_EQ(states.rows(), 400);
  EXPECT_NEAR(*lattice_of(data, 0), 0.01, 1e-9);
}

}  // namespace
}  // namespace lacuna
