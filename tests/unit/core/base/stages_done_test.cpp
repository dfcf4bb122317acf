// SPDX-License-Identifier: MIT
#include "lacuna/core/base/stages_done.hpp"

#include <gtest/gtest.h>

namespace lacuna {
namespace {

TEST(StagesDone, TheAnswerComesFromTheLastOneThatWasDone) {
  EXPECT_EQ(answer_from({}), "");
  EXPECT_EQ(answer_from({{"equations"}, {"trajectories"}, {"forms", false, kTimeIsUp}}),
            "trajectories");
}

TEST(StagesDone, OneLineSaysWhatIsLeftOutAndWhy) {
  EXPECT_EQ(left_out_line({{"equations"}}), "");
  EXPECT_EQ(left_out_line({{"equations"},
                           {"forms", false, kTimeIsUp},
                           {"advice", false, kIsQuick},
                           {"relations", false, kTimeIsUp}}),
            "left out: forms, relations (the time limit came first); advice (--effort quick)");
}

TEST(StagesDone, WhatHadNothingToGainIsNotLeftOut) {
  EXPECT_EQ(left_out_line({{"equations"}, {"forms", false, "the library lacks nothing"}}), "");
}

TEST(StagesDone, AStageThatRunsOutOfTimeIsEnteredAsLeftOut) {
  std::vector<StageDone> stages;
  EXPECT_TRUE(run_stage(stages, "first", [] {}));
  EXPECT_FALSE(run_stage(stages, "second", [] { throw OutOfTime(); }));
  ASSERT_EQ(stages.size(), 2u);
  EXPECT_TRUE(stages[0].done);
  EXPECT_EQ(stages[0].why, "");
  EXPECT_FALSE(stages[1].done);
  EXPECT_EQ(stages[1].why, kTimeIsUp);
  EXPECT_THROW(run_stage(stages, "third", [] { throw Cancelled(); }), Cancelled);
  EXPECT_EQ(stages.size(), 2u);
}

}  // namespace
}  // namespace lacuna
