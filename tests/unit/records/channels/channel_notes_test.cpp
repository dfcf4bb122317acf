// SPDX-License-Identifier: MIT
#include "records/channels/channel_notes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

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
