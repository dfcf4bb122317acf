// SPDX-License-Identifier: MIT
#include "regression/formulations/projected_rows.hpp"

#include <gtest/gtest.h>

#include "lacuna/core/base/error.hpp"
#include "support/oscillation.hpp"

namespace lacuna {
namespace {

TermLibrary projected_library(const std::vector<std::string>& texts) {
  TermLibrary library{{{"x", "v"}, {"u"}}, {}};
  for (const std::string& text : texts)
    library.terms.push_back(Term::parse(text, library.variables));
  return library;
}

std::vector<Projection> project(const std::vector<Trajectory>& records) {
  std::vector<Projection> projections;
  for (const Trajectory& record : records)
    projections.push_back(weak_projection(record, {0.1, 4}, 0.02));
  return projections;
}

std::pair<Matrix, Matrix> read_all(const RowSource& rows) {
  std::pair<Matrix, Matrix> all{Matrix(rows.rows(), rows.terms()),
                                Matrix(rows.rows(), rows.targets())};
  rows.open()->read(0, all.first, all.second);
  return all;
}

// Over many blocks too, whose borders leave nothing out: L as if the record were one dense
// block.
TEST(ProjectedRows, AreWhitenedProjections) {
  const std::vector<Trajectory> records = {oscillation(1500)};
  const auto projections = project(records);
  const ProjectedRows rows(projected_library({"v"}), records, projections);
  const auto [theta, targets] = read_all(rows);
  ASSERT_GT(rows.rows(), 500);
  const Matrix covariance = projections[0].rates * SparseRows(projections[0].rates.transpose());
  const Matrix factor = covariance.llt().matrixL();
  EXPECT_LT((factor * targets - projections[0].rates * records[0].states).norm(), 1e-6);
  EXPECT_LT((factor * theta - projections[0].values * records[0].states.col(1)).norm(), 1e-6);
}

TEST(ProjectedRows, SeveralRecordsAndBlocksAreReadFromAnywhere) {
  const std::vector<Trajectory> records = {oscillation(600), oscillation(10),
                                           oscillation(300, 2.0)};
  const ProjectedRows rows(projected_library({"v", "x*u"}), records, project(records));
  EXPECT_GT(rows.rows(), 256);
  const auto [theta, targets] = read_all(rows);
  const auto reader = rows.open();
  for (const Index first : {Index{0}, Index{120}, Index{250}, rows.rows() - 9}) {
    Matrix some(9, 2), values(9, 2);
    reader->read(first, some, values);
    EXPECT_EQ(some, theta.middleRows(first, 9));
    EXPECT_EQ(values, targets.middleRows(first, 9));
  }
}

TEST(ProjectedRows, GivenDerivativesAreProjectedAsTheyAre) {
  std::vector<Trajectory> records = {oscillation(100)};
  give_derivatives(records[0]);
  records[0].derivatives *= 3.0;
  const ProjectedRows rows(projected_library({"v"}), records, project(records));
  const auto [theta, targets] = read_all(rows);
  EXPECT_LT((targets.col(0) - 3.0 * theta.col(0)).norm(), 1e-14);
}

TEST(ProjectedRows, DelayedTermsLeaveOutTheBeginning) {
  const std::vector<Trajectory> records = {oscillation(200)};
  const auto projections = project(records);
  const ProjectedRows all(projected_library({"v"}), records, projections);
  const ProjectedRows later(projected_library({"delay(v,0.5)"}), records, projections);
  EXPECT_EQ(later.rows(), all.rows() - 25);
}

TEST(ProjectedRows, RefuseRecordsThatAreTooShort) {
  const std::vector<Trajectory> records = {oscillation(10)};
  EXPECT_THROW(ProjectedRows(projected_library({"v"}), records, project(records)), DataError);
}

}  // namespace
}  // namespace lacuna
