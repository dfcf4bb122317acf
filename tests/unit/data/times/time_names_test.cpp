// SPDX-License-Identifier: MIT
#include "data/times/time_names.hpp"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

namespace lacuna {
namespace {

TEST(TimeNames, UnitsHaveManyNames) {
  for (const auto& [text, symbol] :
       std::vector<std::pair<std::string, std::string>>{{"ms", "ms"},
                                                        {"[ms]", "ms"},
                                                        {"(us)", "us"},
                                                        {"\u00b5s", "us"},
                                                        {"Seconds", "s"},
                                                        {"msec", "ms"},
                                                        {"min", "min"},
                                                        {"hours", "h"},
                                                        {" nanos ", "ns"},
                                                        {"Sekunden", "s"},
                                                        {"d", "d"}})
    EXPECT_EQ(time_unit_symbol(text), symbol) << text;
  for (const char* text : {"", "V", "m", "mV", "rpm", "x", "s s", "1/s"})
    EXPECT_FALSE(time_unit_symbol(text)) << text;
}

TEST(TimeNames, ANameThatEndsInAUnitSaysIt) {
  for (const auto& [name, unit] :
       std::vector<std::pair<std::string, std::string>>{{"time_ms", "ms"},
                                                        {"Time in ms", "ms"},
                                                        {"millis", "ms"},
                                                        {"t_us", "us"},
                                                        {"timestamp_ns", "ns"},
                                                        {"timestampNs", "ns"},
                                                        {"Time, ms", "ms"},
                                                        {"t / s", "s"},
                                                        {"elapsed_h", "h"},
                                                        {"time_min", "min"},
                                                        {"Zeit_s", "s"},
                                                        {"t_s", "s"},
                                                        {"Time \u00b5s", "us"},
                                                        {"seconds", "s"},
                                                        {"field.header.stamp.nsec", "ns"},
                                                        {"uptime_d", "d"},
                                                        {"ms", "ms"}}) {
    const auto found = unit_in_name(name);
    ASSERT_TRUE(found) << name;
    EXPECT_EQ(found->unit, unit) << name;
    EXPECT_TRUE(found->is_certain) << name;
  }
}

TEST(TimeNames, WordsWithOtherMeaningsAreNotCertain) {
  for (const char* name : {"t_min", "x_h", "h", "min", "t_d", "d", "time_m"}) {
    const auto found = unit_in_name(name);
    ASSERT_TRUE(found) << name;
    EXPECT_FALSE(found->is_certain) << name;
  }
}

TEST(TimeNames, OtherNamesSayNothing) {
  for (const char* name : {"", "t", "time", "Time", "timestamp", "x", "volts", "rms", "items",
                           "forms", "th", "_", "time_mm", "params"})
    EXPECT_FALSE(unit_in_name(name)) << name;
}

}  // namespace
}  // namespace lacuna
