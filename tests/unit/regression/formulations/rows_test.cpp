// SPDX-License-Identifier: MIT
// Rows of a system, read in tiles from records.
#include <gtest/gtest.h>

#include <cmath>

#include "data/derivatives/finite_differences.hpp"
#include "data/derivatives/savitzky_golay.hpp"
#include "lacuna/core/base/error.hpp"
#include "records/binding/derived_record.hpp"
#include "regression/formulations/library_rows.hpp"
#include "regression/formulations/projected_rows.hpp"
#include "regression/formulations/streamed_rows.hpp"
#include "support/oscillation.hpp"
#include "unit/data/long_records/long_records.hpp"

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

TermLibrary swing_terms(const std::vector<std::string>& texts = {"1", "x", "v", "x*v"}) {
  TermLibrary library{{{"x", "v"}, {}}, {}};
  for (const std::string& text : texts)
    library.terms.push_back(Term::parse(text, library.variables));
  return library;
}

struct ReadRows {
  Matrix theta, targets;
};

ReadRows all_rows_of(const RowSource& rows, Index tile) {
  ReadRows all{Matrix(rows.rows(), rows.terms()), Matrix(rows.rows(), rows.targets())};
  const auto reader = rows.open();
  for (Index first = 0; first < rows.rows(); first += tile) {
    const Index count = std::min(tile, rows.rows() - first);
    reader->read(first, all.theta.middleRows(first, count),
                 all.targets.middleRows(first, count));
  }
  return all;
}

StreamedRows streamed(const Dataset& data, const Stage<Differentiator>& method,
                      const TermLibrary& library = swing_terms()) {
  std::vector<std::shared_ptr<const SampleSource>> records;
  for (const Trajectory& record : data.trajectories) records.push_back(source_of(record));
  return {library, records, {method, true}, data.has_derivatives()};
}

/// Of records that are differentiated as a whole.
ReadRows rows_of_whole(const Dataset& data, const Stage<Differentiator>& method) {
  std::vector<Trajectory> records;
  for (const Trajectory& record : data.trajectories)
    records.push_back(with_derivatives(record, *method, true));
  const LibraryRows rows(swing_terms(), records, data.has_derivatives() ? 0 : method->margin());
  return all_rows_of(rows, rows.rows());
}

TEST(StreamedRows, AreThoseOfWholeRecords) {
  Dataset data = testing::long_oscillation(20000, 97.3, 0.01);
  data.trajectories.push_back(rows_of(data.trajectories[0], 100, 9000));
  data.trajectories.push_back(rows_of(data.trajectories[0], 100, 30));
  for (const Stage<Differentiator>& method :
       {Stage<Differentiator>(FiniteDifferences{{.order = 8}}),
        Stage<Differentiator>(SavitzkyGolay{{.window = 11}})}) {
    const ReadRows expected = rows_of_whole(data, method);
    const ReadRows rows = all_rows_of(streamed(data, method), 256);
    ASSERT_EQ(rows.theta.rows(), expected.theta.rows());
    EXPECT_LT((rows.theta - expected.theta).cwiseAbs().maxCoeff(), 1e-12);
    EXPECT_LT((rows.targets - expected.targets).cwiseAbs().maxCoeff(), 1e-9);
  }
}

/// Pieces begin at row 2^13: a jump there shows in the last sample of the piece before.
TEST(StreamedRows, HeldInputsJumpWhereverPiecesBegin) {
  Dataset data = testing::long_oscillation(20000, 97.3, 0.01);
  Trajectory& record = data.trajectories[0];
  record.inputs = Matrix::Zero(record.samples(), 1);
  const FiniteDifferences method{{.order = 8}};
  const Index begin = (Index{1} << 13) + method.margin();
  for (const Index jump : {Index{5}, begin, Index{12345}})
    record.inputs.bottomRows(record.samples() - jump).array() += 2.0;
  TermLibrary library{{{"x", "v"}, {"u"}}, {}};
  library.terms = {Term::parse("u^2", library.variables), Term::parse("x", library.variables)};
  const LibraryRows whole(library, {with_derivatives(record, method, true)}, method.margin(),
                          {0});
  const StreamedRows streamed(library, {source_of(record)}, {method, true}, false, {0});
  ASSERT_EQ(streamed.rows(), whole.rows());
  const Matrix expected = all_rows_of(whole, whole.rows()).theta;
  EXPECT_EQ(expected(begin - method.margin(), 0), 10.0);  // the mean of 2^2 and 4^2
  EXPECT_LT((all_rows_of(streamed, 256).theta - expected).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(StreamedRows, GivenDerivativesAreTakenAsTheyAre) {
  Dataset data = testing::long_oscillation(20000, 97.3);
  data.trajectories[0].derivatives = 2.0 * data.trajectories[0].states;
  const Stage<Differentiator> method = FiniteDifferences{{.order = 8}};
  const ReadRows rows = all_rows_of(streamed(data, method), 100);
  EXPECT_EQ(rows.targets, data.trajectories[0].derivatives);
  EXPECT_EQ(rows.theta.col(1), data.trajectories[0].states.col(0));
  const StreamedRows read(swing_terms(), {thinned(source_of(data.trajectories[0]), 2)},
                          {method, true}, true);
  const auto even = Eigen::seq(0, Eigen::last, 2);
  const ReadRows in_pieces = all_rows_of(read, 100);
  EXPECT_EQ(in_pieces.targets, rows.targets(even, Eigen::all)) << "copied piece by piece";
  EXPECT_EQ(in_pieces.theta, rows.theta(even, Eigen::all));
}

TEST(StreamedRows, HaveNoPast) {
  const Dataset data = testing::long_oscillation(30000, 97.3);
  EXPECT_THROW(streamed(data, FiniteDifferences{{.order = 8}}, swing_terms({"delay(x,0.5)"})),
               ConfigError);
}

}  // namespace
}  // namespace lacuna
