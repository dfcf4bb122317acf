// SPDX-License-Identifier: MIT
#include "records/channels/column_hints.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "dynamics/integration/runge_kutta.hpp"
#include "lacuna/dynamics/test_systems/test_systems.hpp"
#include "lacuna/records/channels/hint.hpp"
#include "lacuna/records/channels/map_hint.hpp"
#include "support/maps.hpp"

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

using namespace lacuna::testing;

TEST(MapHint, TellsMaps) {
  const MapNoise noise{.disturbance = 1e-3};
  for (const Dataset& data : {orbit_of_map(henon, Vector{{0.1, 0.1}}, 500),
                              orbit_of_map(henon, Vector{{0.1, 0.1}}, 500, noise),
                              orbit_of_map(logistic, Vector{{0.3}}, 300),
                              orbit_of_map(logistic, Vector{{0.3}}, 300, noise),
                              orbit_of_map(coupled_logistic, Vector{{0.3, 0.6}}, 500),
                              orbit_of_map(tinkerbell, Vector{{-0.1, -0.2}}, 500)}) {
    const auto hint = map_hint(data);
    ASSERT_TRUE(hint) << data.samples() << ", " << data.state_count() << " states";
    EXPECT_EQ(hint->kind, HintKind::DiscreteMap);
    EXPECT_EQ(hint->remedy, "identify --discrete");
    EXPECT_EQ(hint->withheld, Withheld::Nothing);
  }
}

TEST(MapHint, NumbersAreThoseOfTheDefinition) {
  // x[n+1] = 1 - 2 x^2 has x = cos(2^n a): neighbours and those at twice the distance are
  // uncorrelated, and the slope -4 x is negative at half of the samples.
  const Dataset data =
      orbit_of_map([](const Vector& x) { return Vector{{1.0 - 1.9999 * x[0] * x[0]}}; },
                   Vector{{0.3}}, 5000);
  const auto seen = map_evidence(data);
  ASSERT_TRUE(seen);
  EXPECT_NEAR(seen->roughness, 1.0, 0.05);
  EXPECT_LT(seen->remainder, 1e-10);
  EXPECT_NEAR(seen->linear_remainder, 1.0, 0.05);
  EXPECT_NEAR(seen->reversed, 0.5, 0.05);
  EXPECT_NEAR(seen->divergence, std::log(2.0), 4.0 * seen->divergence_error);
}

TEST(MapHint, RoughnessOfASineIsThatOfItsStep) {
  // (1 - cos w) / (1 - cos 2w) with the angle w of a step.
  for (const double w : {0.1, 1.0, 2.0}) {
    const Dataset data = orbit_of_map(
        [w](const Vector& x) {
          return Vector{{std::cos(w) * x[0] - std::sin(w) * x[1],
                         std::sin(w) * x[0] + std::cos(w) * x[1]}};
        },
        Vector{{1.0, 0.0}}, 2000);
    const auto seen = map_evidence(data);
    ASSERT_TRUE(seen);
    EXPECT_NEAR(seen->roughness, (1.0 - std::cos(w)) / (1.0 - std::cos(2.0 * w)), 1e-3);
    EXPECT_FALSE(map_hint(data)) << w;
  }
}

TEST(MapHint, DoesNotTakeSamplesFarApartOfAFlowForAMap) {
  ASSERT_FALSE(test_systems().empty());
  for (const TestSystem& system : test_systems()) {
    for (const double step : {1.0, 10.0, 30.0, 100.0}) {
      const Dataset clean =
          record_of(system.model, Dopri87{}, system.start, step * system.step, 300);
      for (const double noise : {0.0, 1e-3, 0.05}) {
        Dataset data = add_relative_noise(clean, noise, 1);
        for (Trajectory& record : data.trajectories) record.derivatives.resize(0, 0);
        EXPECT_FALSE(map_hint(data)) << system.name << " " << step << " " << noise;
      }
    }
  }
}

TEST(MapHint, SaysNothingOfNoiseOfLinearMapsAndOfTooFewSamples) {
  const auto nothing = [](const Vector& x) { return Vector(Vector::Zero(x.size())); };
  EXPECT_FALSE(map_hint(orbit_of_map(nothing, Vector{{0.0}}, 500, {.disturbance = 1.0})));
  const auto turned = [](const Vector& x) { return Vector{{-0.999 * x[0]}}; };
  EXPECT_FALSE(map_hint(orbit_of_map(turned, Vector{{1.0}}, 500)));
  EXPECT_FALSE(map_hint(orbit_of_map(logistic, Vector{{0.3}}, 10)));
  EXPECT_FALSE(map_hint(orbit_of_map(nothing, Vector{{0.0}}, 500)));  // constant
  EXPECT_FALSE(map_hint(Dataset{}));
}

TEST(MapHint, SaysNothingWhereDerivativesAreGiven) {
  Dataset data = orbit_of_map(logistic, Vector{{0.3}}, 300);
  data.trajectories[0].derivatives = data.trajectories[0].states;
  EXPECT_FALSE(map_evidence(data));
}

TEST(Hint, TheMostThatOneWithholdsIsWhatAllDo) {
  EXPECT_EQ(withheld_by({}), Withheld::Nothing);
  EXPECT_EQ(withheld_by({{HintKind::Sampling, "m", "r"},
                         {HintKind::Sign, "m", "r", Withheld::Names},
                         {HintKind::Excitation, "m", "r", Withheld::Claims}}),
            Withheld::Claims);
}

}  // namespace
}  // namespace lacuna
