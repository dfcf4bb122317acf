// SPDX-License-Identifier: MIT
#include "model/expressions/formula_error.hpp"

#include <gtest/gtest.h>

#include <string>

namespace lacuna {
namespace {

TEST(FormulaError, ShowsFormulaAndColumn) {
  const FormulaError error("x*q", 3, "unknown name 'q'", "use x");
  EXPECT_EQ(error.column(), 3u);
  EXPECT_STREQ(error.what(), "term 'x*q', column 3: unknown name 'q'; use x");
}

TEST(FormulaError, StaysOnOneShortLine) {
  const FormulaError error("a\n\tb" + std::string(200, 'c'), 2, "problem", "");
  const std::string text = error.what();
  EXPECT_EQ(text.rfind("term 'a  bccc", 0), 0u);
  EXPECT_NE(text.find("c...', column 2: problem"), std::string::npos);
  EXPECT_LT(text.size(), 100u);
}

}  // namespace
}  // namespace lacuna
