// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "lacuna/model/equations/term.hpp"

namespace lacuna {
namespace {

const Variables kSpace{{"x", "y", "z"}, {}};

Index operations(const std::vector<std::string>& formulas) {
  std::vector<Expression> expressions;
  for (const std::string& formula : formulas) expressions.push_back(parse_expression(formula));
  return Program(expressions, kSpace).operations();
}

TEST(ProgramBuilder, IntegerPowersAreProducts) {
  EXPECT_EQ(operations({"x^2"}), 1);
  EXPECT_EQ(operations({"x^2*y*z"}), 3);
  EXPECT_EQ(operations({"x^2*y*z", "x^2*y", "x^2", "x", "1"}), 3);
  EXPECT_EQ(operations({"x^5", "x^4", "x^3", "x^2"}), 4);
  EXPECT_LE(operations({"x^64"}), 20);
  EXPECT_EQ(operations({"x^-1"}), 1);
  EXPECT_EQ(operations({"x^-2", "x^2"}), 2);
}

TEST(ProgramBuilder, EverythingIsComputedOnce) {
  EXPECT_EQ(operations({"sin(x*y)", "cos(y*x)", "exp(-(x*y))"}), 5);
  EXPECT_EQ(operations({"x+y", "y+x"}), 1);
  EXPECT_EQ(operations({"x-y", "y-x"}), 2);
  EXPECT_EQ(operations({"delay(x,1)*y", "y*delay(x,1)"}), 1);
}

TEST(ProgramBuilder, ConstantsAreFolded) {
  EXPECT_EQ(operations({"2*pi*50"}), 0);
  EXPECT_EQ(operations({"sin(2*pi*50*t+3.66519143)"}), 3);
  EXPECT_EQ(operations({"clip(3,0,1)+x"}), 1);
}

TEST(ProgramBuilder, AMonomialLibraryIsOneProductPerTerm) {
  TermLibrary library{kSpace, {}};
  for (int i = 0; i <= 5; ++i)
    for (int j = 0; i + j <= 5; ++j)
      for (int k = 0; i + j + k <= 5; ++k)
        library.terms.push_back(Term::monomial({i, j, k, 0}, kSpace));
  EXPECT_EQ(library.size(), 56);
  EXPECT_EQ(library.compile().operations(), 56 - 4);
}

}  // namespace
}  // namespace lacuna
