// SPDX-License-Identifier: MIT
#include "data/formats/row_blocks.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/random.hpp"
#include "core/base/text.hpp"
#include "core/files/file_bytes.hpp"
#include "data/formats/read_text.hpp"
#include "data/formats/text_rows.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/data/formats/read.hpp"
#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"
#include "support/written_arrays.hpp"

namespace lacuna {
namespace {

using ::testing::ElementsAre;
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

constexpr BlockSizes kSmall{1U << 16U, 1U << 20U};

/// Lines of three numbers in more than so many bytes, with a comment and an empty field.
std::string numbers(std::size_t bytes, const std::string& end) {
  Random random(7);
  std::string text = "preamble" + end + "t [s],x,y" + end;
  for (int i = 0; text.size() < bytes; ++i) {
    if (i == 5000) text += "# half past" + end + end;
    text += format_number(0.01 * i) + "," + format_number(random.normal()) + "," +
            (i % 70000 == 999 ? "" : format_number(random.normal())) + end;
  }
  return text;
}

/// What comes in blocks, as one table, and how many there are.
Table joined(RowBlocks& blocks, int& count) {
  Table all = blocks.columns(), block = blocks.columns();
  all.values.resize(0, static_cast<Index>(all.columns.size()));
  for (count = 0; blocks.next(block); ++count) {
    const Index before = all.values.rows();
    all.values.conservativeResize(before + block.values.rows(), Eigen::NoChange);
    all.values.bottomRows(block.values.rows()) = block.values;
    all.lines.insert(all.lines.end(), block.lines.begin(), block.lines.end());
  }
  return all;
}

void expect_as_from_memory(const std::string& path, int least) {
  int count = 0;
  const auto blocks = text_blocks(std::make_unique<OpenedFile>(path), kSmall);
  const Table table = joined(*blocks, count), expected = read_table(path);
  EXPECT_GE(count, least) << path;
  const auto bits = [](const Matrix& values) {
    return std::string(reinterpret_cast<const char*>(values.data()),
                       static_cast<std::size_t>(values.size()) * sizeof(double));
  };
  EXPECT_TRUE(bits(table.values) == bits(expected.values)) << path;
  EXPECT_EQ(table.lines, expected.lines) << path;
  EXPECT_EQ(table.notes, expected.notes) << path;
  EXPECT_EQ(table.source, expected.source);
}

TEST(TextBlocks, AreWhatTheWholeTextIs) {
  const TemporaryFolder folder;
  for (const std::string end : {"\n", "\r\n", "\r"}) {
    const std::string text = numbers(2500000, end);
    expect_as_from_memory(folder.write("a.csv", text), 10);
    expect_as_from_memory(folder.write("open.csv", text.substr(0, text.size() - 3)), 10);
    expect_as_from_memory(folder.write("a.csv.gz", gzip(text)), 10);
  }
  std::string even = numbers(1000000, "\n") + "#";
  even.resize((1U << 20U) - 1, '-');  // ends where the begin that is looked at does
  expect_as_from_memory(folder.write("even.csv", even + "\n"), 1);
  expect_as_from_memory(folder.write("short.csv", "t,x\n0,1\n1,2\n"), 1);
}

TEST(TextBlocks, APreambleMayBeLong) {
  const TemporaryFolder folder;
  std::string text;
  for (int i = 0; text.size() < 1100000; ++i)
    text += "prose of line " + std::to_string(i) + "\n";
  const std::string path = folder.write("a.csv", text + numbers(300000, "\n"));
  const BlockSizes sizes{1U << 16U, 1U << 22U};
  const auto blocks = text_blocks(std::make_unique<OpenedFile>(path), sizes);
  EXPECT_EQ(blocks->columns().notes, read_table(path).notes);
}

TEST(TextBlocks, ErrorsAreThoseOfTheWholeText) {
  const TemporaryFolder folder;
  const std::string good = numbers(1500000, "\n");
  for (const std::string bad : {"1,2,x\n", "1,2\n", "1,2,3,4\n"}) {
    const std::string path = folder.write("a.csv", good + bad + good.substr(20));
    std::string expected;
    try {
      read_table(path);
    } catch (const DataError& error) {
      expected = error.what();
    }
    ASSERT_NE(expected, "");
    try {
      int count = 0;
      joined(*text_blocks(std::make_unique<OpenedFile>(path), kSmall), count);
      ADD_FAILURE() << bad;
    } catch (const DataError& error) {
      EXPECT_EQ(error.what(), expected);
    }
  }
}

TEST(TextBlocks, ALineHasAnEnd) {
  const TemporaryFolder folder;
  const std::string line = "t,x\n0,1\n1,2\n2,3\n3," + std::string(3000000, '1');
  const std::string path = folder.write("a.csv", line);
  int count = 0;
  testing::expect_error<DataError>(
      [&] { joined(*text_blocks(std::make_unique<OpenedFile>(path), kSmall), count); }, path,
      "more than 1024 kB", "raise --memory");
}

/// Rows of texts that follow each other.
Table rows_of(const std::vector<std::string>& blocks) {
  std::string text;
  for (const std::string& block : blocks) text += block;
  TextRows rows(*find_format(text, true, "a.csv"), "a.csv");
  Table all = rows.columns();
  all.values.resize(0, static_cast<Index>(all.columns.size()));
  for (const std::string& block : blocks) {
    Table table = rows.columns();
    rows.read(block, table);
    const Index before = all.values.rows();
    all.values.conservativeResize(before + table.values.rows(), Eigen::NoChange);
    all.values.bottomRows(table.values.rows()) = table.values;
    all.lines.insert(all.lines.end(), table.lines.begin(), table.lines.end());
  }
  rows.finish();
  return all;
}

void expect_same(const Table& table, const Table& expected) {
  EXPECT_EQ(table.values, expected.values);
  EXPECT_EQ(table.lines, expected.lines);
  EXPECT_EQ(table.notes, expected.notes);
  EXPECT_EQ(table.headers, expected.headers);
  EXPECT_EQ(table.run_column, expected.run_column);
}

TEST(TextRows, DialectsGoOnFromBlockToBlock) {
  const std::vector<std::vector<std::string>> texts = {
      {"time,x\n23:59:59.9,1\n", "00:00:00.1,2\n", "00:00:00.3,3\n"},
      {"X,CH1,Start,Increment,\nSequence,Volt,0,0.5,\n0,1,,\n", "1,2,,\n2,3,,\n"},
      {"time\tV(a)\nStep Information: R=1 (Step: 1/2)\n0\t1\n", "1e-3\t2\n2e-3\t2.5\n",
       "Step Information: R=2 (Step: 2/2)\n0\t3\n1e-3\t4\n"},
      {" 0.5 1.0 0.5 5.0\n", " 0.6 2.0 0.6 6.0\n 0.7 3.0 0.7 7.0\n"},
      {"Title: * rc\nNo. Variables: 2\nVariables:\n\t0\ttime\ttime\n\t1\tv(out)\tvoltage\n"
       "Values:\n 0\t0.0\n",
       "\t1.5\n\n 1\t0.1\n", "\t2.5\n"}};
  for (const auto& blocks : texts) {
    std::string text;
    for (const std::string& block : blocks) text += block;
    expect_same(rows_of(blocks), parse_text_table(text, "a.csv"));
  }
}

TEST(TextRows, LinesOfAFileCountWhereADialectHasPutNamesInFront) {
  const std::string text = " 0.5 1.0 0.5 5.0\n 0.6 2.0 0.6 6.0\n";
  EXPECT_THAT(parse_text_table(text, "a").lines, ElementsAre(1, 2));
  testing::expect_error<DataError>(
      [] {
        TextRows rows(*find_format("0 1 0 2\n1 1 1 2\n", true, "a"), "a");
        Table table = rows.columns();
        rows.read("0 1 0 2\n1 1 1 2\n", table);
        rows.read("2 1 2 x\n", table);
        rows.finish();
      },
      "a:3:3", "'x' in column 'c4'", "number");
}

}  // namespace
}  // namespace lacuna
