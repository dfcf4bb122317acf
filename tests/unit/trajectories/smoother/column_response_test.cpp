// SPDX-License-Identifier: MIT
// Responses of the innovations against the filter run again on a record with the term in it.
#include <gtest/gtest.h>

#include "lacuna/core/base/error.hpp"
#include "support/joint_gaussian.hpp"

namespace lacuna {
namespace {

using support::GaussianCase;

/// Of so many states, the first not measured, the last with coloured noise; of an even number
/// of states with white noise only.
GaussianCase case_of(Index m) {
  GaussianCase made = support::random_case(m, 20, 9);
  if (m > 1) made.noise.measurement[0].reset();
  if (m % 2 == 1)
    made.noise.coloured[static_cast<std::size_t>(m - 1)] = ColouredNoise{0.3, 0.25};
  made.omitted = Matrix::Zero(20, m);
  made.omitted(5, m - 1) = 1.0;
  return made;
}

InnovationFilter filtered(const GaussianCase& made, const Matrix& measured) {
  return run_filter(made.record, measured, made.omitted, made.noise);
}

/// What a rate in an equation adds to the states: d+ = Phi d + w0 g + w1 g(mid) + w2 g+.
Matrix moved_by(const GaussianCase& made, Index equation, const Vector& rate) {
  const LinearisedRecord& record = made.record;
  const Index m = record.states();
  Matrix moved = Matrix::Zero(record.samples(), m);
  for (Index i = 0; i < record.steps(); ++i) {
    const Eigen::Map<const Matrix> phi(record.transition.col(i).data(), m, m);
    const Eigen::Map<const Matrix> w(record.response.col(i).data() + 3 * m * equation, m, 3);
    moved.row(i + 1) =
        (phi * moved.row(i).transpose() + w * rate.segment(2 * i, 3)).transpose();
  }
  return moved;
}

TEST(ColumnResponse, IsWhatATermInTheRecordDoesToTheInnovations) {
  for (const Index m : {1, 2, 3, 4, 8, 9, 10}) {
    const GaussianCase made = case_of(m);
    const InnovationFilter filter = filtered(made, made.measured);
    Random random(1);
    for (const Index count : {1, 2, 3, 9, 10}) {
      const Matrix values = support::random_matrix(random, 39, count, 1.0);
      Matrix columns(filter.channels * 20, count);
      column_response(made.record, filter, m - 1, values, columns);
      for (Index c = 0; c < count; ++c) {
        const Matrix with = made.measured + moved_by(made, m - 1, values.col(c));
        const Vector expected =
            (filtered(made, with).innovations - filter.innovations).reshaped();
        EXPECT_LT((columns.col(c) - expected).norm(), 1e-9) << m << " states, column " << c;
      }
    }
  }
}

TEST(ChannelResponse, IsWhatAnAdditionToTheMeasurementDoes) {
  for (const Index m : {1, 2, 3, 4, 8, 9, 10}) {
    const GaussianCase made = case_of(m);
    const InnovationFilter filter = filtered(made, made.measured);
    Random random(2);
    const Matrix values = support::random_matrix(random, 20, 3, 1.0);
    Matrix columns(filter.channels * 20, 3);
    channel_response(made.record, filter, m - 1, values, columns);
    for (Index c = 0; c < 3; ++c) {
      Matrix with = made.measured;
      with.col(m - 1) += values.col(c);
      const Vector expected =
          (filtered(made, with).innovations - filter.innovations).reshaped();
      EXPECT_LT((columns.col(c) - expected).norm(), 1e-9) << m << " states, column " << c;
    }
  }
}

TEST(ColumnResponse, RejectsWhatDoesNotFitTheRecord) {
  const GaussianCase made = case_of(2);
  const InnovationFilter filter = filtered(made, made.measured);
  Matrix out(filter.channels * 20, 1), narrow(filter.channels * 20, 2);
  EXPECT_THROW(column_response(made.record, filter, 0, Matrix::Zero(20, 1), out),
               ArgumentError);
  EXPECT_THROW(channel_response(made.record, filter, 0, Matrix::Zero(39, 1), out),
               ArgumentError);
  EXPECT_THROW(column_response(made.record, filter, 0, Matrix::Zero(39, 1), narrow),
               ArgumentError);
}

}  // namespace
}  // namespace lacuna
