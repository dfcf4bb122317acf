// SPDX-License-Identifier: MIT
#include "data/formats/row_blocks.hpp"

#include <gtest/gtest.h>

#include "core/files/file_bytes.hpp"
#include "lacuna/core/base/error.hpp"
#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"
#include "support/written_arrays.hpp"

namespace lacuna {
namespace {

using testing::TemporaryFolder;

TEST(OpenedFile, IsOfAKind) {
  const TemporaryFolder folder;
  const auto kind = [&](const std::string& name, const std::string& bytes) {
    return OpenedFile(folder.write(name, bytes)).kind;
  };
  EXPECT_EQ(kind("a.csv", "t,x\n0,1\n"), FileKind::Text);
  EXPECT_EQ(kind("a.csv.gz", gzip("t,x\n0,1\n")), FileKind::Text);
  EXPECT_EQ(kind("a.npz", "PK\x03\x04"), FileKind::Npz);
  EXPECT_EQ(kind("a.h5", "\x89HDF\r\n\x1a\n"), FileKind::Hdf5);
  EXPECT_EQ(kind("a.bin", gzip("\x93NUMPY")), FileKind::Npy);
  EXPECT_TRUE(OpenedFile(folder.file("a.csv")).has_places());
  EXPECT_FALSE(OpenedFile(folder.file("a.csv.gz")).has_places());
  testing::expect_error<DataError>([&] { kind("a.pdf", "%PDF-1.7"); }, folder.file("a.pdf"),
                                   "a PDF document", "numbers");
}

TEST(RowBlocks, SayWhatCannotBeReadInPieces) {
  const TemporaryFolder folder;
  const auto refused = [&](const std::string& name, const std::string& bytes,
                           const std::string& remedy) {
    const std::string path = folder.write(name, bytes);
    testing::expect_error<DataError>(
        [&] { row_blocks(std::make_unique<OpenedFile>(path), 1U << 24U); }, path,
        "cannot be read in pieces", remedy + ", or leave out --memory");
  };
  refused("a.npz", "PK\x03\x04", "one .npy array");
  refused("a.npy.gz", gzip("\x93NUMPY"), "unpack it and give its name");
  refused("a.h5.gz", gzip("\x89HDF\r\n\x1a\n"), "unpack it and give its name");
  std::string mat(128, ' ');
  mat.replace(124, 4, std::string_view("\0\1IM", 4));
  refused("a.mat", mat, "save it with '-v7.3'");
}

/// A workbook of one sheet "S" with a table of two columns.
std::string workbook() {
  return testing::zip_archive(
      {{"xl/workbook.xml",
        "<workbook xmlns:r=\"r\"><sheets><sheet name=\"S\" r:id=\"rId1\"/></sheets></workbook>"},
       {"xl/_rels/workbook.xml.rels",
        "<Relationships><Relationship Id=\"rId1\" Target=\"worksheets/a.xml\"/></Relationships>"},
       {"xl/worksheets/a.xml",
        "<worksheet><sheetData><row><c><v>0</v></c><c><v>1</v></c></row>"
        "<row><c><v>0.5</v></c><c><v>2</v></c></row></sheetData></worksheet>"}});
}

TEST(RowBlocks, AWorkbookIsOneBlockWhereTheMemoryHoldsIt) {
  const TemporaryFolder folder;
  const std::string path = folder.write("a.xlsx", workbook());
  for (const std::string& name : {path, path + "#S"}) {
    const auto rows = row_blocks(std::make_unique<OpenedFile>(name), 1U << 24U);
    Table block = rows->columns();
    EXPECT_EQ(block.columns.size(), 2u);
    ASSERT_TRUE(rows->next(block));
    EXPECT_EQ(block.values, (Matrix{{0.0, 1.0}, {0.5, 2.0}}));
    EXPECT_FALSE(rows->next(block));
  }
  testing::expect_error<DataError>(
      [&] { row_blocks(std::make_unique<OpenedFile>(path), 64U); }, path, "so large a workbook",
      "raise --memory");
  testing::expect_error<DataError>(
      [&] { OpenedFile(folder.write("a.csv", "t,x\n0,1\n") + "#S"); }, folder.file("a.csv#S"),
      "only workbooks have sheets", "'#S'");
}

TEST(RowBlocks, TextInUtf16ComesInBlocks) {
  const TemporaryFolder folder;
  std::string text = "\xFF\xFE";
  constexpr int kRows = 200000;
  for (int i = 0; i < kRows; ++i)
    for (const char byte : std::to_string(i) + ",1\n") text += {byte, '\0'};
  const auto rows =
      row_blocks(std::make_unique<OpenedFile>(folder.write("a.txt", text)), 1U << 21U);
  Table block = rows->columns();
  Index count = 0;
  double last = -1.0;
  while (rows->next(block)) {
    count += block.values.rows();
    if (block.values.rows() > 0) last = block.values(block.values.rows() - 1, 0);
  }
  EXPECT_EQ(count, kRows);
  EXPECT_EQ(last, kRows - 1.0);
}

/// Channels whose times differ in a later block.
TEST(RowBlocks, TimesOfChannelsThatDifferAreNoBlocks) {
  const TemporaryFolder folder;
  std::string same = "Time;x;Time;y\n", other;
  for (int i = 0; i < 200000; ++i) {
    const std::string t = std::to_string(i);
    same += t + ";1;" + t + ";2\n";
  }
  other = same + "200000;1;200001;2\n";
  const auto count_of = [&](const std::string& text) {
    const auto rows =
        row_blocks(std::make_unique<OpenedFile>(folder.write("a.csv", text)), 1U << 21U);
    Table block = rows->columns();
    EXPECT_EQ(block.columns.size(), 3u);
    Index count = 0;
    while (rows->next(block)) count += block.values.rows();
    return count;
  };
  EXPECT_EQ(count_of(same), 200000);
  testing::expect_error<DataError>([&] { count_of(other); }, folder.file("a.csv"),
                                   "times of their own", "leave out --memory");
}

}  // namespace
}  // namespace lacuna
