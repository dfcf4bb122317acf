// SPDX-License-Identifier: MIT
#include "lacuna/core/base/options.hpp"

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <limits>
#include <mutex>
#include <numeric>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/parts.hpp"
#include "support/expect_error.hpp"
#include "support/thread_team.hpp"

namespace lacuna {
namespace {

using testing::expect_error;

enum class Mode { Fast, Exact };

constexpr std::array<std::string_view, 2> kModes{"fast", "exact"};

struct SampleOptions {
  static constexpr StageInfo kInfo{"sample", "For the test.", "none"};
  double width = 0.5;
  int order = 4;
  bool centred = true;
  std::string label = "a";
  std::optional<double> limit = {};
  std::optional<int> count = {};
  std::vector<std::string> names = {};
  Mode mode = Mode::Exact;

  void describe(OptionVisitor& v) {
    v.field({"width", "s", "Width of the window.", 0.0, 1.0}, width);
    v.field({"order", "", "Order.", 1.0}, order);
    v.field({"centred", "", "Whether it is centred."}, centred);
    v.field({"label", "", "A label."}, label);
    v.field({"limit", "", "A limit.", std::nullopt, 10.0}, limit);
    v.field({"count", "", "A count.", 0.0}, count);
    v.field({"names", "", "Names."}, names);
    v.field({"mode", "", "How."}, kModes, mode);
  }
};

/// Changes the choice, as the reader of a configuration does.
class SetChoice final : public IdleVisitor {
 protected:
  void choice(const FieldInfo&, std::span<const std::string_view> names, int& index) override {
    EXPECT_EQ(names[static_cast<std::size_t>(index)], "exact");
    index = 0;
  }
};

void expect_refused(const SampleOptions& options, const std::string& where,
                    const std::string& problem, const std::string& remedy) {
  expect_error<ConfigError>([&] { checked(options); }, where, problem, remedy);
}

TEST(Options, NumbersOutOfRangeAreRefused) {
  expect_refused({.width = 1.5}, "sample.width", "1.5 is out of range", "between 0 and 1");
  expect_refused({.order = 0}, "sample.order", "0 is out of range", "at least 1");
  expect_refused({.limit = 11.0}, "sample.limit", "11 is out of range", "at most 10");
  expect_refused({.count = -1}, "sample.count", "-1 is out of range", "at least 0");
}

TEST(Options, NumbersThatAreNotFiniteAreRefused) {
  expect_refused({.width = std::numeric_limits<double>::quiet_NaN()}, "sample.width",
                 "nan is out of range", "between 0 and 1");
  expect_refused({.limit = -std::numeric_limits<double>::infinity()}, "sample.limit",
                 "-inf is out of range", "at most 10");
}

TEST(Options, AValueThatIsNoChoiceIsRefused) {
  expect_refused({.mode = static_cast<Mode>(2)}, "sample.mode", "2 is out of range",
                 "between 0 and 1");
}

TEST(Options, AVisitorChangesAChoice) {
  SampleOptions options;
  SetChoice visitor;
  options.describe(visitor);
  EXPECT_EQ(options.mode, Mode::Fast);
}

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
