// SPDX-License-Identifier: MIT
#include "lacuna/core/base/names.hpp"

#include <gtest/gtest.h>

#include "lacuna/core/base/error.hpp"
#include "lacuna/model/expressions/expression.hpp"

namespace lacuna {
namespace {

TEST(Names, IdentifiersStartWithALetter) {
  for (const char* name : {"x", "x_1", "_x", "Th2"}) EXPECT_TRUE(is_identifier(name)) << name;
  for (const char* name : {"", "1x", "x y", "x-y", "\xcf\x86"})
    EXPECT_FALSE(is_identifier(name)) << name;
}

TEST(Names, EveryFunctionOfTheLanguageIsReserved) {
  for (const char* name :
       {"sin", "cos", "tan", "asin", "acos", "atan", "tanh", "exp", "log", "sqrt", "abs",
        "sign", "min", "max", "step", "clip", "delay", "pi", "t"})
    EXPECT_TRUE(is_reserved_name(name)) << name;
  EXPECT_FALSE(is_reserved_name("x"));
}

TEST(Names, AReservedNameIsNoVariable) {
  EXPECT_THROW(Expression::variable("sin"), ModelError);
  EXPECT_EQ(Expression::variable("t").name(), "t");
}

}  // namespace
}  // namespace lacuna
