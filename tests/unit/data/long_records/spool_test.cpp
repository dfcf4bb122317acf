// SPDX-License-Identifier: MIT
#include "data/long_records/spool.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>
#include <limits>
#include <thread>

#include "core/base/random.hpp"
#include "core/base/text.hpp"
#include "core/files/file_bytes.hpp"
#include "data/formats/npy.hpp"
#include "data/long_records/find_records.hpp"
#include "data/long_records/line_numbers.hpp"
#include "data/long_records/npy_file.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/data/formats/read.hpp"
#include "support/disk_limits.hpp"
#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"
#include "unit/data/long_records/long_records.hpp"

namespace lacuna {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using testing::TemporaryFolder;

constexpr std::size_t kMemory = std::size_t{1} << 21U;  // blocks of 64 KiB

/// t, x, y in so many lines, with a comment in front of one of them.
std::string lines_of_numbers(int count) {
  std::string text = "t [s],x [V],y\n";
  for (int i = 0; i < count; ++i) {
    if (i == 30000) text += "# a comment\n";
    text += format_number(0.01 * i) + "," + format_number(std::sin(0.3 * i)) + ",-0\n";
  }
  return text;
}

void expect_rows_of(const std::string& path, Index least) {
  const NpyFile file = open_rows(path, kMemory, {});
  const Table table = read_table(path);
  ASSERT_EQ(file.rows(), table.values.rows());
  ASSERT_GE(file.rows(), least);
  EXPECT_EQ(file.values(0, file.rows()), table.values);
  EXPECT_EQ(file.lines(0, file.rows()), table.lines);
  EXPECT_EQ(file.columns().source, path);
  EXPECT_EQ(file.columns().headers, table.headers);
  EXPECT_EQ(file.columns().columns[1].unit, table.columns[1].unit);
}

TEST(Spool, RowsAreThoseOfTheFileAndNothingIsLeft) {
  const TemporaryFolder folder, temporary;
  const testing::TemporaryFilesIn there(temporary.path());
  const std::string text = lines_of_numbers(100000);
  expect_rows_of(folder.write("a.csv", text), 100000);
  expect_rows_of(folder.write("a.csv.gz", gzip(text)), 100000);
  expect_rows_of(folder.write("short.csv", "t,x\n0,1\n1,2\n"), 2);
  EXPECT_EQ(temporary.count(), 0);
}

TEST(Spool, ArraysAreReadWhereTheyAreUnlessTheyArePacked) {
  const TemporaryFolder folder, temporary;
  write_npy(folder.file("a.npy"), Matrix::Random(200000, 3));
  const std::string bytes = folder.read("a.npy");
  const testing::TemporaryFilesIn nowhere(temporary.file("none"));
  const Matrix expected = open_rows(folder.file("a.npy"), kMemory, {}).values(0, 200000);
  const std::string packed = folder.write("b.npy.gz", gzip(bytes));
  EXPECT_THROW(open_rows(packed, kMemory, {}), FileError);
  const testing::TemporaryFilesIn there(temporary.path());
  const NpyFile file = open_rows(packed, kMemory, {});
  EXPECT_EQ(file.values(0, 200000), expected);
  EXPECT_EQ(file.columns().source, packed);
  const std::string cut = folder.write("cut.npy.gz", gzip(bytes.substr(0, 3000000)));
  testing::expect_error<DataError>([&] { open_rows(cut, kMemory, {}); }, cut, "cut short", "");
}

TEST(Spool, APipeIsReadOnce) {
  const TemporaryFolder folder;
  const std::string path = folder.file("pipe"), text = lines_of_numbers(60000);
  ASSERT_EQ(mkfifo(path.c_str(), 0600), 0);
  std::thread writer([&] { std::ofstream(path) << text; });
  const NpyFile file = open_rows(path, kMemory, {});
  writer.join();
  EXPECT_EQ(file.rows(), 60000);
}

TEST(Spool, WithoutRoomItSaysHowMuchIsNeededAndWhatToDo) {
  const TemporaryFolder folder, temporary;
  const testing::TemporaryFilesIn there(temporary.path());
  const std::string text = lines_of_numbers(200000);  // 4.6 MiB as numbers
  const std::string path = folder.write("a.csv", text);
  const std::string packed = folder.write("a.csv.gz", gzip(text));
  const testing::FileSizeLimit limit(2000000);
  for (const std::string& file : {path, packed}) try {
      open_rows(file, kMemory, {});
      ADD_FAILURE() << file;
    } catch (const FileError& error) {
      EXPECT_EQ(error.where(), temporary.path());
      EXPECT_THAT(error.problem(), ::testing::HasSubstr("the numbers of " + file + ": they"));
      EXPECT_THAT(error.problem(),
                  ::testing::MatchesRegex(".*take about [456] MB, and 2 MB.*"));
      EXPECT_THAT(error.remedy(), ::testing::HasSubstr("set TMPDIR"));
    }
  EXPECT_EQ(temporary.count(), 0);
}

TEST(Spool, StopsBetweenBlocks) {
  const TemporaryFolder folder;
  const std::string path = folder.write("a.csv", lines_of_numbers(200000));
  std::stop_source stop;
  int reports = 0;
  RunContext context;
  context.stop = stop.get_token();
  context.progress = [&](const Progress& progress) {
    EXPECT_EQ(progress.activity, "reading data");
    if (++reports == 3) stop.request_stop();
  };
  EXPECT_THROW(open_rows(path, kMemory, context), Cancelled);
  EXPECT_EQ(reports, 3);
}

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

TEST(LineNumbers, AreThoseThatWereGiven) {
  Random random(2);
  std::vector<std::size_t> lines{3};
  while (lines.size() < 2000)
    lines.push_back(lines.back() + 1 + (random.normal() > 1.0 ? 2U : 0U));
  LineNumbers numbers;
  const std::span<const std::size_t> all(lines);
  numbers.append(all.first(700));
  numbers.append(all.subspan(700));
  for (const Index first : {0, 1, 699, 1500}) {
    const auto expected = all.subspan(static_cast<std::size_t>(first), 500);
    EXPECT_THAT(numbers.of(first, 500), ::testing::ElementsAreArray(expected)) << first;
  }
  EXPECT_THAT(numbers.of(1999, 1), ElementsAre(lines.back()));
}

TEST(LineNumbers, OfEveryThirdLineAreAllKnown) {
  LineNumbers numbers;
  std::vector<std::size_t> lines(2 * LineNumbers::kMost);
  for (std::size_t i = 0; i < lines.size(); ++i) lines[i] = 3 * i + 5;
  numbers.append(lines);
  EXPECT_THAT(numbers.of(static_cast<Index>(lines.size()) - 1, 1), ElementsAre(lines.back()));
}

TEST(LineNumbers, TakeABoundedMemory) {
  LineNumbers numbers;
  std::vector<std::size_t> lines;
  for (std::size_t i = 0; i < 4 * LineNumbers::kMost; ++i) lines.push_back(i * i);
  numbers.append(lines);
  EXPECT_THAT(numbers.of(100, 2), ElementsAre(10000, 10201));
  EXPECT_THAT(numbers.of(static_cast<Index>(lines.size()) - 1, 1), IsEmpty());
}

constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();

/// t = 0, 0.1, ... and x = t^2 in more than two pieces of a file.
Matrix even_samples(Index rows = 300000) {
  Matrix values(rows, 2);
  values.col(0) = Vector::LinSpaced(rows, 0.0, 0.1 * static_cast<double>(rows - 1));
  values.col(1) = values.col(0).cwiseAbs2();
  return values;
}

/// What the pieces say and what the table as a whole says.
void expect_same_ranges(const Matrix& values, ColumnIndices columns, std::size_t count) {
  const testing::TemporaryFolder folder;
  write_npy(folder.file("a.npy"), values);
  const NpyFile file(folder.file("a.npy"));
  RunContext two;
  two.threads = 2;
  const Records found = find_records(file, columns, two);
  const Records expected = split_records(read_table(folder.file("a.npy")), columns);
  ASSERT_EQ(expected.ranges.size(), count);
  ASSERT_EQ(found.ranges.size(), count);
  for (std::size_t i = 0; i < count; ++i) {
    EXPECT_EQ(found.ranges[i].first, expected.ranges[i].first);
    EXPECT_EQ(found.ranges[i].count, expected.ranges[i].count);
  }
}

ColumnIndices time_and_state() {
  ColumnIndices columns;
  columns.time = 0;
  columns.states = {1};
  return columns;
}

TEST(FindRecords, EndWhereValuesOrTimesAreMissingAsInTheWholeTable) {
  expect_same_ranges(even_samples(), time_and_state(), 1);
  expect_same_ranges(even_samples(131073), time_and_state(), 1);  // a piece of one row is none
  Matrix values = even_samples();
  for (const Index row : {500, 131071, 131072, 262144}) values(row, 1) = kMissing;
  expect_same_ranges(values, time_and_state(), 4);
  values = even_samples(500000);  // a dropout of more than a piece
  values.col(1).segment(100000, 300000).setConstant(kMissing);
  expect_same_ranges(values, time_and_state(), 2);
  for (const Index row : {131071, 131072, 131073}) {
    values = even_samples();
    values.col(0).tail(values.rows() - row).array() += 7.0;
    expect_same_ranges(values, time_and_state(), 2);
  }
}

TEST(FindRecords, EndsWhereTheNumberOfTheRecordChanges) {
  Matrix values = even_samples();
  values.col(1).tail(100000).setConstant(4.0);
  values.col(1).head(200000).setConstant(3.0);
  ColumnIndices columns = time_and_state();
  columns.trajectory = 1;
  columns.states = {};
  expect_same_ranges(values, columns, 2);
}

TEST(FindRecords, OfNoValuesOrInfiniteOnesAreErrors) {
  const testing::TemporaryFolder folder;
  Matrix missing = even_samples(), infinite = missing;
  missing.col(1).setConstant(kMissing);
  infinite(200000, 1) = std::numeric_limits<double>::infinity();
  for (const Matrix& values : {missing, infinite}) {
    write_npy(folder.file("a.npy"), values);
    EXPECT_THROW(find_records(NpyFile(folder.file("a.npy")), time_and_state(), {}), DataError);
  }
}

}  // namespace
}  // namespace lacuna
