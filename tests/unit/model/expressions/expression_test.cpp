// SPDX-License-Identifier: MIT
#include "lacuna/model/expressions/expression.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "lacuna/core/base/error.hpp"
#include "unit/model/expressions/random_expression.hpp"

namespace lacuna {
namespace {

const Expression kX = Expression::variable("x");
const Expression kY = Expression::variable("y");

TEST(Expression, OperatorsKeepWhatWasWritten) {
  const Expression e = kX * kX + kY / kX - (-kY);
  EXPECT_EQ(e.operation(), Operation::Subtract);
  EXPECT_EQ(e.operands()[1].operation(), Operation::Negate);
  EXPECT_EQ(e.operands()[0].operands()[0], kX * kX);
  EXPECT_EQ(e.depth(), 3);
}

TEST(Expression, SignInFrontOfANumberIsFolded) {
  EXPECT_EQ(-Expression::number(2.0), Expression::number(-2.0));
  EXPECT_EQ((-Expression::number(2.0)).operation(), Operation::Number);
}

TEST(Expression, EqualityIsStructure) {
  EXPECT_EQ(kX * kY, kX * kY);
  EXPECT_NE(kX * kY, kY * kX);
  EXPECT_NE(kX + kY, kX * kY);
  EXPECT_NE(Expression::number(0.1), Expression::number(0.1 + 1e-17 + 2e-17));
  EXPECT_NE(Expression::delayed("x", 1.0), Expression::delayed("x", 2.0));
  EXPECT_NE(Expression::delayed("x", 1.0), kX);
  EXPECT_EQ((kX * kY).hash(), (kX * kY).hash());
}

TEST(Expression, VariablesAreAllNames) {
  const Expression e = kX * Expression::delayed("u", 1.0) + Expression::number(3.0);
  EXPECT_EQ(e.variables(), (std::set<std::string>{"u", "x"}));
}

TEST(Expression, DelayOfTimeAndDelayOfNothing) {
  EXPECT_EQ(Expression::delayed("t", 2.0), Expression::variable("t") - Expression::number(2.0));
  EXPECT_EQ(Expression::delayed("x", 0.0), kX);
}

TEST(Expression, RejectsWhatIsNoExpression) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  EXPECT_THROW(Expression::number(kInfinity), ModelError);
  EXPECT_THROW(Expression::number(std::numeric_limits<double>::quiet_NaN()), ModelError);
  EXPECT_THROW(Expression::variable("2x"), ModelError);
  EXPECT_THROW(Expression::variable(""), ModelError);
  EXPECT_THROW(Expression::variable("x y"), ModelError);
  EXPECT_THROW(Expression::variable("sin"), ModelError);
  EXPECT_THROW(Expression::variable("pi"), ModelError);
  EXPECT_THROW(Expression::delayed("x", -1.0), ModelError);
  EXPECT_THROW(Expression::delayed("x", kInfinity), ModelError);
}

TEST(Expression, RejectsWrongNumberOfOperands) {
  EXPECT_THROW(Expression::make(Operation::Sin, {}), ModelError);
  EXPECT_THROW(Expression::make(Operation::Add, {kX}), ModelError);
  EXPECT_THROW(Expression::make(Operation::Clip, {kX, kX}), ModelError);
  EXPECT_THROW(Expression::make(Operation::Variable, {}), ModelError);
  EXPECT_THROW(Expression::make(Operation::Delay, {kX, kY}), ModelError);
}

TEST(Expression, DepthIsBoundedAndTheDeepestTreeIsFreed) {
  Expression deep = kX;
  for (int i = 0; i < kMaxExpressionDepth; ++i) deep = deep + kX;
  EXPECT_EQ(deep.depth(), kMaxExpressionDepth);
  EXPECT_FALSE(deep.to_string().empty());
  EXPECT_THROW(deep + kX, ModelError);
}

TEST(Expression, RandomTreesEqualThemselvesOnly) {
  Random random(11);
  for (int i = 0; i < 200; ++i) {
    Random replay = random;
    const Expression e = testing::random_expression(random, 4);
    EXPECT_EQ(e, testing::random_expression(replay, 4));
    EXPECT_NE(e, e + kX);
  }
}

}  // namespace
}  // namespace lacuna
