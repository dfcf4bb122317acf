// SPDX-License-Identifier: MIT
#include "bases/term_list.hpp"

#include <gtest/gtest.h>

#include "lacuna/core/base/error.hpp"

namespace lacuna {
namespace {

TEST(ParseTermList, KeepsTheOrder) {
  const auto terms = parse_term_list("here", {"x*x", "1"}, {{"x"}, {}});
  ASSERT_EQ(terms.size(), 2u);
  EXPECT_EQ(terms[0].name(), "x^2");
  EXPECT_EQ(terms[1].name(), "1");
}

TEST(ParseTermList, SaysWhichEntryIsWrong) {
  try {
    parse_term_list("here", {"x", "x+nowhere"}, {{"x"}, {}});
    FAIL();
  } catch (const ModelError& error) {
    EXPECT_EQ(error.where(), "here[1], term 'x+nowhere', column 3");
  }
}

}  // namespace
}  // namespace lacuna
