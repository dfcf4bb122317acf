// SPDX-License-Identifier: MIT
#include "trajectories/design/design_search.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace lacuna {
namespace {

TEST(Exchanged, ReachesTheCornerOfALinearFunction) {
  const Score score = [](std::size_t, const Vector& at) {
    return at[0] - 2.0 * at[1] - std::abs(at[2] - 0.5);
  };
  const ScoredDesign start{0, Vector::Constant(3, 0.3), score(0, Vector::Constant(3, 0.3))};
  const ScoredDesign found = exchanged(start, score, 100);
  Vector corner(3);
  corner << 1.0, 0.0, 0.5;
  EXPECT_EQ(found.design, corner);
  EXPECT_EQ(found.score, 1.0);
  const ScoredDesign unmoved = exchanged(start, score, 0);
  EXPECT_EQ(unmoved.design, start.design);
}

TEST(BestDesigns, AreSortedSeededAndTheSameForAnyThreads) {
  // The second space is better, but only near one point.
  const auto make_score = []() -> Score {
    return [](std::size_t space, const Vector& at) {
      const double far = (at.array() - 0.35).matrix().squaredNorm();
      return space == 0 ? -far : 1.0 - 3.0 * far;
    };
  };
  RunContext one, four;
  four.threads = 4;
  const DesignSearch search{10, 3, 200};
  const auto found = best_designs({2, 2}, make_score, {}, search, one).best;
  const auto again = best_designs({2, 2}, make_score, {}, search, four).best;
  ASSERT_EQ(found.size(), 3u);
  ASSERT_EQ(again.size(), 3u);
  EXPECT_EQ(found[0].space, 1u);
  EXPECT_NEAR(found[0].score, 1.0, 1e-4);
  EXPECT_NEAR(found[0].design[0], 0.35, 1e-2);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(found[i].design, again[i].design);
  EXPECT_GE(found[0].score, found[1].score);
  EXPECT_GE(found[1].score, found[2].score);
}

TEST(BestDesigns, PastTheDeadlineTheBestSoFarIsTheAnswer) {
  const DesignSearch search{10, 3, 200};
  for (const int last : {4, 10, 17}) {  // within the candidates, at their end, on the way
    RunContext context;
    int judged = 0;
    double best = -1e9;
    const auto make_score = [&]() -> Score {
      return [&](std::size_t, const Vector& at) {
        if (++judged == last) context.deadline = std::chrono::steady_clock::now();
        const double score = -(at.array() - 0.35).matrix().squaredNorm();
        best = std::max(best, score);
        return score;
      };
    };
    const SearchedDesigns found = best_designs({2}, make_score, {}, search, context);
    EXPECT_FALSE(found.in_time) << last;
    EXPECT_EQ(judged, last);
    EXPECT_EQ(found.best.front().score, best) << last;
  }
}

TEST(BestDesigns, WithoutAnyThereIsNoAnswer) {
  RunContext context;
  const auto make_score = [&]() -> Score {
    return [&](std::size_t, const Vector&) {
      context.deadline = std::chrono::steady_clock::now();
      return -std::numeric_limits<double>::infinity();
    };
  };
  EXPECT_THROW(best_designs({1}, make_score, {}, {}, context), OutOfTime);
}

TEST(BestDesigns, AStopEndsTheSearch) {
  std::stop_source stop;
  RunContext context;
  context.stop = stop.get_token();
  stop.request_stop();
  const auto make_score = []() -> Score {
    return [](std::size_t, const Vector&) { return 0.0; };
  };
  EXPECT_THROW(best_designs({1}, make_score, {}, {}, context), Cancelled);
}

}  // namespace
}  // namespace lacuna
