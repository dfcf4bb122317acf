// SPDX-License-Identifier: MIT
#include "trajectories/design/design_search.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <limits>

namespace lacuna {
namespace {

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

}  // namespace
}  // namespace lacuna
