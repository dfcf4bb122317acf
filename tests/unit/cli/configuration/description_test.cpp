// SPDX-License-Identifier: MIT
#include "cli/configuration/description.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lacuna/solvers/stlsq.hpp"

namespace lacuna {
namespace {

using ::testing::HasSubstr;

TEST(Description, ListsOptionsWithTypeRangeAndDefault) {
  const Registry registry = default_registry();
  const auto options = describe_options(registry.find("differentiator", "savitzky-golay"));
  ASSERT_GE(options.size(), 2u);
  EXPECT_EQ(options[0].name, "window");
  EXPECT_EQ(options[0].type, "whole number or none");
  EXPECT_EQ(options[0].unit, "samples");
  EXPECT_THAT(options[0].range, HasSubstr(".."));
  EXPECT_EQ(options[1].name, "degree");
  EXPECT_EQ(options[1].type, "whole number");
  EXPECT_FALSE(options[1].value.empty());
}

TEST(Description, ShowsPresentValuesOfAStage) {
  StlsqOptions present;
  present.threshold = 0.125;
  const auto options = describe_options(Stlsq(present));
  EXPECT_EQ(options[0].value, "0.125");
  EXPECT_EQ(options[1].type, "one of contribution, coefficient");
}

TEST(Description, IsReadableText) {
  const Registry registry = default_registry();
  const std::string text = format_description(registry.find("regressor", "irls-l1"));
  EXPECT_THAT(text, HasSubstr("irls-l1 (regressor)"));
  EXPECT_THAT(text, HasSubstr("Karimov"));
  EXPECT_THAT(text, HasSubstr("inner  (l1-solver; default coordinate-descent)"));
  EXPECT_THAT(format_description(registry.find("regressor", "ols")), HasSubstr("no options"));
}

}  // namespace
}  // namespace lacuna
