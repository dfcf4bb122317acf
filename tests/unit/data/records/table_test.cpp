// SPDX-License-Identifier: MIT
#include "lacuna/data/records/table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/base/names.hpp"
#include "data/records/text_field.hpp"
#include "lacuna/core/base/error.hpp"
#include "support/expect_error.hpp"

namespace lacuna {
namespace {

using ::testing::ElementsAre;
using Kind = TextField::Kind;
using testing::expect_error;

Table named(const std::vector<Quantity>& headers) {
  Table table;
  table.source = "a.csv";
  name_columns(table, headers, 3);
  return table;
}

TEST(ToIdentifier, ConvertsWhatPeopleWrite) {
  EXPECT_EQ(to_identifier("Ch 1"), "Ch_1");
  EXPECT_EQ(to_identifier("x-axis"), "x_axis");
  EXPECT_EQ(to_identifier("  motor / speed  "), "motor_speed");
  EXPECT_EQ(to_identifier("2nd"), "c_2nd");
  EXPECT_EQ(to_identifier("\xCF\x86"), "phi");
  EXPECT_EQ(to_identifier("\xCE\xA9 1"), "Omega_1");
  EXPECT_EQ(to_identifier("%!"), "");
}

TEST(ToIdentifier, GivesIdentifiersOrNothing) {
  for (const char* text : {"\xCF", "\xFF\xFE", "a\x01", "_", "9", "\xC3\xA4\xC3\xB6"}) {
    const std::string name = to_identifier(text);
    EXPECT_TRUE(name.empty() || is_identifier(name)) << name;
  }
}

TEST(SplitHeader, FindsTheUnit) {
  EXPECT_EQ(split_header(" x [V] "), (Quantity{"x", "V"}));
  EXPECT_EQ(split_header("Ch 1 (V)"), (Quantity{"Ch 1", "V"}));
  EXPECT_EQ(split_header("w[rad/s]"), (Quantity{"w", "rad/s"}));
  EXPECT_EQ(split_header("x"), (Quantity{"x", ""}));
  EXPECT_EQ(split_header("a) b]"), (Quantity{"a) b]", ""}));
}

TEST(SplitHeader, DigitsInBracketsAreAnIndex) {
  EXPECT_EQ(split_header("/joint_states/position[0]"),
            (Quantity{"/joint_states/position[0]", ""}));
  EXPECT_EQ(split_header("q[12] [rad]"), (Quantity{"q[12]", "rad"}));
  EXPECT_EQ(split_header("CH(2)"), (Quantity{"CH(2)", ""}));
  EXPECT_EQ(split_header("ratio [1]"), (Quantity{"ratio", "1"})) << "as it is written here";
  Table table;
  name_columns(table, {split_header("position[0]"), split_header("position[1]")}, 1);
  EXPECT_EQ(table.columns[0].name, "position_0");
  EXPECT_EQ(table.columns[1].name, "position_1");
}

TEST(NameColumns, NotesWhatItChanges) {
  const Table table = named({{"t", ""}, {"Ch 1", "V"}, {"sin", ""}, {"", ""}});
  EXPECT_EQ(table.columns[1].name, "Ch_1");
  EXPECT_EQ(table.columns[2].name, "sin_");
  EXPECT_EQ(table.columns[3].name, "c4");
  EXPECT_THAT(table.headers, ElementsAre("t", "Ch 1", "sin", ""));
  EXPECT_THAT(table.notes, ElementsAre("a.csv:3:2: column 'Ch 1' is called 'Ch_1'",
                                       "a.csv:3:3: column 'sin' is called 'sin_'"));
}

TEST(NameColumns, RefusesDuplicates) {
  expect_error<DataError>(
      [] {
        named({{"t", ""}, {"x", ""}, {"x", "V"}});
      },
      "a.csv:3:3", "columns 2 and 3 are both named 'x'", "name of its own");
  expect_error<DataError>(
      [] {
        named({{"V+", ""}, {"V-", ""}});
      },
      "a.csv:3:2", "both named 'V'", "name of its own");
}

TEST(RenameColumn, FindsColumnsByNameHeaderAndNumber) {
  Table table = named({{"Zeit", "s"}, {"Winkel (roh)", "rad"}, {"u", "V"}});
  rename_column(table, "t", "Zeit");
  rename_column(table, "th", "Winkel (roh)");
  rename_column(table, "force", "3");
  EXPECT_EQ(table.columns[0].name, "t");
  EXPECT_EQ(table.columns[1].name, "th");
  EXPECT_EQ(table.columns[2].name, "force");
  EXPECT_EQ(table.columns[2].unit, "V");
}

TEST(RenameColumn, RefusesWhatIsNotThereAndNamesThatAreTaken) {
  Table table = named({{"t", "s"}, {"Winkel", "rad"}});
  const auto renamed = [&](const std::string& name, const std::string& column) {
    return [&table, name, column] { rename_column(table, name, column); };
  };
  expect_error<DataError>(renamed("th", "Winkle"), "a.csv", "no column 'Winkle'", "Winkel");
  expect_error<DataError>(renamed("th", "3"), "a.csv", "no column '3'", "");
  expect_error<DataError>(renamed("th", "1.5"), "a.csv", "no column '1.5'", "");
  expect_error<DataError>(renamed("t", "Winkel"), "a.csv", "another column", "name");
  expect_error<DataError>(renamed("2x", "Winkel"), "a.csv", "is not an identifier", "letters");
}

TEST(Place, NamesLineOrRow) {
  Table table;
  table.source = "a.csv";
  table.lines = {7, 9};
  EXPECT_EQ(place(table, 1, 2), "a.csv:9:3");
  table.lines.clear();
  EXPECT_EQ(place(table, 1, 2), "a.csv, row 2, column 3");
}

std::vector<std::string_view> fields_of(std::string_view line, char delimiter) {
  std::vector<std::string_view> fields{"left over"};
  split_fields(line, delimiter, fields);
  return fields;
}

TEST(ReadField, MissingValues) {
  for (const char* text : {"", "  ", "NaN", "nan", "-nan", "NA", "n/a", "null", "None", "\"\"",
                           "n.d.", "ND", "-", "#NV", "#N/A"}) {
    EXPECT_EQ(read_field(text).kind, Kind::Missing) << text;
    EXPECT_TRUE(std::isnan(read_field(text).value)) << text;
  }
}

TEST(ReadField, Text) {
  for (const char* text :
       {"abc", "1.5x", "1,2,3", "1.23,4", "1.2345,6", "1.234,5,6", "12:30", "--", "0x10"})
    EXPECT_EQ(read_field(text).kind, Kind::Text) << text;
}

TEST(ReadField, GroupsOfThousandsBesideASeparatorOfDecimals) {
  EXPECT_EQ(read_field("1.234,5").value, 1234.5);
  EXPECT_EQ(read_field("-12,345,678.25").value, -12345678.25);
  EXPECT_EQ(read_field("1.234.567,0").value, 1234567.0);
}

TEST(ReadField, TheSignOfInfinity) {
  EXPECT_EQ(read_field("\u221e").value, std::numeric_limits<double>::infinity());
  EXPECT_EQ(read_field("-\u221e").value, -std::numeric_limits<double>::infinity());
}

TEST(ReadField, TheMinusSignOfTypesetting) {
  EXPECT_EQ(read_field("\u22121.5e\u22123").value, -1.5e-3);
  EXPECT_EQ(read_field("\"\u22120,25\"").value, -0.25);
  EXPECT_EQ(read_field("\u221212.345,5").value, -12345.5);
  EXPECT_EQ(read_field("\u2212\u221e").value, -std::numeric_limits<double>::infinity());
  EXPECT_EQ(read_field("\u2212").kind, Kind::Missing) << "a dash";
  EXPECT_EQ(read_field("1\u22122").kind, Kind::Text);
}

TEST(SplitFields, UnitsInBracketsBelongToTheName) {
  EXPECT_THAT(fields_of("t [s]  F [N m] x", ' '), ElementsAre("t [s]", "F [N m]", "x"));
}

}  // namespace
}  // namespace lacuna
