// SPDX-License-Identifier: MIT
#include "records/channels/channel_notes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "lacuna/data/records/marks.hpp"

namespace lacuna {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// One channel of span 2 V, as it is described.
std::vector<std::string> notes_of(const Channel& channel) {
  BoundRecords records;
  records.data.states = {{"q", "V"}};
  Trajectory record;
  record.time = Vector{{0.0, 1.0, 2.0}};
  record.states = Matrix{{-1.0}, {0.0}, {1.0}};
  records.data.trajectories = {std::move(record)};
  records.channels = {channel};
  return channel_notes(records);
}

TEST(ChannelNotes, SayWhereAChannelIsClipped) {
  const Channel both{.at_top = 0.12, .at_bottom = 0.034, .limits = {-1.0, 1.0}};
  EXPECT_THAT(notes_of(both), ElementsAre(HasSubstr(
                                  "clipped-channel: q is clipped at 1 V: 12 % of the samples, "
                                  "at -1 V: 3.4 % of the samples")));
  EXPECT_THAT(notes_of({.at_top = 0.12, .limits = {{}, 1.0}}),
              ElementsAre(::testing::Not(HasSubstr("-1 V"))));
}

TEST(ChannelNotes, SayHowManySamplesAreMissing) {
  EXPECT_THAT(notes_of({.missing = 0.8}), ElementsAre(HasSubstr("dropouts: 80 %")));
  EXPECT_THAT(notes_of({.measured = false, .missing = 0.8}), IsEmpty());
}

/// One channel at steps of 0.1, with rows at steps of 0.037 between in which it has no sample, as
/// those of another log, and without every so many of its own.
std::vector<std::string> notes_of_joined(Index lost_each) {
  BoundRecords records;
  records.data.states = {{"q", "V"}};
  std::vector<double> own, times;
  for (Index i = 0; i < 200; ++i) own.push_back(0.1 * static_cast<double>(i));
  times = own;
  for (Index i = 1; i < 500; ++i) times.push_back(0.037 * static_cast<double>(i) + 1e-3);
  std::sort(times.begin(), times.end());
  Trajectory record;
  const auto n = static_cast<Index>(times.size());
  record.time = Eigen::Map<const Vector>(times.data(), n);
  record.states = record.time.array().sin();
  Index missing = 0;
  for (Index i = 0; i < n; ++i) {
    const auto at = std::find(own.begin(), own.end(), record.time[i]);
    const bool is_lost =
        at != own.end() && lost_each > 0 && (at - own.begin()) % lost_each == lost_each - 2;
    if (at != own.end() && !is_lost) continue;
    set_mark(record, i, 0, Mark::Missing);
    ++missing;
  }
  records.data.trajectories = {std::move(record)};
  records.channels = {
      {.missing = static_cast<double>(missing) / static_cast<double>(n)}};
  return channel_notes(records);
}

TEST(ChannelNotes, RowsOfAnotherLogAreNoDropouts) {
  EXPECT_THAT(notes_of_joined(0),
              ElementsAre(HasSubstr("q has samples of its own in 29 % of the rows")));
  EXPECT_THAT(notes_of_joined(20), ElementsAre(HasSubstr("dropouts: 5 % of the samples of q")));
}

TEST(ChannelNotes, SayHowCoarseAChannelIsWhereThatMatters) {
  Channel coarse{.noise = {0.0045, NoiseKind::Quantised, 2.0 / 128.0}};
  EXPECT_THAT(notes_of(coarse), ElementsAre(HasSubstr("resolution of 8 bits")));
  coarse.noise = {0.01, NoiseKind::White, 2.0 / 128.0};
  EXPECT_THAT(notes_of(coarse), ElementsAre(HasSubstr("a part of its noise")));
  coarse.noise = {0.1, NoiseKind::White, 2.0 / 128.0};
  EXPECT_THAT(notes_of(coarse), IsEmpty()) << "hidden in other noise";
  coarse.noise = {3e-7, NoiseKind::Quantised, 1e-6};
  EXPECT_THAT(notes_of(coarse), IsEmpty()) << "digits of the file";
}

}  // namespace
}  // namespace lacuna
