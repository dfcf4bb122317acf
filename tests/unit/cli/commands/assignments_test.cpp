// SPDX-License-Identifier: MIT
#include "cli/commands/assignments.hpp"

#include "lacuna/core/base/error.hpp"
#include "support/expect_error.hpp"

namespace lacuna::cli {
namespace {

constexpr AssignmentForm kForm{"--map", "NAME=COLUMN", "--map th=Winkel"};

TEST(Assignments, AreListsOfNamesAndValues) {
  const auto parts = read_assignments(kForm, {"a = 1, b=max(c,d)", "c="});
  ASSERT_EQ(parts.size(), 3u);
  EXPECT_EQ(parts[0].name, "a");
  EXPECT_EQ(parts[0].value, "1");
  EXPECT_EQ(parts[1].value, "max(c,d)");
  EXPECT_EQ(parts[2].text, "c=");
  EXPECT_EQ(parts[2].value, "");
}

TEST(Assignments, NameBothWhereOneIsGivenTwice) {
  testing::expect_error<ConfigError>(
      [] {
        read_assignments(kForm, {"a=1,b=2", "a=3"});
      },
      "--map a=3", "'a' is given twice, first in 'a=1'", "keep");
  testing::expect_error<ConfigError>([] { read_assignments(kForm, {"a=1,a=1"}); }, "--map a=1",
                                     "twice", "keep one");
}

TEST(Assignments, HaveANameAndAnEqualsSign) {
  for (const char* text : {"a", "=3", "a=1,,b=2"})
    EXPECT_THROW(read_assignments(kForm, {text}), ConfigError) << text;
}

}  // namespace
}  // namespace lacuna::cli
