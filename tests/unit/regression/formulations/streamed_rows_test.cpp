// SPDX-License-Identifier: MIT
#include "regression/formulations/streamed_rows.hpp"

#include <gtest/gtest.h>

#include "lacuna/core/base/error.hpp"
#include "lacuna/data/derivatives/finite_differences.hpp"
#include "lacuna/data/derivatives/savitzky_golay.hpp"
#include "records/binding/derived_record.hpp"
#include "unit/data/long_records/long_records.hpp"

namespace lacuna {
namespace {

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
