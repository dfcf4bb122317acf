// SPDX-License-Identifier: MIT
#include "lacuna/core/base/run_context.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace lacuna {
namespace {

TEST(RunContext, WorksWithoutProgressAndWithoutStop) {
  const RunContext context;
  EXPECT_NO_THROW(context.report("fitting", 0.5));
  EXPECT_EQ(context.threads, 1);
}

TEST(RunContext, TellsTheProgress) {
  std::vector<std::string> seen;
  RunContext context;
  context.progress = [&](const Progress& progress) {
    seen.push_back(std::string(progress.activity) + " " + std::to_string(progress.fraction));
  };
  context.report("fitting", 0.25);
  EXPECT_EQ(seen, std::vector<std::string>{"fitting 0.250000"});
}

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

}  // namespace
}  // namespace lacuna
