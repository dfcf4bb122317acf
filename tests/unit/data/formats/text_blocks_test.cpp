// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "core/base/random.hpp"
#include "core/base/text.hpp"
#include "core/files/file_bytes.hpp"
#include "data/formats/row_blocks.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/data/formats/read.hpp"
#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"

namespace lacuna {
namespace {

using testing::TemporaryFolder;

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

}  // namespace
}  // namespace lacuna
