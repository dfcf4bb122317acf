// SPDX-License-Identifier: MIT
#include "data/formats/read_text.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "core/base/text.hpp"
#include "lacuna/core/base/error.hpp"
#include "support/expect_error.hpp"
#include "unit/data/formats/mutate.hpp"

namespace lacuna {
namespace {

using ::testing::ElementsAre;
using testing::expect_error;

Table parse(const std::string& text) { return parse_text_table(text, "a.csv"); }

Matrix matrix_2x3(double a, double b, double c, double d, double e, double f) {
  Matrix values(2, 3);
  values << a, b, c, d, e, f;
  return values;
}

TEST(ReadText, ReadsEveryDelimiter) {
  const Matrix expected = matrix_2x3(0, 1.5, -2, 0.1, 2e-3, 3);
  for (const std::string separator : {",", ";", "\t", " ", " , ", "   "}) {
    const std::string text =
        join(std::vector<std::string>{"0", "1.5", "-2"}, separator) + "\n" +
        join(std::vector<std::string>{"0.1", "2e-3", "+3"}, separator) + "\n";
    EXPECT_EQ(parse(text).values, expected) << "separator '" << separator << "'";
  }
}

TEST(ReadText, LineEndsMakeNoDifference) {
  const Matrix expected = matrix_2x3(0, 1, 2, 3, 4, 5);
  for (const std::string text :
       {"t,x,y\n0,1,2\n3,4,5\n", "t,x,y\r\n0,1,2\r\n3,4,5\r\n", "t,x,y\r0,1,2\r3,4,5\r",
        "t,x,y\n0,1,2\n3,4,5", "t,x,y\r\n0,1,2\r\n3,4,5", "\xEF\xBB\xBFt,x,y\n0,1,2\n3,4,5\n"})
    EXPECT_EQ(parse(text).values, expected) << text;
}

TEST(ReadText, KnowsTheLineOfEveryRow) {
  const Table table = parse("# c\nt,x\n0,1\n\n# c\n1,2\n  # c\n2,3\n");
  EXPECT_THAT(table.lines, ElementsAre(3, 6, 8));
  EXPECT_EQ(table.values.rows(), 3);
}

TEST(ReadText, MissingValuesAreNaN) {
  const Table table = parse("t,x,y\n0,,2\n3,NaN,\n6,na,8\n");
  EXPECT_TRUE(std::isnan(table.values(0, 1)));
  EXPECT_EQ(table.values(0, 2), 2.0);
  EXPECT_TRUE(std::isnan(table.values(1, 1)));
  EXPECT_TRUE(std::isnan(table.values(1, 2)));
  EXPECT_TRUE(std::isnan(table.values(2, 1)));
}

TEST(ReadText, ReadsDecimalCommasAndQuotes) {
  EXPECT_EQ(parse("t;x;y\n0;1,5;2\n\"3\";4;5,25\n").values, matrix_2x3(0, 1.5, 2, 3, 4, 5.25));
  EXPECT_EQ(parse("\"t\",\"x\",\"y\"\n\"0\",\"1,5\",2\n3,4,5\n").values,
            matrix_2x3(0, 1.5, 2, 3, 4, 5));
}

TEST(ReadText, ReadsNumbersToTheLastBit) {
  const Table table = parse("0.1,1.7976931348623157e308,4.9e-324,1e-999\n");
  EXPECT_EQ(table.values(0, 0), 0.1);
  EXPECT_EQ(table.values(0, 1), std::numeric_limits<double>::max());
  EXPECT_EQ(table.values(0, 2), std::numeric_limits<double>::denorm_min());
  EXPECT_EQ(table.values(0, 3), 0.0);
}

/// The line of the first row and what the header says: "2: t [s]|x".
std::string header_of(const std::string& text) {
  const Table table = parse(text);
  std::string all = std::to_string(table.lines.at(0)) + ": ";
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    const std::string& unit = table.columns[i].unit;
    all += (i > 0 ? "|" : "") + table.headers[i] + (unit.empty() ? "" : " [" + unit + "]");
  }
  return all;
}

TEST(ReadText, HeadersOfManyPrograms) {
  const std::pair<std::string, std::string> headers[] = {
      {"t;x\n0;1\n", "2: t|x"},
      {"t   x\n0   1\n", "2: t|x"},
      {"# made by hand\nt [s], x (V) ,w\n\n0,1,2\n", "4: t [s]|x [V]|w"},
      {"0 1 2\n", "1: ||"},
      {"\xEF\xBB\xBFt,x\n0,1\n", "2: t|x"},
      {"Ch 1 [V]\n0.5\n", "2: Ch 1 [V]"},
      {"time,1,2\n0,5,6\n", "2: time|1|2"},
      // Units in a line of their own, if one of them is a time's.
      {"Time,Speed,Volt\nms,rpm,V\n0,0.5,5\n", "3: Time [ms]|Speed [rpm]|Volt [V]"},
      {"x;t\nm/s^2;us\n1;2\n", "3: x [m/s^2]|t [us]"},
      {"Zeit;T;n\n[min];[\u00b0C];-\n1;2;3\n", "3: Zeit [min]|T [\u00b0C]|n"},
      {"stamp\tx\nsec\tmV\n1\t2\n", "3: stamp [s]|x [mV]"},
      {"Time,Channel A\n(ms),(V)\n\n0,1\n", "4: Time [ms]|Channel A [V]"},
      {"x-axis,1\nsecond,Volt\n-0.5,1\n", "3: x-axis [s]|1 [V]"},
      {"Channel A,Channel B\ns,x\n0,1\n", "3: s|x"},
      {"Time,Speed\nt,w\n0,1\n", "3: t|w"},
      // Preambles.
      {"Model,DSO-X 2024\nSerial Number,MY123\nRecord Length,10000\nSample Interval,1e-06\n\n"
       "TIME,CH1,CH2\n-0.01,0.1,0.2\n",
       "7: TIME|CH1|CH2"},
      {"10000\nTIME,CH1\n0,1\n1,2\n", "3: TIME|CH1"},
      // A delimiter at the end of each line opens no column.
      {"t,x,\n0,1,\n", "2: t|x"},
      {"t,x\n0,1,\n", "2: t|x"},
      {"t,x,y\n0,1,\n", "2: t|x|y"},
  };
  for (const auto& [text, header] : headers) EXPECT_EQ(header_of(text), header) << text;
  EXPECT_THAT(parse("Model,DSO\nDepth,10000\n\nTIME,CH1\n-0.01,0.1\n").notes,
              ElementsAre("a.csv:1: 2 preamble lines skipped"));
}

TEST(ReadText, RefusesWhatIsNoTable) {
  const struct {
    std::string text, place, problem, remedy;
  } refused[] = {
      {"", "a.csv", "the file is empty", "header line"},
      {"# only\n\n", "a.csv", "the file is empty", "lines of numbers"},
      {"t,x\n", "a.csv", "there is no line of numbers", "lines of numbers"},
      {"t,x\n0,abc\n1,def\n", "a.csv:2:2", "'abc' is not a number", "column of text"},
      {"t,x\n0,abc\n1,2\n", "a.csv:2", "numbers and text", "#"},
      {"t,x\n0,1,2\n", "a.csv:1", "the header has 2 names, the data have 3 columns",
       "name every column"},
      {"# c\nt,x,x\n0,1,2\n", "a.csv:2:3", "columns 2 and 3 are both named 'x'",
       "name of its own"},
      {"t,x\n0,1\n1,2,3\n", "a.csv:3:3", "the line has 3 fields, the others have 2",
       "remove this line"},
      {"t,x\n0,1\n1,2\n\n2\n", "a.csv:5:2", "the line has 1 field, the others have 2",
       "same number of fields"},
      {"0 1\n1 2 3\n", "a.csv:2:3", "the line has 3 fields", "same number"},
      {"t,x\n0,1\n1,abc\n", "a.csv:3:2", "'abc' in column 'x' is not a number",
       "leave the field empty"},
      {"t,x\n0,1\n12:30,2\n", "a.csv:3:1", "'12:30'", "number"},
      {"t,x\n0,1\nt,x\n1,2\n", "a.csv:3:1", "'t'", "number"},
      // Under commas these lines would be a table too, with a column of text.
      {"t;x\n0,0;1,5\n0,1;1,7\n0,2;open\n0,3;2,1\n0,4;2,3\n", "a.csv:4:2",
       "'open' in column 'x' is not a number", "leave the field empty"},
  };
  for (const auto& file : refused)
    expect_error<DataError>([&] { parse(file.text); }, file.place, file.problem, file.remedy);
}

TEST(ReadText, CountsWordsForMissingValues) {
  const Table table = parse("t;x;y\n0,0;n.d.;-\n0,1;1,5;2,5\n0,2;#NV;\n0,3;NaN;1,5\n");
  EXPECT_EQ(table.values.array().isNaN().count(), 5);
  EXPECT_THAT(table.notes, ElementsAre("a.csv:2:2: 3 cells say that a value is missing, here "
                                       "'n.d.'"));
}

TEST(ReadText, RefusesWhatIsNoText) {
  expect_error<DataError>([] { parse(std::string("t,x\n0,\0\n", 8)); }, "a.csv", "binary",
                          ".npy");
  std::string all;
  for (int i = 0; i < 5120; ++i) all += static_cast<char>(i % 256);
  expect_error<DataError>([&] { parse(all); }, "a.csv", "binary", "UTF-16");
}

/// As the "Unicode text" of Excel; big-endian as others write it.
TEST(ReadText, ReadsUtf16) {
  for (const bool low_first : {true, false}) {
    std::string text = low_first ? "\xFF\xFE" : "\xFE\xFF";
    for (const char byte : std::string("t,\xFC\n0,1\n2,3\n"))
      text += low_first ? std::string{byte, '\0'} : std::string{'\0', byte};
    const Table table = parse(text);
    EXPECT_EQ(table.headers[1], "\u00fc");
    EXPECT_EQ(table.values.col(1), Eigen::Vector2d(1.0, 3.0));
  }
}

TEST(ReadText, AFewBytesOfZeroAreDamageOfTheirLine) {
  std::string text = "t,x\n";
  for (int i = 0; i < 100; ++i) text += std::to_string(i) + "," + std::to_string(i * i) + "\n";
  text.insert(text.find("50,2500") + 3, 2, '\0');
  const Table table = parse(text);
  EXPECT_EQ(table.values.rows(), 99);
  ASSERT_EQ(table.notes.size(), 1u);
  EXPECT_NE(table.notes[0].find("a.csv:52: 1 line with bytes that no text has"),
            std::string::npos);
}

TEST(ReadText, ACommaThatMayStandForThousandsIsRefused) {
  const auto refused = [](const std::string& text, const std::string& place) {
    expect_error<DataError>([&] { parse(text); }, place, "of decimals or of thousands",
                            "decimal point");
  };
  refused("t,x\n0,\"1,001\"\n1,\"1,002\"\n", "a.csv:2:2");
  refused("t,x\n0,\"1,5\"\n1,\"-12,002\"\n", "a.csv:3:2");
  refused("t,x,y\n0,0.5,\"0,5\"\n1,1,2\n", "a.csv:2:3");
  refused("t;x\n0.1;1\n0.2;1,001\n", "a.csv:3:2");
  refused("t\tx\n0.1\t999\n0.2\t1,001\n", "a.csv:3:2");
  refused("time,x\n10:00:00,\"1,001\"\n10:00:01,\"1,002\"\n", "a.csv:2:2");
}

TEST(ReadText, DecimalCommasThatCanBeNothingElseAreRead) {
  EXPECT_EQ(parse("t;x\n0;1,001\n1;1,002\n").values.col(1), Eigen::Vector2d(1.001, 1.002));
  EXPECT_EQ(parse("t,x\n0,\"1,5\"\n1,\"0,125\"\n").values.col(1), Eigen::Vector2d(1.5, 0.125));
  EXPECT_EQ(parse("t,x\n0,\"1234,567\"\n1,\"1,0015\"\n").values.col(1),
            Eigen::Vector2d(1234.567, 1.0015));
  EXPECT_EQ(parse("t;x\n10:00:00,5;1,001\n10:00:01;1,002\n").values.col(1),
            Eigen::Vector2d(1.001, 1.002))
      << "the point in the time is made by the reader";
}

/// A mutated text either parses into a table of the right shape or is refused.
void parse_mutated(const std::string& text) {
  try {
    const Table table = parse(text);
    ASSERT_EQ(table.values.cols(), static_cast<Index>(table.columns.size()));
    ASSERT_EQ(table.values.rows(), static_cast<Index>(table.lines.size()));
  } catch (const Error& error) {
    EXPECT_EQ(error.where().substr(0, 5), "a.csv") << error.what();
    EXPECT_FALSE(error.remedy().empty()) << error.what();
  }
}

TEST(ReadText, MutatedFilesParseOrAreRefused) {
  const std::string valid =
      "Model,DSO\n# comment\nt [s],Ch 1 [V],\"y, "
      "z\"\n0,1.5,-2e3\n0.1,,3\n0.2,nan,4\r\n0.3,5,6\n";
  Random random(11);
  for (int i = 0; i < 20000; ++i)
    parse_mutated(
        testing::mutated(valid, ",;\t \n\r#\"'[]()0123456789+-.eEinfa\0\xFF", random));
}

}  // namespace
}  // namespace lacuna
