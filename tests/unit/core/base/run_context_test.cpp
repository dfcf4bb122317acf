// SPDX-License-Identifier: MIT
#include "lacuna/core/base/run_context.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace lacuna {
namespace {

TEST(RunContext, StopsBeforeItTells) {
  std::stop_source source;
  bool told = false;
  RunContext context;
  context.stop = source.get_token();
  context.progress = [&](const Progress&) { told = true; };
  EXPECT_NO_THROW(context.check_stop());
  source.request_stop();
  EXPECT_THROW(context.check_stop(), Cancelled);
  EXPECT_THROW(context.report("fitting", 0.5), Cancelled);
  EXPECT_FALSE(told);
}

TEST(RunContext, ADeadlineEndsWhatIsNotUnhurried) {
  RunContext context;
  context.deadline = std::chrono::steady_clock::now() + std::chrono::hours(1);
  EXPECT_FALSE(context.is_late());
  EXPECT_NO_THROW(context.check_stop());
  context.deadline = std::chrono::steady_clock::now();
  EXPECT_TRUE(context.is_late());
  EXPECT_THROW(context.check_stop(), OutOfTime);
  EXPECT_NO_THROW(context.unhurried().check_stop());
}

TEST(RunContext, CallsSideBySideKeepStopDeadlineAndSeed) {
  std::stop_source source;
  RunContext context;
  context.stop = source.get_token();
  context.threads = 4;
  context.seed = 7;
  context.progress = [](const Progress&) {};
  context.deadline = std::chrono::steady_clock::now();
  const RunContext one = context.beside_others();
  EXPECT_EQ(one.threads, 1);
  EXPECT_EQ(one.seed, 7u);
  EXPECT_FALSE(one.progress);
  EXPECT_THROW(one.check_stop(), OutOfTime);
  source.request_stop();
  EXPECT_FALSE(one.deadline == std::nullopt);
  EXPECT_TRUE(one.stop.stop_requested());
}

}  // namespace
}  // namespace lacuna
