// SPDX-License-Identifier: MIT
#include "cli/commands/assignments.hpp"

#include "lacuna/core/base/error.hpp"
#include "support/expect_error.hpp"

namespace lacuna::cli {
namespace {

constexpr AssignmentForm kForm{"--map", "NAME=COLUMN", "--map th=Winkel"};

TEST(Assignments, NameBothWhereOneIsGivenTwice) {
  testing::expect_error<ConfigError>(
      [] {
        read_assignments(kForm, {"a=1,b=2", "a=3"});
      },
      "--map a=3", "'a' is given twice, first in 'a=1'", "keep");
  testing::expect_error<ConfigError>([] { read_assignments(kForm, {"a=1,a=1"}); }, "--map a=1",
                                     "twice", "keep one");
}

}  // namespace
}  // namespace lacuna::cli
