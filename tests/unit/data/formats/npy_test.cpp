// SPDX-License-Identifier: MIT
#include "data/formats/npy.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "data/times/counted_times.hpp"
#include "lacuna/core/base/error.hpp"
#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"
#include "support/written_arrays.hpp"
#include "unit/data/formats/mutate.hpp"

namespace lacuna {
namespace {

using testing::bytes_of;
using testing::npy_file;
using testing::TemporaryFolder;

std::vector<double> column_of(const std::string& type, const std::string& data) {
  const Vector values = parse_npy(npy_file(type, "(2,)", data), "a.npy").values.col(0);
  return {values.begin(), values.end()};
}

TEST(WriteNpy, ReadsBackAsTheSameMatrix) {
  const TemporaryFolder folder;
  const Matrix values = Matrix::Random(17, 4);
  write_npy(folder.file("a.npy"), values);
  const Table table = parse_npy(folder.read("a.npy"), "a.npy");
  EXPECT_EQ(table.values, values);
  EXPECT_EQ(table.columns[3].name, "c4");
  EXPECT_TRUE(table.lines.empty());
}

TEST(WriteNpy, AlignsTheNumbersAsTheFormatAsks) {
  const TemporaryFolder folder;
  write_npy(folder.file("a.npy"), Matrix::Zero(3, 2));
  const std::string bytes = folder.read("a.npy");
  EXPECT_EQ((bytes.size() - 6 * sizeof(double)) % 64, 0u);
  EXPECT_EQ(bytes[bytes.size() - 6 * sizeof(double) - 1], '\n');
}

TEST(ParseNpy, ReadsEveryTypeAndByteOrder) {
  const std::vector<double> expected{1.0, -2.0};
  for (const bool big : {false, true}) {
    const std::string order = big ? "'>" : "'<";
    const auto one = std::bit_cast<std::uint64_t>(1.0),
               two = std::bit_cast<std::uint64_t>(-2.0);
    EXPECT_EQ(column_of(order + "f8'", bytes_of({one, two}, 8, big)), expected);
    EXPECT_EQ(column_of(order + "f4'", bytes_of({0x3F800000U, 0xC0000000U}, 4, big)), expected);
    EXPECT_EQ(column_of(order + "f2'", bytes_of({0x3C00U, 0xC000U}, 2, big)), expected);
    for (const unsigned size : {1U, 2U, 4U, 8U})
      EXPECT_EQ(column_of(order + "i" + std::to_string(size) + "'",
                          bytes_of({1, ~std::uint64_t{1}}, size, big)),
                expected);
    EXPECT_EQ(column_of(order + "u2'", bytes_of({1, 65535}, 2, big)),
              (std::vector<double>{1.0, 65535.0}));
  }
  EXPECT_EQ(column_of("'|b1'", bytes_of({1, 0}, 1)), (std::vector<double>{1.0, 0.0}));
}

TEST(ParseNpy, ReadsHalfPrecisionExtremes) {
  EXPECT_EQ(column_of("'<f2'", bytes_of({0x0001U, 0x7BFFU}, 2)),
            (std::vector<double>{std::ldexp(1.0, -24), 65504.0}));
  const std::vector<double> odd = column_of("'<f2'", bytes_of({0xFC00U, 0x7E00U}, 2));
  EXPECT_EQ(odd[0], -std::numeric_limits<double>::infinity());
  EXPECT_TRUE(std::isnan(odd[1]));
}

TEST(ParseNpy, ReadsBothOrders) {
  Matrix expected(2, 3);
  expected << 1, 2, 3, 4, 5, 6;
  const std::string by_row = bytes_of({1, 2, 3, 4, 5, 6}, 1);
  const std::string by_column = bytes_of({1, 4, 2, 5, 3, 6}, 1);
  EXPECT_EQ(parse_npy(npy_file("'|u1'", "(2, 3)", by_row), "a").values, expected);
  EXPECT_EQ(parse_npy(npy_file("'|u1'", "(2, 3)", by_column, true), "a").values, expected);
}

TEST(ParseNpy, StructuredTypesNameTheirColumns) {
  const std::string type = "[('t', '<u2'), ('', '|V1'), (('title', 'Ch 1'), '|i1')]";
  const std::string data("\x01\x00?\x05\x02\x00?\xFF", 8);
  const Table table = parse_npy(npy_file(type, "(2,)", data), "a.npy");
  EXPECT_EQ(table.columns[0].name, "t");
  EXPECT_EQ(table.columns[1].name, "Ch_1");
  Matrix expected(2, 2);
  expected << 1, 5, 2, -1;
  EXPECT_EQ(table.values, expected);
}

TEST(ParseNpy, DatesAndSpansOfTimeAreNumbersWithTheirUnit) {
  // datetime64 counts from 1970: 2026-11-25 00:00 in each unit, then NaT.
  constexpr std::uint64_t kDays = 20782, kNone = 1ULL << 63U;
  const std::vector<std::pair<std::string, std::uint64_t>> written{{"D", kDays},
                                                                   {"h", 24 * kDays},
                                                                   {"m", 1440 * kDays},
                                                                   {"s", 86400 * kDays},
                                                                   {"ms", 86400000 * kDays}};
  for (const auto& [unit, count] : written)
    for (const std::string kind : {"<M8", "<m8", ">M8"}) {
      const std::string data = bytes_of({count, kNone}, 8, kind[0] == '>');
      const Table table =
          parse_npy(npy_file("'" + kind + "[" + unit + "]'", "(2,)", data), "a.npy");
      EXPECT_EQ(table.values(0, 0), static_cast<double>(count)) << kind << unit;
      EXPECT_TRUE(std::isnan(table.values(1, 0)));
      EXPECT_EQ(table.columns[0].unit, unit == "D" ? "d" : unit == "m" ? "min" : unit);
    }
}

TEST(ParseNpy, TimesOfAFieldOfDatesAreCountedInTheirUnit) {
  constexpr std::uint64_t kFirst = 1'795'000'000'000'000'000, kNone = 1ULL << 63U;
  std::vector<std::uint64_t> numbers;
  for (std::uint64_t i = 0; i < 20; ++i) {
    numbers.push_back(i == 5 ? kNone : kFirst + 100 * i);
    numbers.push_back(std::bit_cast<std::uint64_t>(0.5 * static_cast<double>(i)));
  }
  const Table table =
      parse_npy(npy_file("[('t', '<M8[ns]'), ('x', '<f8')]", "(20,)", bytes_of(numbers)),
                "a.npy", time_finder({}));
  EXPECT_EQ(table.columns[0].unit, "ns");
  ASSERT_TRUE(table.counted);
  EXPECT_EQ(table.values(19, 0), 1900.0);
  EXPECT_TRUE(std::isnan(table.values(5, 0)));
  EXPECT_EQ(table.values(19, 1), 9.5);
}

TEST(ParseNpy, MutatedFilesParseOrAreRefused) {
  const std::string valid =
      npy_file("[('t', '<f4'), ('x', '>i2')]", "(3,)", std::string(18, '\1'));
  Random random(12);
  for (int i = 0; i < 20000; ++i) {
    const std::string bytes = testing::mutated(
        valid, std::string_view("'()[]{},:<>|fiub0123456789TrueV \0\xFF\x7F", 36), random);
    try {
      const Table table = parse_npy(bytes, "a.npy");
      ASSERT_EQ(table.values.cols(), static_cast<Index>(table.columns.size()));
    } catch (const Error& error) {
      EXPECT_EQ(error.where().substr(0, 5), "a.npy") << error.what();
    }
  }
}

// The header of .npy files, read through parse_npy.
/// A file of the given version with this header and 16 bytes behind it.
std::string npy(const std::string& header, char version = 1) {
  std::string bytes = "\x93NUMPY";
  bytes += version;
  bytes += '\0';
  bytes += static_cast<char>(header.size());
  bytes += std::string(version == 1 ? 1 : 3, '\0');
  return bytes + header + std::string(16, '\0');
}

void expect_refused(const std::string& bytes, const std::string& problem) {
  testing::expect_error<DataError>([&] { parse_npy(bytes, "a.npy"); }, "a.npy", problem,
                                   "numpy.save");
}

void expect_header_refused(const std::string& header, const std::string& problem) {
  expect_refused(npy(header), problem);
}

constexpr auto kGood = "{'descr': '<f8', 'fortran_order': False, 'shape': (2,), }";

TEST(NpyHeader, VersionsDifferInTheLengthOfTheLength) {
  for (const char version : {'\1', '\2', '\3'})
    EXPECT_EQ(parse_npy(npy(kGood, version), "a.npy").values, Matrix::Zero(2, 1));
  expect_refused(npy(kGood, 4), "version 4 is not known");
}

TEST(NpyHeader, TheOrderOfEntriesDoesNotMatter) {
  const std::string header = "{\"shape\":(1,2),\"fortran_order\":True,\"descr\":\"<f8\"}  \n";
  EXPECT_EQ(parse_npy(npy(header), "a.npy").values, Matrix::Zero(1, 2));
}

TEST(NpyHeader, RefusesOtherFiles) {
  expect_refused("", "first bytes");
  expect_refused("t,x\n0,1\n", "first bytes");
  expect_refused(npy(kGood).substr(0, 9), "cut short");
  expect_refused(npy(kGood).substr(0, 40), "cut short");
  expect_refused(npy(kGood).substr(0, npy(kGood).size() - 1), "cut short");
}

TEST(NpyHeader, RefusesTypesThatAreNoRealNumbers) {
  const std::string tail = ", 'fortran_order': False, 'shape': (1,), }";
  expect_header_refused("{'descr': '<c16'" + tail, "type '<c16' is not a real number");
  expect_header_refused("{'descr': '|O8'" + tail, "type '|O8'");
  expect_header_refused("{'descr': '<f16'" + tail, "type '<f16'");
  expect_header_refused("{'descr': 'f'" + tail, "type 'f' is not known");
  expect_header_refused("{'descr': [('a', '<f8', (2,))]" + tail, "field 'a' is an array");
  expect_header_refused("{'descr': [('a', [('b', '<f8')])]" + tail, "field 'a' has fields");
}

TEST(NpyHeader, RefusesDatesInUnitsThatAreNotRead) {
  const std::string tail = ", 'fortran_order': False, 'shape': (1,), }";
  for (const std::string type : {"<M8", "<M8[M]", "<m8[Y]", "<M8[10ms]", "<M8[", "<m8[ns]]"})
    testing::expect_error<DataError>(
        [&] { parse_npy(npy("{'descr': '" + type + "'" + tail), "a.npy"); }, "a.npy", type,
        "datetime64[ns]");
}

TEST(NpyHeader, RefusesShapesThatAreNoTable) {
  const std::string head = "{'descr': '<f8', 'fortran_order': False, 'shape': ";
  expect_header_refused(head + "(), }", "it has 0 dimensions");
  expect_header_refused(head + "(1,1,1), }", "it has 3 dimensions");
  expect_header_refused(head + "(0,2), }", "it is empty");
  expect_header_refused(head + "(4294967296,4294967296), }", "cut short");
  expect_header_refused(head + "(99999999999999999999,), }", "shape is damaged");
}

TEST(NpyHeader, RefusesADamagedHeader) {
  expect_header_refused("", "'{' is missing");
  expect_header_refused("{'descr': '<f8'}", "not complete");
  expect_header_refused("{'descr': '<f8', 'order': False}", "unknown entry 'order'");
  expect_header_refused("{'descr' '<f8'}", "':' is missing");
  expect_header_refused("{'fortran_order': maybe}", "damaged");
}

}  // namespace
}  // namespace lacuna
