// SPDX-License-Identifier: MIT
// MATLAB files, as a user gives them; the samples say in their README what is in them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "lacuna/core/base/error.hpp"
#include "lacuna/data/formats/read.hpp"
#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"
#include "support/written_arrays.hpp"

namespace lacuna {
namespace {

const std::filesystem::path kMatSamples = LACUNA_SOURCE_DIR "/tests/unit/data/formats/samples";

std::string bytes_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// Column by column: t, sin(5 t), cos(5 t), as the samples have them.
void expect_sine_and_cosine(const Table& table, Index sine, Index cosine) {
  ASSERT_EQ(table.values.rows(), 50);
  for (Index i = 0; i < 50; ++i) {
    const double t = 0.02 * static_cast<double>(i);
    EXPECT_NEAR(table.values(i, sine), std::sin(5.0 * t), 1e-15) << i;
    EXPECT_NEAR(table.values(i, cosine), std::cos(5.0 * t), 1e-15) << i;
  }
}

/// Whether the library was built without the reader, which it says then.
bool is_matio_absent() {
  if (HAS_MATIO) return false;
  EXPECT_THROW(read_table(kMatSamples / "arrays_v7.mat"), DataError);
  return true;
}

TEST(Matio, ArraysAreColumns) {
  if (is_matio_absent()) return;
  const Table table = read_table(kMatSamples / "arrays_v7.mat");
  ASSERT_EQ(table.columns.size(), 4u);
  EXPECT_EQ(table.columns[0].name, "t");
  EXPECT_EQ(table.columns[3].name, "u");
  expect_sine_and_cosine(table, 1, 2);
  EXPECT_EQ(table.values(7, 3), std::round(100.0 * std::sin(0.7)));
  EXPECT_EQ(table.notes.size(), 3u);  // a text, a complex number, three dimensions
  EXPECT_THAT(table.notes, ::testing::Contains(::testing::HasSubstr("the variable 'cube'")));
}

TEST(Matio, StructuresAreOpened) {
  if (is_matio_absent()) return;
  const Table table = read_table(kMatSamples / "structure_v6.mat");
  ASSERT_EQ(table.columns.size(), 3u);
  EXPECT_EQ(table.columns[0].name, "time");
  EXPECT_EQ(table.columns[1].name, "signals_th");
  expect_sine_and_cosine(table, 1, 2);
}

TEST(Matio, CellsAndArraysOfStructuresAreOpened) {
  if (is_matio_absent()) return;
  const Table table = read_table(kMatSamples / "cells_v6.mat");
  ASSERT_EQ(table.columns.size(), 6u);
  EXPECT_EQ(table.columns[0].name, "run1_t");
  EXPECT_EQ(table.columns[3].name, "run2_speed");
  EXPECT_EQ(table.columns[5].name, "log2_speed");
  for (Index i = 0; i < 50; ++i) {
    const auto n = static_cast<double>(i);
    EXPECT_NEAR(table.values(i, 3), 2.0 * std::sin(0.1 * n), 1e-14) << i;
    EXPECT_NEAR(table.values(i, 5), 4.0 * std::cos(0.1 * n), 1e-14) << i;
  }
}

TEST(Matio, DamageIsTold) {
  if (is_matio_absent()) return;
  const testing::TemporaryFolder folder;
  const std::string good = bytes_of(kMatSamples / "arrays_v7.mat");
  const Table whole = read_table(kMatSamples / "arrays_v7.mat");
  ASSERT_GT(good.size(), 1000u);
  for (std::size_t size = 130; size + 1 < good.size(); size += 97) {
    std::ofstream(folder.file("cut.mat"), std::ios::binary) << good.substr(0, size);
    try {
      const Table cut = read_table(folder.file("cut.mat"));
      EXPECT_EQ(cut.values, whole.values.leftCols(cut.values.cols())) << size;
    } catch (const DataError& error) {
      EXPECT_THAT(error.what(), ::testing::HasSubstr("cut.mat")) << size;
    }
  }
}

TEST(Matio, MoreNumbersThanAFileCanHoldAreTold) {
  if (is_matio_absent()) return;
  const testing::TemporaryFolder folder;
  std::string file = testing::mat_file(
      {{"x",
        true,
        false,
        {std::bit_cast<std::uint64_t>(1.5), std::bit_cast<std::uint64_t>(-2.0)}}});
  EXPECT_EQ(read_table(folder.write("two.mat", file)).values(1, 0), -2.0);
  // The number of rows stands behind the header, three tags and the flags.
  folder.write("huge.mat", file.replace(160, 4, testing::bytes_of({2000000000}, 4)));
  testing::expect_error<DataError>([&] { read_table(folder.file("huge.mat")); },
                                   folder.file("huge.mat"), "'x' is said to have 2e+09 numbers",
                                   "damaged");
}

TEST(Matio, APackedFileHasToBeUnpackedFirst) {
  if (is_matio_absent()) return;
  const testing::TemporaryFolder folder;
  std::filesystem::copy(kMatSamples / "arrays_v7.mat", folder.file("run.mat.gz"));
  EXPECT_THROW(read_table(folder.file("run.mat.gz")), DataError);
}

}  // namespace
}  // namespace lacuna
