// SPDX-License-Identifier: MIT
#include "model/expressions/value_numbering.hpp"

#include <gtest/gtest.h>

namespace lacuna {
namespace {

TEST(ValueNumbering, EqualValuesHaveOneNumber) {
  ValueNumbering numbering;
  const int x = numbering.slot(0), y = numbering.slot(1);
  EXPECT_NE(x, y);
  EXPECT_EQ(numbering.slot(0), x);
  EXPECT_EQ(numbering.operation(Operation::Add, {x, y, -1}),
            numbering.operation(Operation::Add, {y, x, -1}));
  EXPECT_NE(numbering.operation(Operation::Subtract, {x, y, -1}),
            numbering.operation(Operation::Subtract, {y, x, -1}));
  EXPECT_EQ(numbering.values().size(), 5u);
  EXPECT_NE(numbering.number(0.0), numbering.number(-0.0)) << "1/0 and 1/-0 differ";
}

TEST(ValueNumbering, OperandsStandInFront) {
  ValueNumbering numbering;
  const int x = numbering.slot(0);
  numbering.operation(Operation::Sin, {numbering.power(x, numbering.number(5.0)), -1, -1});
  const std::vector<ProgramValue>& values = numbering.values();
  ASSERT_FALSE(values.empty());
  for (std::size_t i = 0; i < values.size(); ++i)
    if (!values[i].is_leaf()) {
      for (const int operand : values[i].operands) EXPECT_LT(operand, static_cast<int>(i));
    }
}

TEST(ValueNumbering, OperationsOnNumbersAreNumbers) {
  ValueNumbering numbering;
  const int six = numbering.operation(Operation::Multiply,
                                      {numbering.number(2.0), numbering.number(3.0), -1});
  EXPECT_EQ(six, numbering.number(6.0));
  EXPECT_EQ(numbering.values()[static_cast<std::size_t>(six)].number(), 6.0);
}

TEST(ValueNumbering, PowersAreWhatIsCheapest) {
  ValueNumbering numbering;
  const int x = numbering.slot(0);
  const auto operation_of_power = [&](double exponent) {
    const int value = numbering.power(x, numbering.number(exponent));
    return numbering.values()[static_cast<std::size_t>(value)].operation;
  };
  EXPECT_EQ(numbering.power(x, numbering.number(1.0)), x);
  EXPECT_EQ(numbering.power(x, numbering.number(0.0)), numbering.number(1.0));
  EXPECT_EQ(operation_of_power(3.0), Operation::Multiply);
  EXPECT_EQ(operation_of_power(-3.0), Operation::Divide);
  EXPECT_EQ(operation_of_power(0.5), Operation::Sqrt);
  EXPECT_EQ(operation_of_power(1.5), Operation::Power);
  EXPECT_EQ(operation_of_power(2000.0), Operation::Power);
}

}  // namespace
}  // namespace lacuna
