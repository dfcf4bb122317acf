// SPDX-License-Identifier: MIT
#include "data/formats/named_arrays.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lacuna/core/base/error.hpp"

namespace lacuna {
namespace {

std::vector<std::string> array_names(const Table& table) {
  std::vector<std::string> names;
  for (const Quantity& column : table.columns) names.push_back(column.name);
  return names;
}

TEST(NamedArrays, RowsAndColumnsAreVectors) {
  const Vector t = Vector::LinSpaced(5, 0.0, 1.0);
  const Table table =
      table_of_arrays({{"t", t.transpose()}, {"x", 2.0 * t}, {"n", Matrix::Ones(1, 1)}}, "run");
  EXPECT_THAT(array_names(table), ::testing::ElementsAre("t", "x"));
  EXPECT_EQ(table.values.col(0), t);
  EXPECT_EQ(table.values.col(1), 2.0 * t);
  EXPECT_THAT(table.notes.at(0), ::testing::HasSubstr("'n' has 1 x 1 values, not 5 samples"));
}

TEST(NamedArrays, AMatrixHasItsSamplesWhereTheyFit) {
  const Vector t = Vector::LinSpaced(5, 0.0, 1.0);
  const Matrix x = Matrix::Random(5, 2), y = Matrix::Random(2, 5);
  const Table table = table_of_arrays({{"t", t}, {"x", x}, {"y", y}}, "run");
  EXPECT_THAT(array_names(table), ::testing::ElementsAre("t", "x1", "x2", "y1", "y2"));
  EXPECT_EQ(table.values.middleCols(1, 2), x);
  EXPECT_EQ(table.values.rightCols(2), y.transpose());
}

TEST(NamedArrays, WithoutVectorsRowsAreSamples) {
  const Matrix x = Matrix::Random(4, 6), y = Matrix::Random(4, 1);
  EXPECT_EQ(table_of_arrays({{"x", x}}, "run").values, x);
  EXPECT_EQ(table_of_arrays({{"x", x}, {"y", y}}, "run").values.rows(), 4);
}

TEST(NamedArrays, WhatAllNamesBeginWithIsLeftOut) {
  const Vector v = Vector::LinSpaced(3, 0.0, 1.0);
  EXPECT_THAT(array_names(table_of_arrays({{"a.run.t", v}, {"a.run.x", v}}, "f")),
              ::testing::ElementsAre("t", "x"));
  EXPECT_THAT(array_names(table_of_arrays({{"a.run.t", v}, {"a.x", v}}, "f")),
              ::testing::ElementsAre("run_t", "x"));
  EXPECT_THAT(array_names(table_of_arrays({{"at", v}, {"ax", v}}, "f")),
              ::testing::ElementsAre("at", "ax"));
}

TEST(NamedArrays, ArePutInTheirPlaces) {
  const ArrayTable all =
      arrange_arrays({{"t", 5, 1}, {"none", 0, 5}, {"y", 2, 5}, {"n", 3, 3}}, "run");
  EXPECT_EQ(all.samples, 5);
  EXPECT_EQ(all.table.columns.size(), 3u);
  ASSERT_EQ(all.places.size(), 2u);
  EXPECT_FALSE(all.places[0].in_columns);
  EXPECT_EQ(all.places[1].array, 2u);
  EXPECT_TRUE(all.places[1].in_columns);
  EXPECT_EQ(all.places[1].first_column, 1);
  EXPECT_EQ(all.places[1].columns, 2);
}

TEST(NamedArrays, NothingIsAnError) {
  EXPECT_THROW(table_of_arrays({}, "run"), DataError);
  EXPECT_THROW(table_of_arrays({{"x", Matrix(0, 3)}}, "run"), DataError);
}

}  // namespace
}  // namespace lacuna
