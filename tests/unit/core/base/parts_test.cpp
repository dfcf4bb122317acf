// SPDX-License-Identifier: MIT
#include "core/base/parts.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <mutex>
#include <numeric>

#include "support/thread_team.hpp"

namespace lacuna {
namespace {

TEST(Parts, AreAllOnesOwnWithoutATeam) {
  std::vector<double> parts(5, 0.0);
  for_each_own_part(parts.size(), {}, [&](std::size_t i) { parts[i] += 1.0; });
  exchange_parts(parts.size(), {}, [](std::size_t) -> std::span<double> {
    ADD_FAILURE() << "there is nobody to share with";
    return {};
  });
  EXPECT_EQ(parts, std::vector<double>(5, 1.0));
}

TEST(Parts, AreDividedAmongTheMembersAndSharedByAll) {
  for (const std::size_t count : {0U, 1U, 3U, 64U}) {
    std::vector<double> expected(count);
    std::iota(expected.begin(), expected.end(), 1.0);
    std::vector<std::atomic<int>> done(count);
    testing::ThreadTeam(4).run(2, [&](const RunContext& context) {
      std::vector<double> parts(count, 0.0);
      for_each_own_part(count, context, [&](std::size_t i) {
        parts[i] = static_cast<double>(i + 1);
        ++done[i];
      });
      exchange_parts(count, context, [&](std::size_t i) { return std::span(&parts[i], 1); });
      EXPECT_EQ(parts, expected);
    });
    for (const auto& times : done) EXPECT_EQ(times, 1);
  }
}

TEST(Parts, TextsAreSharedWhateverTheirLengths) {
  const std::vector<std::string> expected{"", "a", std::string(1000, 'z'), "\xc3\xa4\n", "end"};
  testing::ThreadTeam(3).run(1, [&](const RunContext& context) {
    std::vector<std::string> texts(expected.size());
    for_each_own_part(texts.size(), context, [&](std::size_t i) { texts[i] = expected[i]; });
    exchange_texts(texts, context);
    EXPECT_EQ(texts, expected);
  });
}

TEST(Parts, OfAMemberAreNeighbours) {
  testing::ThreadTeam(3).run(1, [&](const RunContext& context) {
    std::size_t next = 0;
    for (int member = 0; member < 3; ++member) {
      const OwnParts own = parts_of(member, 64, context);
      EXPECT_EQ(own.first, next);
      EXPECT_NEAR(static_cast<double>(own.end - own.first), 64.0 / 3.0, 1.0);
      next = own.end;
    }
    EXPECT_EQ(next, 64U);
  });
}

TEST(Parts, TheFirstMemberLeads) {
  std::atomic<int> leaders{0};
  testing::ThreadTeam(3).run(1, [&](const RunContext& context) {
    if (context.leads()) ++leaders;
    EXPECT_TRUE(context.alone().leads());
  });
  EXPECT_EQ(leaders, 1);
  EXPECT_TRUE(RunContext{}.leads());
}

}  // namespace
}  // namespace lacuna
