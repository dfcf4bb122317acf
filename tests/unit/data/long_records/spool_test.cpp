// SPDX-License-Identifier: MIT
#include "data/long_records/spool.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>
#include <thread>

#include "core/base/text.hpp"
#include "core/files/file_bytes.hpp"
#include "data/formats/npy.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/data/formats/read.hpp"
#include "support/disk_limits.hpp"
#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"

namespace lacuna {
namespace {

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

}  // namespace
}  // namespace lacuna
