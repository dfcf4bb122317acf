// SPDX-License-Identifier: MIT
#include "data/logs/log_header.hpp"

#include <gtest/gtest.h>

namespace lacuna {
namespace {

LogLayout layout_of(std::size_t columns, std::size_t time_parts = 0) {
  LogLayout layout;
  layout.columns.resize(columns);
  layout.time_parts = time_parts;
  return layout;
}

TEST(LogHeader, ALineOfNamesWithUnits) {
  LogLayout layout = layout_of(2);
  name_log_columns({{"a preamble"}, {"t [ms]", "x (V)"}}, layout);
  EXPECT_EQ(layout.columns[0].name, "t");
  EXPECT_EQ(layout.columns[0].unit, "ms");
  EXPECT_EQ(layout.columns[1].unit, "V");
}

TEST(LogHeader, ALineOfUnitsBelowTheNames) {
  LogLayout layout = layout_of(3);
  name_log_columns({{"Zeit", "Winkel", "Druck"}, {"s", "deg", "mbar"}}, layout);
  EXPECT_EQ(layout.columns[1].name, "Winkel");
  EXPECT_EQ(layout.columns[1].unit, "deg");
  EXPECT_EQ(layout.columns[2].unit, "mbar");
}

TEST(LogHeader, TwoLinesOfNames) {
  const std::vector<std::vector<std::string>> before{{"Time", "A", "A", "B"},
                                                     {"", "temp", "hum", "temp"}};
  LogLayout layout = layout_of(4);
  name_log_columns(before, layout);
  EXPECT_EQ(layout.columns[0].name, "Time");
  EXPECT_EQ(layout.columns[1].name, "A temp");
  EXPECT_EQ(layout.columns[3].name, "B temp");
  EXPECT_TRUE(has_combined_names(before, layout));
  EXPECT_FALSE(has_combined_names({{"u", "v"}, {"a", "b"}}, layout_of(2)));
}

TEST(LogHeader, ADateAndATimeMayHaveOneName) {
  LogLayout layout = layout_of(3, 2);
  name_log_columns({{"when", "x"}}, layout);
  EXPECT_EQ(layout.columns[2].name, "x");
  LogLayout plain = layout_of(3);
  name_log_columns({{"when", "x"}}, plain);
  EXPECT_EQ(plain.columns[2].name, "") << "a name is missing, nobody knows which";
}

TEST(LogHeader, PropertiesOfChannels) {
  LogLayout layout = layout_of(4);
  name_log_columns({{"Name", "x", "Name", "y"},
                    {"SampleTime[ms]", "10", "SampleTime[ms]", "10"},
                    {"Offset", "0", "Offset", "0"}},
                   layout);
  EXPECT_EQ(layout.columns[0].name, "Time");
  EXPECT_EQ(layout.columns[0].unit, "ms");
  EXPECT_EQ(layout.columns[1].name, "x");
  EXPECT_EQ(layout.columns[3].name, "y");
}

}  // namespace
}  // namespace lacuna
