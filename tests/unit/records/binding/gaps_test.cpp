// SPDX-License-Identifier: MIT
#include "lacuna/records/binding/gaps.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/random.hpp"
#include "core/base/text.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/data/records/marks.hpp"
#include "support/expect_error.hpp"
#include "support/oscillation.hpp"

namespace lacuna {
namespace {

using ::testing::ElementsAre;

/// Samples [first, end) of an oscillation as piece `number` of a file.
Trajectory piece(Index first, Index end, int number) {
  Trajectory part = rows_of(oscillation(400), first, end - first);
  part.source = "run.csv, piece " + std::to_string(number);
  return part;
}

Dataset pieces(std::vector<Trajectory> parts) {
  Dataset data = oscillation_data();
  data.trajectories = std::move(parts);
  return data;
}

std::vector<std::string> sources(const Dataset& data) {
  std::vector<std::string> names;
  for (const Trajectory& record : data.trajectories) names.push_back(record.source);
  return names;
}

TEST(JoinAcrossGaps, JoinsUpToTenStepsAndNoFurther) {
  // From sample 99 to 109 are ten steps, from 199 to 210 eleven.
  const Dataset data =
      join_across_gaps(pieces({piece(0, 100, 1), piece(109, 200, 2), piece(210, 400, 3)}));
  EXPECT_THAT(sources(data), ElementsAre("run.csv", "run.csv, piece 3"));
  const Trajectory& joined = data.trajectories[0];
  ASSERT_EQ(joined.samples(), 191);
  const Trajectory whole = oscillation(400);
  EXPECT_EQ(joined.time[100], whole.time[109]);
  EXPECT_EQ(joined.states.row(100), whole.states.row(109));
  EXPECT_EQ(joined.inputs.row(99), whole.inputs.row(99));
}

TEST(JoinAcrossGaps, HasALongestGap) {
  const Dataset cut = pieces({piece(0, 100, 1), piece(109, 200, 2)});
  EXPECT_EQ(join_across_gaps(cut, {.longest_gap = 9.0}).trajectories.size(), 2u);
  EXPECT_EQ(join_across_gaps(cut, {.longest_gap = 10.0}).trajectories.size(), 1u);
}

TEST(JoinAcrossGaps, KeepsDerivativesAndDoesNotMixRecordsWithThoseWithout) {
  std::vector<Trajectory> parts{piece(0, 100, 1), piece(102, 200, 2), piece(202, 300, 3)};
  for (std::size_t i = 0; i < 2; ++i) give_derivatives(parts[i]);
  const Dataset data = join_across_gaps(pieces(parts));
  ASSERT_EQ(data.trajectories.size(), 2u);
  EXPECT_EQ(data.trajectories[0].derivatives.rows(), 198);
  EXPECT_FALSE(data.trajectories[1].has_derivatives());
}

TEST(NotesOnJumps, SaidWhereTimeIsRegularOtherwise) {
  Dataset data = pieces({piece(0, 100, 1)});
  EXPECT_TRUE(notes_on_jumps(data).empty());
  Vector& time = data.trajectories[0].time;
  const double step = time[1] - time[0];
  time.tail(40).array() += 12.0 * step;
  const std::vector<std::string> notes = notes_on_jumps(data);
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_NE(notes[0].find("run.csv, piece 1, 13 steps"), std::string::npos) << notes[0];
  EXPECT_TRUE(notes_on_jumps(data, {.longest_gap = 13.0}).empty());
  EXPECT_EQ(notes[0].find(" times, "), std::string::npos) << "one jump is not counted";
  EXPECT_NE(notes[0].find("inputs by their hold"), std::string::npos) << notes[0];
  time.head(20).array() -= 14.0 * step;
  const std::string two = notes_on_jumps(data).at(0);
  EXPECT_NE(two.find("time jumps 2 times, farthest from " + format_number(time[19], 4) +
                     " to " + format_number(time[20], 4) + " ("),
            std::string::npos)
      << two;
  EXPECT_NE(two.find(", 15 steps"), std::string::npos) << two;
  time.array() += 5e8 - time[19];
  EXPECT_NE(notes_on_jumps(data).at(0).find("from 500000000 to 50000000"), std::string::npos)
      << notes_on_jumps(data).at(0);
  for (Index i = 0; i < time.size(); i += 5) time[i] += 0.3 * step;  // uneven
  EXPECT_TRUE(notes_on_jumps(data).empty());
  EXPECT_TRUE(notes_on_jumps(pieces({piece(0, 1, 1)})).empty());
}

TEST(UsableRecords, LeavesShortOnesOutAndSaysSo) {
  const UsableRecords usable = usable_records(
      pieces({piece(0, 12, 1), piece(14, 30, 2), piece(100, 119, 3), piece(200, 220, 4)}));
  EXPECT_THAT(sources(usable.data), ElementsAre("run.csv", "run.csv, piece 4"));
  EXPECT_THAT(usable.notes, ElementsAre("1 short gaps in the records are bridged",
                                        "1 pieces of less than 20 samples were left out"));
  testing::expect_error<DataError>([] { usable_records(pieces({piece(0, 19, 1)})); },
                                   "run.csv, piece 1", "no record has 20 samples", "longer");
  EXPECT_EQ(usable_records(pieces({piece(0, 19, 1)}), {.shortest_record = 19}).notes.size(),
            0u);
}

/// A record that goes on in time, and with another motion from sample `seam` on.
Trajectory with_seam(Index seam, Index missing) {
  Trajectory record = oscillation(400);
  const Trajectory other = oscillation(400, 2.1);
  record.states.bottomRows(400 - seam) = other.states.bottomRows(400 - seam);
  record.inputs.bottomRows(400 - seam) = other.inputs.bottomRows(400 - seam);
  if (missing == 0) return record;
  const Index left = 400 - missing;
  const auto without = [&](const Matrix& all) {
    Matrix rows(left, all.cols());
    rows << all.topRows(seam), all.bottomRows(left - seam);
    return rows;
  };
  record.time = without(record.time);
  record.states = without(record.states);
  record.inputs = without(record.inputs);
  return record;
}

TEST(UsableRecords, StatesMayHaveFarFewerSamplesThanInputs) {
  Dataset data = pieces({piece(0, 400, 1)});
  Trajectory& record = data.trajectories[0];
  for (Index i = 0; i < 400; ++i)
    for (Index k = 0; k < data.state_count(); ++k)
      if (i % 20 != 0) set_mark(record, i, k, Mark::Missing);
  const UsableRecords whole = usable_records(data);
  ASSERT_EQ(whole.data.trajectories.size(), 1u);
  EXPECT_EQ(whole.data.samples(), 381) << "from the first to the last that shows something";
  for (Index i = 100; i < 330; ++i)  // eleven of these steps
    for (Index k = 0; k < data.state_count(); ++k) set_mark(record, i, k, Mark::Missing);
  EXPECT_EQ(usable_records(data).data.trajectories.size(), 2u);
}

TEST(UsableRecords, AreCutAtASeam) {
  for (const Index missing : {0, 1, 5}) {
    SCOPED_TRACE(missing);
    const UsableRecords usable = usable_records(pieces({with_seam(150, missing)}));
    ASSERT_EQ(usable.data.trajectories.size(), 2u);
    EXPECT_EQ(usable.data.trajectories[0].samples(), 150);
    EXPECT_EQ(usable.data.trajectories[1].samples(), 250 - missing);
    EXPECT_THAT(usable.notes, ElementsAre(::testing::HasSubstr("all channels jump at once")));
  }
}

/// Of what is no seam: an impact, after which the position goes on; a step of the input after
/// which the only state is elsewhere a sample later; a run of outliers; steps that are coarse.
TEST(UsableRecords, AreNotCutWhereOneChannelGoesOnOrAnInputJumpsOrAllComeBack) {
  Dataset impact = pieces({oscillation(400)});
  impact.trajectories[0].states.col(1).tail(200) *= -1.0;
  EXPECT_EQ(usable_records(impact).data.trajectories.size(), 1u);

  Dataset step = pieces({oscillation(400)});
  step.states.resize(1);
  step.trajectories[0].inputs.setZero();
  step.trajectories[0].inputs.bottomRows(200).setOnes();
  step.trajectories[0].states = step.trajectories[0].inputs;
  EXPECT_EQ(usable_records(step).data.trajectories.size(), 1u);

  Dataset run = pieces({oscillation(400)});
  run.trajectories[0].states.middleRows(200, 3).array() += 3.0;
  EXPECT_EQ(usable_records(run).data.trajectories.size(), 1u);

  Dataset coarse = pieces({oscillation(400)});
  coarse.trajectories[0].states = coarse.trajectories[0].states.array().round();
  EXPECT_EQ(usable_records(coarse).data.trajectories.size(), 1u);
}

TEST(SplitInTime, KeepsTheLastQuarterBack) {
  const auto [find, check] = split_in_time(pieces({piece(0, 100, 1), piece(200, 250, 2)}));
  ASSERT_EQ(find.trajectories.size(), 2u);
  EXPECT_EQ(find.trajectories[0].samples(), 75);
  EXPECT_EQ(find.trajectories[1].samples(), 38);
  EXPECT_EQ(check.trajectories[1].samples(), 12);
  EXPECT_EQ(check.trajectories[0].time[0], oscillation(400).time[75]);
  EXPECT_EQ(check.trajectories[1].source, "run.csv, piece 2, last quarter");
  EXPECT_EQ(find.states, check.states);
  Dataset unnamed = pieces({piece(0, 100, 1)});
  unnamed.trajectories[0].source.clear();
  EXPECT_EQ(split_in_time(unnamed).check.trajectories[0].source, "last quarter");
}

TEST(JoinAcrossGaps, RecordsOfOneSampleHaveNoStepToMeasureGapsBy) {
  EXPECT_EQ(join_across_gaps(pieces({piece(0, 1, 1), piece(5, 6, 2)})).trajectories.size(), 2u);
}

TEST(SplitInTime, AnOutlierAtTheCutIsOneInEitherPart) {
  for (const Index at : {74, 75}) {
    Dataset data = pieces({piece(0, 100, 1)});
    Random random(3);
    Matrix& states = data.trajectories[0].states;
    for (double& value : states.reshaped()) value += 0.01 * random.normal();
    states(at, 0) += 1.0;
    const auto [find, check] = split_in_time(data);
    const Trajectory& part = at < 75 ? find.trajectories[0] : check.trajectories[0];
    const Trajectory& other = at < 75 ? check.trajectories[0] : find.trajectories[0];
    EXPECT_EQ(mark_of(part.marks, at < 75 ? 74 : 0, 0), Mark::Outlier) << at;
    EXPECT_TRUE(other.marks.size() == 0 || other.marks.isZero(0.0)) << at;
  }
}

}  // namespace
}  // namespace lacuna
