// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "lacuna/data/long_records.hpp"
#include "unit/data/long_records/long_records.hpp"

namespace lacuna {
namespace {

using ::testing::HasSubstr;
using testing::long_oscillation;

constexpr Index kExcerpt = RecordStream::kExcerpt;

std::vector<std::shared_ptr<const SampleSource>> sources_of(const Dataset& data) {
  std::vector<std::shared_ptr<const SampleSource>> sources;
  for (const Trajectory& record : data.trajectories) sources.push_back(source_of(record));
  return sources;
}

TEST(RecordStream, OfShortRecordsIsTheRecords) {
  const Dataset data = long_oscillation(5000, 50.0);
  const RecordStream stream = data;
  EXPECT_FALSE(stream.is_long());
  EXPECT_EQ(&stream.excerpt(), &data);
  EXPECT_EQ(stream.in_memory(), &data);
  EXPECT_EQ(stream.samples(), 5000);
  EXPECT_TRUE(stream.records().empty());
}

TEST(RecordStream, FindsTheNoiseOfItsExcerptOnce) {
  const Dataset data = long_oscillation(kExcerpt + 5000, 50.0);
  const RecordStream stream = data;
  const RecordStream copy = stream;
  const std::vector<StateNoise>& noise = stream.noise();
  ASSERT_EQ(noise.size(), data.states.size());
  EXPECT_EQ(noise[0].sigma, analyse_noise(stream.excerpt())[0].sigma);
  EXPECT_EQ(&copy.noise(), &noise);
}

TEST(RecordStream, OfShortRecordsThatAreReadInPiecesTakesThemIn) {
  const Dataset data = long_oscillation(5000, 50.0);
  Dataset description = data;
  description.trajectories.clear();
  const RecordStream stream(description, sources_of(data));
  EXPECT_FALSE(stream.is_long());
  ASSERT_NE(stream.in_memory(), nullptr);
  EXPECT_EQ(stream.excerpt().trajectories[0].states, data.trajectories[0].states);
}

TEST(RecordStream, KeepsRecordsThatItIsGiven) {
  Dataset data = long_oscillation(kExcerpt + 5000, 50.0);
  const Vector last = data.trajectories[0].states.row(kExcerpt + 4999).transpose();
  const RecordStream stream(std::move(data));
  const RecordStream copy = stream;
  ASSERT_TRUE(copy.is_long());
  EXPECT_EQ(Vector(copy.records()[0]->read(kExcerpt + 4999, 1).states.row(0).transpose()),
            last);
}

TEST(RecordStream, ExcerptOfFastSignalsIsSixteenStretchesOverAllOfThem) {
  const Index n = 4 * kExcerpt;
  const Dataset data = long_oscillation(n, 50.0);
  const RecordStream stream = data;
  ASSERT_TRUE(stream.is_long());
  const auto& parts = stream.excerpt().trajectories;
  ASSERT_EQ(parts.size(), 16U);
  EXPECT_EQ(stream.excerpt().samples(), kExcerpt);
  EXPECT_EQ(parts.front().time[0], 0.0);
  EXPECT_NEAR(parts.back().time[parts.back().samples() - 1], data.trajectories[0].time[n - 1],
              0.2);
  EXPECT_EQ(stream.excerpt().states, data.states);
  EXPECT_EQ(stream.in_memory(), &data);
}

TEST(RecordStream, ExcerptOfSlowerSignalsHasFewerAndLongerStretches) {
  // Two passages in a period: 128 in an excerpt are four times 32.
  const Dataset data = long_oscillation(4 * kExcerpt, static_cast<double>(kExcerpt) / 64.5);
  EXPECT_EQ(excerpt_of(sources_of(data)).size(), 4U);
  EXPECT_EQ(thinning_of(sources_of(data)), 1);
}

TEST(RecordStream, VerySlowSignalsAreThinnedUntilTheExcerptShowsThem) {
  // Four passages in an excerpt of eight; the records are done with a thinning of four.
  const Dataset data = long_oscillation(4 * kExcerpt, static_cast<double>(kExcerpt) / 2.2);
  EXPECT_EQ(thinning_of(sources_of(data)), 4);
  const RecordStream stream = data;
  EXPECT_FALSE(stream.is_long());
  EXPECT_EQ(stream.samples(), kExcerpt);
  EXPECT_EQ(stream.in_memory(), &data);
  EXPECT_EQ(stream.excerpt().trajectories[0].states.row(100),
            data.trajectories[0].states.row(400));
  ASSERT_EQ(stream.excerpt().notes.size(), 1U);
  EXPECT_THAT(stream.excerpt().notes[0], HasSubstr("one in 4 is used"));
}

TEST(RecordStream, NoiseDoesNotMakeASlowSignalFast) {
  const Dataset data =
      long_oscillation(4 * kExcerpt, static_cast<double>(kExcerpt) / 2.2, 0.03);
  EXPECT_EQ(thinning_of(sources_of(data)), 4);
}

TEST(RecordStream, WhatTheBeginHidesIsJudgedByTheWholeRecord) {
  // A state that first only shows noise of its later size.
  Dataset data = long_oscillation(4 * kExcerpt, static_cast<double>(kExcerpt) / 2.2, 0.01);
  auto v = data.trajectories[0].states.col(1);
  v.head(kExcerpt) = 0.01 * v.tail(kExcerpt);
  EXPECT_GT(thinning_of(sources_of(data)), 1);
}

TEST(RecordStream, AFastInputForbidsThinning) {
  Dataset data = long_oscillation(4 * kExcerpt, static_cast<double>(kExcerpt) / 2.2);
  Trajectory& record = data.trajectories[0];
  record.inputs.resize(record.samples(), 1);
  for (Index i = 0; i < record.samples(); ++i)
    record.inputs(i, 0) = i / 10 % 2 == 0 ? 1.0 : -1.0;
  EXPECT_EQ(thinning_of(sources_of(data)), 1);
}

TEST(RecordStream, ManyRecordsShareTheExcerpt) {
  Dataset data = long_oscillation(40000, 50.0);
  for (int i = 0; i < 7; ++i) data.trajectories.push_back(data.trajectories[0]);
  const std::vector<Stretch> stretches = excerpt_of(sources_of(data));
  Index all = 0, last = -1;
  std::vector<bool> seen(8, false);
  for (const Stretch& stretch : stretches) {
    const Index begin = static_cast<Index>(stretch.record) * 40000 + stretch.first;
    EXPECT_GT(begin, last);
    last = begin;
    EXPECT_LE(stretch.first + stretch.count, 40000);
    seen[stretch.record] = true;
    all += stretch.count;
  }
  EXPECT_EQ(all, kExcerpt);
  EXPECT_EQ(std::count(seen.begin(), seen.end(), true), 8);
}

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

}  // namespace
}  // namespace lacuna
