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
#include "support/temporary_folder.hpp"
#include "unit/data/formats/mutate.hpp"

namespace lacuna {
namespace {

using testing::TemporaryFolder;

/// A version 1 file with this header and these bytes behind it.
std::string npy(const std::string& header, const std::string& data) {
  std::string bytes("\x93NUMPY\x01\x00", 8);
  bytes += static_cast<char>(header.size());
  bytes += '\0';
  return bytes + header + data;
}

std::string header_of(const std::string& type, const std::string& shape,
                      const std::string& fortran = "False") {
  return "{'descr': " + type + ", 'fortran_order': " + fortran + ", 'shape': " + shape +
         ", }\n";
}

/// The low bytes of each number, least or most significant first.
std::string packed(const std::vector<std::uint64_t>& numbers, unsigned size, bool big) {
  std::string bytes;
  for (const std::uint64_t number : numbers)
    for (unsigned i = 0; i < size; ++i)
      bytes += static_cast<char>((number >> (8 * (big ? size - 1 - i : i))) & 0xFFU);
  return bytes;
}

std::vector<double> column_of(const std::string& type, const std::string& data) {
  const Vector values = parse_npy(npy(header_of(type, "(2,)"), data), "a.npy").values.col(0);
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
    EXPECT_EQ(column_of(order + "f8'", packed({one, two}, 8, big)), expected);
    EXPECT_EQ(column_of(order + "f4'", packed({0x3F800000U, 0xC0000000U}, 4, big)), expected);
    EXPECT_EQ(column_of(order + "f2'", packed({0x3C00U, 0xC000U}, 2, big)), expected);
    for (const unsigned size : {1U, 2U, 4U, 8U})
      EXPECT_EQ(column_of(order + "i" + std::to_string(size) + "'",
                          packed({1, ~std::uint64_t{1}}, size, big)),
                expected);
    EXPECT_EQ(column_of(order + "u2'", packed({1, 65535}, 2, big)),
              (std::vector<double>{1.0, 65535.0}));
  }
  EXPECT_EQ(column_of("'|b1'", packed({1, 0}, 1, false)), (std::vector<double>{1.0, 0.0}));
}

TEST(ParseNpy, ReadsHalfPrecisionExtremes) {
  EXPECT_EQ(column_of("'<f2'", packed({0x0001U, 0x7BFFU}, 2, false)),
            (std::vector<double>{std::ldexp(1.0, -24), 65504.0}));
  const std::vector<double> odd = column_of("'<f2'", packed({0xFC00U, 0x7E00U}, 2, false));
  EXPECT_EQ(odd[0], -std::numeric_limits<double>::infinity());
  EXPECT_TRUE(std::isnan(odd[1]));
}

TEST(ParseNpy, ReadsBothOrders) {
  Matrix expected(2, 3);
  expected << 1, 2, 3, 4, 5, 6;
  const std::string by_row = packed({1, 2, 3, 4, 5, 6}, 1, false);
  const std::string by_column = packed({1, 4, 2, 5, 3, 6}, 1, false);
  EXPECT_EQ(parse_npy(npy(header_of("'|u1'", "(2, 3)"), by_row), "a").values, expected);
  EXPECT_EQ(parse_npy(npy(header_of("'|u1'", "(2, 3)", "True"), by_column), "a").values,
            expected);
}

TEST(ParseNpy, StructuredTypesNameTheirColumns) {
  const std::string type = "[('t', '<u2'), ('', '|V1'), (('title', 'Ch 1'), '|i1')]";
  const std::string data("\x01\x00?\x05\x02\x00?\xFF", 8);
  const Table table = parse_npy(npy(header_of(type, "(2,)"), data), "a.npy");
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
      const std::string data = packed({count, kNone}, 8, kind[0] == '>');
      const Table table =
          parse_npy(npy(header_of("'" + kind + "[" + unit + "]'", "(2,)"), data), "a.npy");
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
  const Table table = parse_npy(
      npy(header_of("[('t', '<M8[ns]'), ('x', '<f8')]", "(20,)"), packed(numbers, 8, false)),
      "a.npy", time_finder({}));
  EXPECT_EQ(table.columns[0].unit, "ns");
  ASSERT_TRUE(table.counted);
  EXPECT_EQ(table.values(19, 0), 1900.0);
  EXPECT_TRUE(std::isnan(table.values(5, 0)));
  EXPECT_EQ(table.values(19, 1), 9.5);
}

TEST(ParseNpy, MutatedFilesParseOrAreRefused) {
  const std::string valid =
      npy(header_of("[('t', '<f4'), ('x', '>i2')]", "(3,)"), std::string(18, '\1'));
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

}  // namespace
}  // namespace lacuna
