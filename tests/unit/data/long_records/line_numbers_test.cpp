// SPDX-License-Identifier: MIT
#include "data/long_records/line_numbers.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/random.hpp"

namespace lacuna {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(LineNumbers, AreThoseThatWereGiven) {
  Random random(2);
  std::vector<std::size_t> lines{3};
  while (lines.size() < 2000)
    lines.push_back(lines.back() + 1 + (random.normal() > 1.0 ? 2U : 0U));
  LineNumbers numbers;
  const std::span<const std::size_t> all(lines);
  numbers.append(all.first(700));
  numbers.append(all.subspan(700));
  for (const Index first : {0, 1, 699, 1500}) {
    const auto expected = all.subspan(static_cast<std::size_t>(first), 500);
    EXPECT_THAT(numbers.of(first, 500), ::testing::ElementsAreArray(expected)) << first;
  }
  EXPECT_THAT(numbers.of(1999, 1), ElementsAre(lines.back()));
}

TEST(LineNumbers, OfEveryThirdLineAreAllKnown) {
  LineNumbers numbers;
  std::vector<std::size_t> lines(2 * LineNumbers::kMost);
  for (std::size_t i = 0; i < lines.size(); ++i) lines[i] = 3 * i + 5;
  numbers.append(lines);
  EXPECT_THAT(numbers.of(static_cast<Index>(lines.size()) - 1, 1), ElementsAre(lines.back()));
}

TEST(LineNumbers, TakeABoundedMemory) {
  LineNumbers numbers;
  std::vector<std::size_t> lines;
  for (std::size_t i = 0; i < 4 * LineNumbers::kMost; ++i) lines.push_back(i * i);
  numbers.append(lines);
  EXPECT_THAT(numbers.of(100, 2), ElementsAre(10000, 10201));
  EXPECT_THAT(numbers.of(static_cast<Index>(lines.size()) - 1, 1), IsEmpty());
}

}  // namespace
}  // namespace lacuna
