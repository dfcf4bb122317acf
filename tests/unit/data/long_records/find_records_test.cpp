// SPDX-License-Identifier: MIT
#include "data/long_records/find_records.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "data/formats/npy.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/data/formats/read.hpp"
#include "support/temporary_folder.hpp"

namespace lacuna {
namespace {

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
