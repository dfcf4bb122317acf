// SPDX-License-Identifier: MIT
#include "records/channels/column_hints.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace lacuna {
namespace {

using ::testing::HasSubstr;

constexpr Index kHintSamples = 200;

/// n samples of states that are functions of the sample's number.
template <class... Functions>
Dataset waves_of(const std::vector<std::string>& names, Functions... functions) {
  Dataset data;
  Trajectory record;
  record.time = Vector::LinSpaced(kHintSamples, 0.0, 10.0);
  record.states.resize(kHintSamples, sizeof...(functions));
  Index column = 0;
  for (const auto& function : {std::function<double(Index)>(functions)...}) {
    for (Index i = 0; i < kHintSamples; ++i) record.states(i, column) = function(i);
    ++column;
  }
  for (const std::string& name : names) data.states.push_back({name, ""});
  data.trajectories = {record};
  return data;
}

double wave_x(Index i) { return 2.0 * std::sin(0.11 * static_cast<double>(i)); }
double wave_y(Index i) { return std::cos(0.23 * static_cast<double>(i)) + 0.3; }
double wave_z(Index i) { return std::sin(0.05 * static_cast<double>(i) + 1.0); }
double in_thousandths(double value) { return std::round(1000.0 * value) / 1000.0; }

void expect_one(const Dataset& data, const std::string& message, const std::string& remedy) {
  const std::vector<Hint> hints = column_hints(data);
  ASSERT_EQ(hints.size(), 1u);
  EXPECT_THAT(hints[0].message, HasSubstr(message));
  EXPECT_THAT(hints[0].remedy, HasSubstr(remedy));
  EXPECT_EQ(hints[0].withheld, Withheld::Nothing);
}

TEST(ColumnHints, ALengthFollowsFromItsComponents) {
  const auto length = [](Index i) { return std::hypot(wave_x(i), wave_y(i), wave_z(i)); };
  expect_one(waves_of({"x", "y", "z", "Absolute"}, wave_x, wave_y, wave_z, length),
             "Absolute follows from x, y, z", "--states x,y,z");
}

TEST(ColumnHints, SumsProductsAndCopies) {
  const auto sum = [](Index i) { return 3.0 * wave_x(i) - wave_y(i) + 2.0; };
  const auto product = [](Index i) { return wave_x(i) * wave_y(i); };
  expect_one(waves_of({"x", "y", "s"}, wave_x, wave_y, sum), "s follows from x, y",
             "--states x,y");
  expect_one(waves_of({"x", "y", "p"}, wave_x, wave_y, product), "p follows from x, y",
             "--states x,y");
  expect_one(waves_of({"x", "y", "c"}, wave_x, wave_y, wave_y), "c follows from y",
             "--states x,y");
}

TEST(ColumnHints, DigitsThatAreWrittenDoNotHideIt) {
  const auto x = [](Index i) { return in_thousandths(wave_x(i)); };
  const auto y = [](Index i) { return in_thousandths(wave_y(i)); };
  const auto sum = [](Index i) { return in_thousandths(wave_x(i) + wave_y(i)); };
  expect_one(waves_of({"x", "y", "s"}, x, y, sum), "s follows from x, y", "--states x,y");
}

TEST(ColumnHints, WhatIsNearlyComputedIsNot) {
  const auto nearly = [](Index i) { return wave_x(i) + 1e-3 * wave_z(i); };
  EXPECT_TRUE(column_hints(waves_of({"x", "y", "z"}, wave_x, wave_y, wave_z)).empty());
  EXPECT_TRUE(column_hints(waves_of({"x", "y"}, wave_x, nearly)).empty());
}

/// Columns without a relation, then the product of the first two.
Dataset wide_record(Index states) {
  Dataset data;
  Trajectory record;
  record.time = Vector::LinSpaced(12, 0.0, 11.0);
  record.states.resize(12, states);
  for (Index k = 0; k < states; ++k) {
    for (Index i = 0; i < 12; ++i)
      record.states(i, k) = std::sin(1.7 * static_cast<double>((k + 3) * (i + 1) * (i + 1)));
    data.states.push_back({"c" + std::to_string(k), ""});
  }
  record.states.rightCols(1) = record.states.col(0).cwiseProduct(record.states.col(1));
  data.trajectories = {record};
  return data;
}

TEST(ColumnHints, OfManyColumnsNoneAreCompared) {
  expect_one(wide_record(64), "c63 follows from c0, c1", "--states c0,c1");
  EXPECT_TRUE(column_hints(wide_record(65)).empty());
  EXPECT_TRUE(column_hints(wide_record(5000)).empty()) << "and this ends";
}

TEST(ColumnHints, AHeldColumnLooksLikeAnInput) {
  const auto held = [](Index i) { return wave_y(i / 5 * 5); };
  const auto coarse = [](Index i) { return std::floor(4.0 * wave_y(i)); };
  expect_one(waves_of({"x", "Spannung"}, wave_x, held), "Spannung is held 5 samples",
             "--inputs Spannung");
  EXPECT_TRUE(column_hints(waves_of({"y"}, held)).empty()) << "the file repeats its samples";
  EXPECT_TRUE(column_hints(waves_of({"x", "s"}, wave_x, coarse)).empty())
      << "a coarse value changes at any sample";
}

/// Pulses whose width is modulated: no number of samples divides all of them.
TEST(ColumnHints, AColumnThatSwitchesLooksLikeAnInput) {
  const auto pulses = [](Index i) { return wave_y(i) > 0.3 ? 12.0 : 0.0; };
  const auto bit = [](Index i) { return static_cast<double>(i * i % 7 % 2); };
  const auto step = [](Index i) { return i < 100 ? 0.0 : 1.0; };
  const auto levels = [](Index i) { return std::round(1.2 * wave_y(i)); };
  expect_one(waves_of({"x", "pwm"}, wave_x, pulses), "pwm switches between two values",
             "--inputs pwm");
  EXPECT_TRUE(column_hints(waves_of({"x", "b"}, wave_x, bit)).empty()) << "a bit of noise";
  EXPECT_TRUE(column_hints(waves_of({"x", "s"}, wave_x, step)).empty()) << "one change";
  EXPECT_TRUE(column_hints(waves_of({"x", "c"}, wave_x, levels)).empty()) << "three values";
}

}  // namespace
}  // namespace lacuna
