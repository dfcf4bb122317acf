// SPDX-License-Identifier: MIT
#include "lacuna/data/long_records/sample_source.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "unit/data/long_records/long_records.hpp"

namespace lacuna {
namespace {

Dataset full_record() {
  Dataset data = testing::long_oscillation(1000, 50.0);
  Trajectory& record = data.trajectories[0];
  record.inputs = record.time * 2.0;
  record.derivatives = record.states * 3.0;
  record.marks = Matrix::Constant(1000, 2, 0.0);
  record.marks(640, 1) = 1.0;
  return data;
}

TEST(SampleSource, OfARecordInMemoryGivesItsRows) {
  const Dataset data = full_record();
  const auto source = source_of(data.trajectories[0]);
  ASSERT_EQ(source->samples(), 1000);
  const Trajectory part = source->read(600, 100),
                   expected = rows_of(data.trajectories[0], 600, 100);
  EXPECT_EQ(part.time, expected.time);
  EXPECT_EQ(part.states, expected.states);
  EXPECT_EQ(part.marks, expected.marks);
  EXPECT_EQ(part.source, "swing");
  EXPECT_EQ(source->in_memory(), &data.trajectories[0]);
  EXPECT_EQ(thinned(source, 2)->in_memory(), nullptr) << "its samples are others";
}

/// A record of which only pieces can be read, like one in a file.
class InPieces final : public SampleSource {
 public:
  explicit InPieces(const Trajectory& record) : record_(source_of(record)) {}
  Index samples() const override { return record_->samples(); }
  Trajectory read(Index first, Index count) const override {
    return record_->read(first, count);
  }

 private:
  std::shared_ptr<const SampleSource> record_;
};

std::vector<std::shared_ptr<const SampleSource>> both_kinds(const Dataset& data) {
  const Trajectory& record = data.trajectories[0];
  return {source_of(record), std::make_shared<const InPieces>(record)};
}

/// The thinned samples, one by one.
void expect_every(Index step, const Dataset& data, Index first, Index count,
                  const std::shared_ptr<const SampleSource>& record) {
  const auto source = thinned(record, step);
  const Trajectory part = source->read(first, count);
  ASSERT_EQ(part.samples(), count);
  for (Index i = 0; i < count; ++i) {
    const Trajectory one = rows_of(data.trajectories[0], (first + i) * step, 1);
    EXPECT_EQ(part.time[i], one.time[0]);
    EXPECT_EQ(part.states.row(i), one.states.row(0));
    EXPECT_EQ(part.inputs.row(i), one.inputs.row(0));
    EXPECT_EQ(part.derivatives.row(i), one.derivatives.row(0));
    EXPECT_EQ(part.marks.row(i), one.marks.row(0));
  }
}

TEST(SampleSource, ThinnedGivesEverySoManyth) {
  const Dataset data = full_record();
  ASSERT_FALSE(both_kinds(data).empty());
  for (const auto& record : both_kinds(data)) {
    expect_every(7, data, 3, 140, record);
    expect_every(8, data, 0, 125, record);
    expect_every(300, data, 1, 3, record);
  }
}

TEST(SampleSource, ThinnedReadsPieceByPieceWhatIsLong) {
  const Dataset data = testing::long_oscillation(200000, 50.0);
  ASSERT_FALSE(both_kinds(data).empty());
  for (const auto& record : both_kinds(data)) {
    const auto source = thinned(record, 3);
    ASSERT_EQ(source->samples(), 66667);
    const Trajectory all = source->read(0, 66667);
    for (const Index i : {0, 21845, 21846, 43690, 66666})
      EXPECT_EQ(all.states.row(i), data.trajectories[0].states.row(3 * i)) << i;
  }
}

TEST(SampleSource, CountsTheLastSampleOfAThinnedRecord) {
  const Dataset data = full_record();
  const auto source = source_of(data.trajectories[0]);
  EXPECT_EQ(thinned(source, 999)->samples(), 2);
  EXPECT_EQ(thinned(source, 1000)->samples(), 1);
}

}  // namespace
}  // namespace lacuna
