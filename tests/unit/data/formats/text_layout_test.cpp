// SPDX-License-Identifier: MIT
#include "data/formats/text_layout.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "lacuna/core/base/error.hpp"
#include "support/expect_error.hpp"

namespace lacuna {
namespace {

using ::testing::ElementsAre;
using testing::expect_error;
using ::testing::HasSubstr;

std::vector<std::string> names_of(const TextLayout& layout) {
  std::vector<std::string> names;
  for (const Quantity& header : layout.headers) names.push_back(header.name);
  return names;
}

std::vector<std::string> units_of(const TextLayout& layout) {
  std::vector<std::string> units;
  for (const Quantity& header : layout.headers) units.push_back(header.unit);
  return units;
}

TEST(TextLayout, FindsEveryDelimiter) {
  EXPECT_EQ(find_layout("t,x\n0,1\n", "a").delimiter, ',');
  EXPECT_EQ(find_layout("t;x\n0;1\n", "a").delimiter, ';');
  EXPECT_EQ(find_layout("t\tx\n0\t1\n", "a").delimiter, '\t');
  EXPECT_EQ(find_layout("t   x\n0   1\n", "a").delimiter, ' ');
  EXPECT_EQ(find_layout("0,5;1,5\n", "a").delimiter, ';');
  EXPECT_EQ(find_layout("0, 1\n", "a").delimiter, ',');
}

TEST(TextLayout, TakesNamesAndUnitsFromTheHeader) {
  const TextLayout layout = find_layout("# made by hand\nt [s], x (V) ,w\n\n0,1,2\n", "a");
  EXPECT_THAT(names_of(layout), ElementsAre("t", "x", "w"));
  EXPECT_THAT(units_of(layout), ElementsAre("s", "V", ""));
  EXPECT_EQ(layout.header_line, 2u);
  EXPECT_EQ(layout.data_line, 4u);
  EXPECT_FALSE(layout.note);
}

TEST(TextLayout, ALineBelowTheNamesThatHasAUnitOfTimeIsOneOfUnits) {
  const TextLayout layout = find_layout("Time,Speed,Volt\nms,rpm,V\n0,0.5,5\n", "a");
  EXPECT_THAT(names_of(layout), ElementsAre("Time", "Speed", "Volt"));
  EXPECT_THAT(units_of(layout), ElementsAre("ms", "rpm", "V"));
  EXPECT_EQ(layout.header_line, 1u);
  EXPECT_FALSE(layout.note);
  EXPECT_THAT(units_of(find_layout("x;t\nm/s^2;us\n1;2\n", "a")), ElementsAre("m/s^2", "us"));
  EXPECT_THAT(units_of(find_layout("Zeit;T;n\n[min];[\u00b0C];-\n1;2;3\n", "a")),
              ElementsAre("min", "\u00b0C", ""));
  EXPECT_THAT(units_of(find_layout("stamp\tx\nsec\tmV\n1\t2\n", "a")), ElementsAre("s", "mV"));
}

TEST(TextLayout, TwoLinesOfTextAreNotAlwaysNamesAndUnits) {
  EXPECT_THAT(names_of(find_layout("Channel A,Channel B\ns,x\n0,1\n", "a")),
              ElementsAre("s", "x"))
      << "nothing says that the first column is the time";
  EXPECT_THAT(names_of(find_layout("Time,Speed\nt,w\n0,1\n", "a")), ElementsAre("t", "w"));
}

TEST(TextLayout, GoesWithoutHeader) {
  const TextLayout layout = find_layout("0 1 2\n", "a");
  EXPECT_EQ(layout.columns(), 3u);
  EXPECT_FALSE(layout.header_line);
  EXPECT_THAT(names_of(layout), ElementsAre("", "", ""));
}

TEST(TextLayout, SkipsAByteOrderMark) {
  EXPECT_THAT(names_of(find_layout("\xEF\xBB\xBFt,x\n0,1\n", "a")), ElementsAre("t", "x"));
  EXPECT_EQ(find_layout("\xEF\xBB\xBF"
                        "0,1\n",
                        "a")
                .data_begin,
            3u);
}

TEST(TextLayout, SkipsAnOscilloscopesPreamble) {
  const TextLayout layout = find_layout(
      "Model,DSO-X 2024\nSerial Number,MY123\nRecord Length,10000\n"
      "Sample Interval,1e-06\n\nTIME,CH1,CH2\n-0.01,0.1,0.2\n",
      "scope.csv");
  EXPECT_THAT(names_of(layout), ElementsAre("TIME", "CH1", "CH2"));
  EXPECT_EQ(layout.data_line, 7u);
  EXPECT_EQ(layout.note, "scope.csv:1: 4 preamble lines skipped");
}

TEST(TextLayout, ALoneNumberInAPreambleIsNoData) {
  const TextLayout layout = find_layout("10000\nTIME,CH1\n0,1\n1,2\n", "a");
  EXPECT_THAT(names_of(layout), ElementsAre("TIME", "CH1"));
}

TEST(TextLayout, UnitsMayStandInALineOfTheirOwn) {
  const TextLayout pico = find_layout("Time,Channel A\n(ms),(V)\n\n0,1\n", "a");
  EXPECT_THAT(names_of(pico), ElementsAre("Time", "Channel A"));
  EXPECT_THAT(units_of(pico), ElementsAre("ms", "V"));
  const TextLayout keysight = find_layout("x-axis,1\nsecond,Volt\n-0.5,1\n", "a");
  EXPECT_THAT(names_of(keysight), ElementsAre("x-axis", "1"));
  EXPECT_THAT(units_of(keysight), ElementsAre("s", "V"));
}

TEST(TextLayout, ColumnsMayHaveNumbersAsNamesBehindTheTime) {
  EXPECT_THAT(names_of(find_layout("time,1,2\n0,5,6\n", "a")), ElementsAre("time", "1", "2"));
}

TEST(TextLayout, ADelimiterAtTheEndOfEachLineOpensNoColumn) {
  const TextLayout both = find_layout("t,x,\n0,1,\n", "a");
  EXPECT_THAT(names_of(both), ElementsAre("t", "x"));
  EXPECT_TRUE(both.trailing_delimiter);
  const TextLayout data_only = find_layout("t,x\n0,1,\n", "a");
  EXPECT_THAT(names_of(data_only), ElementsAre("t", "x"));
  EXPECT_TRUE(data_only.trailing_delimiter);
  EXPECT_FALSE(find_layout("t,x,y\n0,1,\n", "a").trailing_delimiter);
}

TEST(TextLayout, ASingleColumnNeedsNoDelimiter) {
  EXPECT_THAT(names_of(find_layout("Ch 1 [V]\n0.5\n", "a")), ElementsAre("Ch 1"));
}

TEST(TextLayout, RefusesWhatHasNoNumbers) {
  expect_error<DataError>([] { find_layout("", "a.csv"); }, "a.csv", "the file is empty",
                          "header line");
  expect_error<DataError>([] { find_layout("# only\n\n", "a.csv"); }, "a.csv",
                          "the file is empty", "lines of numbers");
  expect_error<DataError>([] { find_layout("t,x\n", "a.csv"); }, "a.csv",
                          "there is no line of numbers", "lines of numbers");
}

TEST(TextLayout, FindsTextInTheFirstLineBehindTheHeader) {
  expect_error<DataError>([] { find_layout("t,x\n0,abc\n1,def\n", "a.csv"); }, "a.csv:2:2",
                          "'abc' is not a number", "column of text");
  expect_error<DataError>([] { find_layout("t,x\n0,abc\n1,2\n", "a.csv"); }, "a.csv:2",
                          "numbers and text", "#");
}

TEST(TextLayout, RefusesAHeaderThatDoesNotFit) {
  expect_error<DataError>([] { find_layout("t,x\n0,1,2\n", "a.csv"); }, "a.csv:1",
                          "the header has 2 names, the data have 3 columns",
                          "name every column");
}

}  // namespace
}  // namespace lacuna
