// SPDX-License-Identifier: MIT
// The samples say in their README what is in them.
#include "data/formats/hdf5.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "lacuna/core/base/error.hpp"
#include "lacuna/data/formats/read.hpp"
#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"
#if HAS_HDF5
#include "support/written_hdf5.hpp"
#endif

namespace lacuna {
namespace {

const std::filesystem::path kSamples = LACUNA_SOURCE_DIR "/tests/unit/data/formats/samples";

double time_at(Index i) { return 0.02 * static_cast<double>(i); }

/// Whether the library was built without the reader, which it says then.
bool is_absent() {
  if (HAS_HDF5) return false;
  EXPECT_THROW(read_table(kSamples / "groups.h5"), DataError);
  return true;
}

TEST(Hdf5, DataSetsAreColumns) {
  if (is_absent()) return;
  const Table table = read_table(kSamples / "groups.h5");
  std::vector<std::string> names;
  for (const Quantity& column : table.columns) names.push_back(column.name);
  ASSERT_THAT(names, ::testing::UnorderedElementsAre("count", "signals_th", "signals_w", "t",
                                                     "xy1", "xy2"));
  const auto column = [&](std::string_view name) {
    return table.values.col(std::find(names.begin(), names.end(), name) - names.begin());
  };
  for (Index i = 0; i < 50; ++i) {
    EXPECT_EQ(column("count")[i], static_cast<double>(i));
    EXPECT_NEAR(column("t")[i], time_at(i), 1e-15);
    EXPECT_NEAR(column("signals_th")[i], std::sin(5.0 * time_at(i)), 1e-7);
    EXPECT_NEAR(column("signals_w")[i], std::cos(5.0 * time_at(i)), 1e-15);
    EXPECT_NEAR(column("xy1")[i], std::sin(5.0 * time_at(i)), 1e-15);
  }
  EXPECT_THAT(table.notes, ::testing::Contains(::testing::HasSubstr("'run.name'")));
  EXPECT_THAT(table.notes, ::testing::Contains(::testing::HasSubstr("'run.signals.broken'")));
}

TEST(Hdf5, IsWhatMatlabWritesToday) {
  if (is_absent()) return;
  const Table table = read_table(kSamples / "arrays_v73.mat");
  ASSERT_EQ(table.columns.size(), 4u);
  EXPECT_EQ(table.columns[0].name, "run_u");
  EXPECT_EQ(table.columns[2].name, "x1");
  for (Index i = 0; i < 50; ++i) {
    EXPECT_EQ(table.values(i, 0), std::round(100.0 * std::sin(5.0 * time_at(i))));
    EXPECT_NEAR(table.values(i, 3), std::cos(5.0 * time_at(i)), 1e-15);
  }
}

TEST(Hdf5, BlocksAreTheWhole) {
  for (const char* name : {"groups.h5", "arrays_v73.mat"})
    for (const std::size_t size : {std::size_t{1}, std::size_t{500}, std::size_t{1} << 20U}) {
      if (is_absent()) return;
      const Table whole = read_table(kSamples / name);
      const auto blocks = hdf5_blocks(kSamples / name, {size, size});
      EXPECT_EQ(blocks->columns().headers, whole.headers);
      EXPECT_EQ(blocks->columns().notes, whole.notes);
      Table block = blocks->columns();
      Index rows = 0;
      for (; blocks->next(block); rows += block.values.rows())
        EXPECT_EQ(block.values, whole.values.middleRows(rows, block.values.rows())) << name;
      EXPECT_EQ(rows, whole.values.rows());
      EXPECT_EQ(blocks->fraction(), 1.0);
    }
}

TEST(Hdf5, DamageIsTold) {
  if (is_absent()) return;
  std::ifstream file(kSamples / "groups.h5", std::ios::binary);
  const std::string good{std::istreambuf_iterator<char>(file), {}};
  EXPECT_THROW(parse_hdf5("", "a.h5"), DataError);
  for (std::size_t size = 0; size + 512 < good.size(); size += 1024)
    EXPECT_THROW(parse_hdf5(good.substr(0, size), "a.h5"), DataError) << size;
}

#if HAS_HDF5
TEST(Hdf5, LinksAreSaid) {
  const testing::TemporaryFolder folder;
  const std::vector<double> numbers{0.0, 1.0, 2.0, 3.0};
  {
    const testing::WrittenHdf5 file(folder.file("a.h5"));
    file.add_group("run");
    file.add("run/t", H5T_NATIVE_DOUBLE, numbers.data(), 4);
    file.add("run/x", H5T_NATIVE_DOUBLE, numbers.data(), 4);
    file.add_soft_link("alias", "/run/x");
    file.add_soft_link("nothing", "/run/none");
    file.add_soft_link("run/circle", "/");
  }
  for (const bool in_blocks : {false, true}) {
    const Table table = in_blocks ? hdf5_blocks(folder.file("a.h5"), {1000, 1000})->columns()
                                  : read_table(folder.file("a.h5"));
    ASSERT_EQ(table.columns.size(), 2u);
    EXPECT_EQ(table.columns[1].name, "x");
    EXPECT_THAT(
        table.notes,
        ::testing::UnorderedElementsAre(
            ::testing::HasSubstr("'alias' leads to '/run/x', which is read by its own name"),
            ::testing::HasSubstr("'nothing' leads to '/run/none', where nothing is"),
            ::testing::HasSubstr("'run.circle' leads to '/'")));
  }
}

TEST(Hdf5, OtherFilesAreNotOpened) {
  const testing::TemporaryFolder folder;
  const std::vector<double> numbers{0.0, 1.0, 2.0};
  for (const char* name : {"a.h5", "b.h5"}) {
    const testing::WrittenHdf5 file(folder.file(name));
    file.add("t", H5T_NATIVE_DOUBLE, numbers.data(), 3);
    file.add("x", H5T_NATIVE_DOUBLE, numbers.data(), 3);
    if (name[0] == 'a') file.add_external_link("y", folder.file("b.h5"), "/x");
  }
  testing::expect_error<DataError>([&] { read_table(folder.file("a.h5")); },
                                   folder.file("a.h5"), "'y' is a link to another file",
                                   "copy what it leads to");
}

TEST(Hdf5, NumbersThatStandInOtherFilesAreNotRead) {
  const testing::TemporaryFolder folder;
  const std::vector<double> numbers{0.0, 1.0, 2.0};
  const std::string other = folder.write("other.bin", std::string(24, 'x'));
  for (const bool is_virtual : {false, true})
    for (const bool in_blocks : {false, true}) {
      {
        const testing::WrittenHdf5 file(folder.file("a.h5"));
        file.add("t", H5T_NATIVE_DOUBLE, numbers.data(), 3);
        if (is_virtual)
          file.add_virtual("x", folder.file("b.h5"), "/x", 3);
        else
          file.add_stored_elsewhere("x", other, 3);
      }
      testing::expect_error<DataError>(
          [&] {
            if (in_blocks)
              hdf5_blocks(folder.file("a.h5"), {1000, 1000});
            else
              read_table(folder.file("a.h5"));
          },
          folder.file("a.h5"), "'x' keeps its numbers in another file", "copy them");
    }
}

TEST(Hdf5, WhatIsPutTogetherFromTheSameFileIsReadByItsOwnName) {
  const testing::TemporaryFolder folder;
  const std::vector<double> numbers{0.0, 1.0, 2.0};
  {
    const testing::WrittenHdf5 file(folder.file("a.h5"));
    file.add("t", H5T_NATIVE_DOUBLE, numbers.data(), 3);
    file.add("x", H5T_NATIVE_DOUBLE, numbers.data(), 3);
    file.add_virtual("y", ".", "/x", 3);
  }
  const Table table = read_table(folder.file("a.h5"));
  EXPECT_EQ(table.columns.size(), 2u);
  EXPECT_THAT(table.notes, ::testing::Contains(::testing::HasSubstr("'y' is put together")));
}
#endif

}  // namespace
}  // namespace lacuna
