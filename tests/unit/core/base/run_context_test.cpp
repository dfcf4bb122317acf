// SPDX-License-Identifier: MIT
#include "lacuna/core/base/run_context.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <numeric>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "core/base/parallel.hpp"
#include "lacuna/core/base/options.hpp"
#include "lacuna/core/base/stages_done.hpp"
#include "lacuna/core/base/types.hpp"
#include "support/expect_error.hpp"

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

class Scaler : public StageInterface {
 public:
  static constexpr std::string_view kKind = "scaler";
  virtual double scale(double x) const = 0;
};

struct FactorOptions {
  static constexpr StageInfo kInfo{"factor", "Multiplies.", "none"};
  double factor = 2.0;
  void describe(OptionVisitor& v) { v.field({"factor", "", "The factor.", 0.0}, factor); }
};

class Factor final : public Configured<Scaler, FactorOptions> {
 public:
  using Configured::Configured;
  double scale(double x) const override { return options().factor * x; }
};

TEST(Stage, IsNeverNullAndNeverForgotten) {
  testing::expect_error<ArgumentError>([] { Stage<Scaler>(std::shared_ptr<const Scaler>()); },
                                       "scaler", "no stage given", "");
  EXPECT_FALSE((std::is_default_constructible_v<Stage<Scaler>>));
}

TEST(Stage, RefusesOptionsOutOfRange) {
  testing::expect_error<ConfigError>([] { Factor{{.factor = -1.0}}; }, "factor.factor",
                                     "-1 is out of range", "at least 0");
}

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

TEST(ParallelFor, CallsEachNumberOnce) {
  for (const int threads : {1, 2, 5}) {
    std::vector<int> calls(100, 0);
    parallel_for(calls.size(), threads, [&](std::size_t i) { ++calls[i]; });
    EXPECT_EQ(calls, std::vector<int>(100, 1)) << threads << " threads";
  }
}

TEST(ParallelFor, NothingToDoIsFine) {
  parallel_for(0, 4, [](std::size_t) { FAIL(); });
}

TEST(ParallelFor, ThrowsWhatTheFirstFailingCallThrew) {
  const auto work = [](std::size_t i) {
    if (i >= 3) throw std::runtime_error(std::to_string(i));
  };
  try {
    parallel_for(4, 2, work);
    FAIL() << "nothing was thrown";
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "3");
  }
}

}  // namespace
}  // namespace lacuna
