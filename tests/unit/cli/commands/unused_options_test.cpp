// SPDX-License-Identifier: MIT
#include "cli/commands/unused_options.hpp"

#include <gtest/gtest.h>

namespace lacuna::cli {
namespace {

TEST(UnusedOptions, AreThoseWhoseStageDecidedNothing) {
  const std::vector<StageDone> stages{{"equations"}, {"validation", false, kTimeIsUp}};
  EXPECT_EQ(why_not("equations", stages), "");
  EXPECT_EQ(why_not("validation", stages),
            "the stage `validation` was left out, the time limit came first");
  EXPECT_EQ(why_not("advice", stages), "the stage `advice` was not reached");
  EXPECT_EQ(unused_text({{"--x", ""}}), "");
  EXPECT_EQ(unused_text({{"--x", ""}, {"--y", "why"}}),
            "\nOptions that decided nothing\n  --y: why\n");
}

}  // namespace
}  // namespace lacuna::cli
