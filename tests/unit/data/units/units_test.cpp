// SPDX-License-Identifier: MIT
#include "data/units/units.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "data/units/in_units.hpp"
#include "support/one_record.hpp"

namespace lacuna {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// What 1 (and `value`) of a unit is in another one.
void expect_converted(double value, const char* from, double expected, const char* to) {
  const auto found = conversion(from, to);
  ASSERT_TRUE(found) << from << " to " << to;
  EXPECT_NEAR(found->factor * value + found->offset, expected, 1e-9 * std::abs(expected))
      << from << " to " << to;
}

/// Values by the definitions of the units (SI brochure; NIST SP 811), worked out by hand.
TEST(Units, OneBecomesAnother) {
  expect_converted(180.0, "deg", 3.14159265358979, "rad");
  expect_converted(60.0, "rpm", 6.28318530717959, "rad/s");
  expect_converted(60.0, "U/min", 1.0, "rev/s");
  expect_converted(250.0, "mV", 0.25, "V");
  expect_converted(3.0, "\u00b5V", 3e-6, "V");
  expect_converted(3.0, "uV", 3e-9, "kV");
  expect_converted(1013.25, "mbar", 1.01325, "bar");
  expect_converted(1.0, "bar", 100.0, "kPa");
  expect_converted(90.0, "min", 1.5, "h");
  expect_converted(50.0, "%", 0.5, "1");
  expect_converted(25.0, "cm", 250.0, "mm");
  expect_converted(500.0, "g", 0.5, "kg");
  expect_converted(6.0, "l/min", 1e-4, "m^3/s");
  expect_converted(36.0, "km/h", 10.0, "m/s");
  expect_converted(90.0, "deg/s^2", 1.5707963267949, "rad/s^2");
  expect_converted(1.0, "mNm", 1e-3, "N m");
  expect_converted(1.0, "mg/L", 1e-3, "kg/m3");
  expect_converted(1.0, "mmol/l", 1.0, "mM");
  expect_converted(1.0, "1/min", 1.0 / 60.0, "Hz");
  expect_converted(2.0, "m s^-2", 200.0, "cm*s-2");
  expect_converted(2.0, "m/s\u00b2", 2.0, "m/s2");
  expect_converted(1.0, "W/degC", 1.0, "W/K");
}

TEST(Units, TemperaturesHaveAnOffset) {
  expect_converted(25.0, "degC", 298.15, "K");
  expect_converted(0.0, "K", -273.15, "\u00b0C");
  expect_converted(212.0, "degF", 100.0, "degC");
}

TEST(Units, WhatIsTheSameChangesNothing) {
  EXPECT_TRUE(conversion("Ohm", "\u03a9")->changes_nothing());
  EXPECT_TRUE(conversion("Nm", "N m")->changes_nothing());
  EXPECT_TRUE(conversion("N m", "J")->changes_nothing());
  EXPECT_TRUE(conversion("Inkr", "Inkr")->changes_nothing());
  EXPECT_EQ(conversion("mV", "V")->factor, 1e-3) << "no digit is off";
  EXPECT_EQ(conversion("kHz", "Hz")->factor, 1e3);
}

TEST(Units, DifferentThingsDoNotConvert) {
  EXPECT_FALSE(conversion("V", "A"));
  EXPECT_FALSE(conversion("Hz", "rad/s")) << "a frequency may be meant, or a rate of turning";
  EXPECT_FALSE(conversion("Inkr", "rad"));
  EXPECT_FALSE(conversion("rad", "1"));
  EXPECT_FALSE(conversion("", "V"));
  EXPECT_FALSE(conversion("", ""));
}

TEST(Units, OtherTextIsNone) {
  for (const char* text : {"", "Inkr", "C", "J/kg K", "m^", "m^99", "/s", "mmin", "kdeg", "x",
                           "m//s", "LSB", "m/s/", "counts", "5"})
    EXPECT_FALSE(read_unit(text)) << text;
}

TEST(Units, SymbolsGoBeforePrefixes) {
  EXPECT_EQ(read_unit("min")->factor, 60.0);
  EXPECT_EQ(read_unit("Pa")->factor, 1.0);
  EXPECT_EQ(read_unit("d")->factor, 86400.0);
  EXPECT_EQ(read_unit("mm")->factor, 1e-3);
  EXPECT_EQ(read_unit("kg")->factor, 1.0);
}

TEST(Units, AConversionIsDescribed) {
  EXPECT_EQ(describe({1e-3, 0.0}), "factor 0.001");
  EXPECT_EQ(describe({1.0, 273.15}), "factor 1, offset 273.15");
}

/// Two samples of th [deg], T [degC] and an input u [mV].
Dataset records() {
  Trajectory record;
  record.source = "run.csv";
  record.time = Eigen::Vector2d(0.0, 1.0);
  record.states = (Matrix(2, 2) << 180.0, 20.0, 90.0, 30.0).finished();
  record.inputs = Eigen::Vector2d(1500.0, -500.0);
  record.derivatives = (Matrix(2, 2) << 18.0, 1.0, 9.0, 2.0).finished();
  return support::one_record({{"th", "deg"}, {"T", "degC"}}, {{"u", "mV"}}, record);
}

TEST(InUnits, ValuesAndRatesAreConverted) {
  const Dataset data = in_units_of({{"th", "rad"}, {"T", "K"}, {"u", "V"}}, records());
  const Trajectory& record = data.trajectories[0];
  EXPECT_NEAR(record.states(0, 0), 3.14159265358979, 1e-13);
  EXPECT_NEAR(record.states(1, 1), 303.15, 1e-12);
  EXPECT_NEAR(record.derivatives(0, 0), 0.314159265358979, 1e-14);
  EXPECT_EQ(record.derivatives(1, 1), 2.0) << "a rate has no offset";
  EXPECT_EQ(record.inputs(0, 0), 1.5);
  EXPECT_EQ(data.states[0].unit, "rad");
  EXPECT_EQ(data.inputs[0].unit, "V");
  ASSERT_EQ(data.notes.size(), 3u);
  EXPECT_EQ(data.notes[2], "run.csv: u is taken from mV to V (factor 0.001)");
}

TEST(InUnits, NothingIsSaidWithoutUnits) {
  Dataset data = records();
  data.states[1].unit = "";
  const Dataset same = in_units_of({{"th", ""}, {"T", "K"}, {"x", "m"}, {"u", "mV"}}, data);
  EXPECT_TRUE(same.notes.empty());
  EXPECT_EQ(same.trajectories[0].states, data.trajectories[0].states);
  EXPECT_EQ(same.states[1].unit, "");
}

}  // namespace
}  // namespace lacuna
