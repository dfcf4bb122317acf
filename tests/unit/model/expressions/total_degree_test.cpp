// SPDX-License-Identifier: MIT
#include "model/expressions/total_degree.hpp"

#include <gtest/gtest.h>

namespace lacuna {
namespace {

TEST(TotalDegree, CountsVariablesAndFunctions) {
  const std::pair<const char*, int> cases[] = {
      {"3", 0},       {"pi*2", 0},    {"sin(2)", 0},     {"2^3", 0},
      {"x", 1},       {"-x", 1},      {"x*y*x", 3},      {"x^2*y", 3},
      {"x/y", 2},     {"x^-2", 2},    {"2*x^2-1", 2},    {"(2*x^2-1)*y", 3},
      {"x^0.5", 1},   {"sin(x*y)", 1}, {"x*sin(x*y)", 2}, {"delay(x,0.5)*x", 2},
      {"2^x", 1},     {"x^1e9", 1000}};
  ASSERT_FALSE(std::empty(cases));
  for (const auto& [text, degree] : cases)
    EXPECT_EQ(total_degree(parse_expression(text)), degree) << text;
}

}  // namespace
}  // namespace lacuna
