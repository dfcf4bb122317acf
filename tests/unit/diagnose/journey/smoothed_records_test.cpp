// SPDX-License-Identifier: MIT
#include "diagnose/journey/smoothed_records.hpp"

#include <gtest/gtest.h>

#include "lacuna/data/records/marks.hpp"
#include "support/asked.hpp"

namespace lacuna {
namespace {

using Kind = SmoothingFilter::Kind;

/// The driven oscillator's record with its columns smoothed.
support::Asked smoothed_by(const Smoothing& smoothing) {
  Dataset data = support::hidden_record(support::nothing, 0.01);
  for (Trajectory& record : data.trajectories) {
    record.states = smoothed(smoothing.filter, record.states);
    if (smoothing.of_inputs) record.inputs = smoothed(smoothing.filter, record.inputs);
  }
  return {.records = observed(data)};
}

TEST(SmoothedRecords, TheModelTellsWhatTheNoiseDoesNotShow) {
  for (const Smoothing& made : {Smoothing{{Kind::CentredMean, 9}},
                                {{Kind::CentredMean, 35}, true},
                                {{Kind::PastMean, 9}},
                                {{Kind::PastMean, 20}},
                                {{Kind::Quadratic, 15}}}) {
    const support::Asked asked = smoothed_by(made);
    const auto found = smoothing_of(asked.problem());
    ASSERT_TRUE(found.has_value()) << note_on(made);
    EXPECT_EQ(note_on(*found), note_on(made));
  }
  EXPECT_FALSE(smoothing_of(support::asked(support::nothing).problem()).has_value());
}

TEST(SmoothedRecords, SamplesThatShareNoiseAndTheEndsAreMissing) {
  const Smoothing smoothing{{Kind::CentredMean, 9}, true};
  const support::Asked asked = smoothed_by(smoothing);
  const BoundRecords sharp = preprocessed(smoothing, asked.records);
  const Trajectory& record = sharp.data.trajectories[0];
  const Index memory = memory_of(smoothing.filter);
  EXPECT_EQ(mark_of(record.marks, 3, 0), Mark::Missing);
  EXPECT_EQ(mark_of(record.marks, 4, 0), Mark::Value);
  EXPECT_EQ(mark_of(record.marks, 5, 0), Mark::Missing);
  EXPECT_EQ(mark_of(record.marks, 4 + memory, 1), Mark::Value);
  EXPECT_EQ(mark_of(record.marks, record.samples() - 4, 1), Mark::Missing);
  EXPECT_EQ(mark_of(sharp.outliers[0], 5, 0), Mark::Missing);
  const Dataset before = support::hidden_record(support::nothing, 0.01);
  const auto error = [&](const Matrix& inputs) {
    const Index n = inputs.rows() - 100;
    return (inputs - before.trajectories[0].inputs).middleRows(50, n).norm();
  };
  EXPECT_LT(error(record.inputs), 0.1 * error(asked.records.data.trajectories[0].inputs));
}

}  // namespace
}  // namespace lacuna
