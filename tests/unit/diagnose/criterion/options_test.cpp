// SPDX-License-Identifier: MIT
#include "lacuna/diagnose/criterion/options.hpp"

#include <gtest/gtest.h>

#include <set>

#include "cli/configuration/description.hpp"
#include "lacuna/cli/configuration/registry.hpp"

namespace lacuna {
namespace {

TEST(DecisionOptions, AreDescribedOneByOne) {
  const auto described = describe_options(StandardDecision{});
  std::set<std::string> names;
  for (const OptionDescription& option : described) {
    EXPECT_TRUE(names.insert(option.name).second) << option.name << " twice";
    EXPECT_GT(option.text.size(), 20u) << option.name;
    EXPECT_FALSE(option.range.empty()) << option.name;
  }
  EXPECT_TRUE(names.contains("significance"));
}

TEST(DecisionOptions, StayInTheirRanges) {
  DecisionOptions options;
  options.major = 1.5;
  EXPECT_THROW(StandardDecision{options}, ConfigError);
}

}  // namespace
}  // namespace lacuna
