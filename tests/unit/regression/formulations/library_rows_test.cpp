// SPDX-License-Identifier: MIT
#include "regression/formulations/library_rows.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "lacuna/core/base/error.hpp"
#include "support/oscillation.hpp"

namespace lacuna {
namespace {

TermLibrary library_of(const std::vector<std::string>& texts) {
  TermLibrary library{{{"x", "v"}, {"u"}}, {}};
  for (const std::string& text : texts)
    library.terms.push_back(Term::parse(text, library.variables));
  return library;
}

Trajectory record_with_derivatives(Index n, double start = 0.0) {
  Trajectory record = oscillation(n, start);
  give_derivatives(record);
  return record;
}

struct Tile {
  Matrix theta, targets;
};

Tile read(const LibraryRows& rows, Index first, Index count) {
  Tile tile{Matrix(count, rows.terms()), Matrix(count, rows.targets())};
  rows.open()->read(first, tile.theta, tile.targets);
  return tile;
}

TEST(LibraryRows, TilesRunAcrossRecords) {
  const LibraryRows rows(library_of({"x", "t"}),
                         {record_with_derivatives(10), record_with_derivatives(3, 5.0),
                          record_with_derivatives(20, 9.0)});
  ASSERT_EQ(rows.rows(), 33);
  const Tile all = read(rows, 0, 33);
  for (const Index first : {0, 7, 9, 10, 12, 13, 25}) {
    const Tile part = read(rows, first, 33 - first - 1);
    EXPECT_EQ(part.theta, all.theta.middleRows(first, 33 - first - 1)) << first;
    EXPECT_EQ(part.targets, all.targets.middleRows(first, 33 - first - 1)) << first;
  }
  EXPECT_DOUBLE_EQ(all.theta(10, 1), 5.0);
  EXPECT_DOUBLE_EQ(all.theta(13, 1), 9.0);
}

TEST(LibraryRows, DelaysLookBackAndLoseTheirFirstRows) {
  const LibraryRows rows(library_of({"delay(x,0.105)", "t", "delay(x,0.05)"}),
                         {record_with_derivatives(100), record_with_derivatives(50, 3.0)});
  ASSERT_EQ(rows.rows(), 150 - 2 * 11);
  const Tile all = read(rows, 0, rows.rows());
  EXPECT_NEAR(all.theta(0, 1), 0.11, 1e-12);
  for (Index i = 0; i < rows.rows(); ++i) {
    const double t = all.theta(i, 1);
    EXPECT_NEAR(all.theta(i, 0), std::sin(2.0 * (t - 0.105)), 1e-7);
    EXPECT_NEAR(all.theta(i, 2), std::sin(2.0 * (t - 0.05)), 1e-12);
  }
}

TEST(LibraryRows, RecordsShorterThanTheDelayAreLeftOut) {
  const LibraryRows rows(library_of({"delay(x,0.5)"}),
                         {record_with_derivatives(10), record_with_derivatives(100)});
  EXPECT_EQ(rows.rows(), 50);
  EXPECT_THROW(LibraryRows(library_of({"delay(x,0.5)"}), {record_with_derivatives(10)}),
               DataError);
}

TEST(LibraryRows, FindTheEntryThatIsNotFinite) {
  const LibraryRows rows(library_of({"x", "v/x"}),
                         {record_with_derivatives(600, 0.01), record_with_derivatives(5)});
  const auto entry = rows.find_non_finite();
  ASSERT_TRUE(entry);
  EXPECT_EQ(entry->term, rows.terms() == 2 ? library_of({"v/x"}).terms[0].name() : "");
  EXPECT_EQ(entry->sample, 0);
  EXPECT_EQ(entry->time, 0.0);
  EXPECT_EQ(entry->values, "v = 2, x = 0");
}

/// Where a held input jumps a row is the mean of both limits, in whatever tile it is read.
TEST(LibraryRows, HeldInputsJump) {
  Trajectory record = record_with_derivatives(30);
  record.inputs.col(0).setConstant(1.0);
  record.inputs.col(0).tail(12).setConstant(4.0);
  const TermLibrary library = library_of({"u^2", "x"});
  const LibraryRows held(library, {record}, 0, {0}), smooth(library, {record});
  Matrix expected = read(smooth, 0, 30).theta;
  EXPECT_EQ(expected(18, 0), 16.0);
  expected(18, 0) = 8.5;
  EXPECT_EQ(read(held, 0, 30).theta, expected);
  EXPECT_EQ(read(held, 17, 3).theta, expected.middleRows(17, 3));
  EXPECT_EQ(read(held, 18, 1).theta, expected.middleRows(18, 1));
}

}  // namespace
}  // namespace lacuna
