// SPDX-License-Identifier: MIT
#include "streams/npy_file.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "data/npy.hpp"
#include "lacuna/core/error.hpp"
#include "lacuna/data/read.hpp"
#include "support/temporary_folder.hpp"

namespace lacuna {
namespace {

/// A file as NumPy writes one in C order.
void save_by_rows(const std::string& path, const Matrix& values) {
  std::string header = "{'descr': '<f8', 'fortran_order': False, 'shape': (" +
                       std::to_string(values.rows()) + ", " + std::to_string(values.cols()) +
                       "), }";
  header.append(118 - header.size() - 1, ' ');
  header += '\n';
  std::ofstream file(path, std::ios::binary);
  file << std::string("\x93NUMPY\x01\x00", 8) << static_cast<char>(header.size()) << '\0'
       << header;
  const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> rows = values;
  file.write(reinterpret_cast<const char*>(rows.data()),
             static_cast<std::streamsize>(rows.size() * 8));
}

TEST(NpyFile, RowsOfEitherOrderAreThoseOfTheWholeFile) {
  const testing::TemporaryFolder folder;
  const Matrix values = Matrix::Random(2000, 3);
  write_npy(folder.file("columns.npy"), values);
  save_by_rows(folder.file("rows.npy"), values);
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
