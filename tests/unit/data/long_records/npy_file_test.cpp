// SPDX-License-Identifier: MIT
#include "data/long_records/npy_file.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "data/formats/npy.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/data/formats/read.hpp"
#include "support/temporary_folder.hpp"
#include "unit/data/long_records/long_records.hpp"

namespace lacuna {
namespace {

TEST(NpyFile, RowsOfEitherOrderAreThoseOfTheWholeFile) {
  const testing::TemporaryFolder folder;
  const Matrix values = Matrix::Random(2000, 3);
  write_npy(folder.file("columns.npy"), values);
  testing::write_rows(folder.file("rows.npy"), values);
  for (const char* name : {"columns.npy", "rows.npy"}) {
    const NpyFile file(folder.file(name));
    EXPECT_EQ(file.rows(), 2000);
    EXPECT_EQ(file.columns().columns.size(), 3U);
    EXPECT_EQ(file.values(0, 2000), values) << name;
    EXPECT_EQ(file.values(1990, 10), values.bottomRows(10)) << name;
    EXPECT_EQ(file.read(5, 1).values, values.row(5)) << name;
    EXPECT_EQ(file.read(5, 1).source, folder.file(name)) << name;
    EXPECT_EQ(read_table(folder.file(name)).values, values) << name;
  }
}

TEST(NpyFile, AFileThatGetsShorterIsAnErrorWhenItIsRead) {
  const testing::TemporaryFolder folder;
  write_npy(folder.file("a.npy"), Matrix::Random(2000, 3));
  const NpyFile file(folder.file("a.npy"));
  std::filesystem::resize_file(folder.file("a.npy"), 20000);
  EXPECT_THROW(file.values(1500, 100), FileError);
}

TEST(NpyFile, RefusesWhatIsCutShortFromTheBegin) {
  const testing::TemporaryFolder folder;
  write_npy(folder.file("a.npy"), Matrix::Random(2000, 3));
  std::filesystem::resize_file(folder.file("a.npy"), 20000);
  EXPECT_THROW(NpyFile(folder.file("a.npy")), DataError);
  EXPECT_THROW(NpyFile(folder.file(".")), FileError);
}

}  // namespace
}  // namespace lacuna
