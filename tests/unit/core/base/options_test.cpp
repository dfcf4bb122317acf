// SPDX-License-Identifier: MIT
#include "lacuna/core/base/options.hpp"

#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "support/expect_error.hpp"

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

TEST(Options, DefaultsAreAccepted) {
  EXPECT_EQ(checked(SampleOptions{}).order, 4);
  EXPECT_NO_THROW(checked(SampleOptions{.width = 1.0, .limit = -100.0, .count = 0}));
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

}  // namespace
}  // namespace lacuna
