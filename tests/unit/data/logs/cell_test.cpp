// SPDX-License-Identifier: MIT
#include "data/logs/cell.hpp"

#include <gtest/gtest.h>

namespace lacuna {
namespace {

using Kind = Cell::Kind;

TEST(Cell, NumbersAndBlanks) {
  for (const char* text : {"1.5", "-2", "1e-3", " 7 ", "0,5", "\"3\""})
    EXPECT_EQ(read_cell(text).kind, Kind::Number) << text;
  for (const char* text : {"", "nan", "N/A"})
    EXPECT_EQ(read_cell(text).kind, Kind::Missing) << text;
}

TEST(Cell, NumbersWithAUnit) {
  const Cell cell = read_cell("12.3 mV");
  EXPECT_EQ(cell.kind, Kind::Quantity);
  EXPECT_EQ(cell.number, "12.3");
  EXPECT_EQ(cell.unit, "mV");
  EXPECT_EQ(read_cell("0 sec").unit, "s");
  EXPECT_EQ(read_cell("5\u00b0C").unit, "\u00b0C");
  EXPECT_EQ(read_cell("1.5e-3 m/s^2").number, "1.5e-3");
}

TEST(Cell, NumbersBehindALabel) {
  for (const char* text : {"x:1.2", "x = 1.2", "{\"x\": 1.2", "\"x\": 1.2}"}) {
    const Cell cell = read_cell(text);
    EXPECT_EQ(cell.kind, Kind::Quantity) << text;
    EXPECT_EQ(cell.label, "x") << text;
    EXPECT_EQ(cell.number, "1.2") << text;
  }
  EXPECT_EQ(read_cell("T: 20 degC").unit, "degC");
}

TEST(Cell, ClocksAndText) {
  for (const char* text : {"10:00", "2023-12-05", "05/12/23 11:58:00 AM"})
    EXPECT_EQ(read_cell(text).kind, Kind::Clock) << text;
  for (const char* text : {"base_link", "12 parsec", "3rd", "on", "a:b", "0x1F", "t:", "--"})
    EXPECT_EQ(read_cell(text).kind, Kind::Text) << text;
}

}  // namespace
}  // namespace lacuna
