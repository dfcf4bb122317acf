// SPDX-License-Identifier: MIT
#include "lacuna/model/expressions/program.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "lacuna/core/base/error.hpp"
#include "unit/model/expressions/random_expression.hpp"

namespace lacuna {
namespace {

const Variables kDrivenPlane{{"x", "y"}, {"u"}};

Program compile(const std::vector<std::string>& formulas) {
  std::vector<Expression> expressions;
  for (const std::string& formula : formulas) expressions.push_back(parse_expression(formula));
  return Program(expressions, kDrivenPlane);
}

std::vector<double> evaluate(const Program& program, const std::vector<double>& slots) {
  std::vector<double> out(static_cast<std::size_t>(program.outputs()));
  Program::Workspace workspace;
  program.evaluate(slots.data(), out.data(), workspace);
  return out;
}

TEST(Program, EvaluatesSlotsConstantsAndRepeatedOutputs) {
  const Program program = compile({"x", "1", "x*y", "u-t", "x*y", "2*3+x"});
  EXPECT_EQ(program.slots(), 4);
  EXPECT_EQ(program.outputs(), 6);
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(evaluate(compile({"1/0", "1/(-0)"}), {0.0, 0.0, 0.0, 0.0}),
            (std::vector<double>{kInfinity, -kInfinity}));
  EXPECT_EQ(evaluate(program, {2.0, 3.0, 5.0, 7.0}),
            (std::vector<double>{2.0, 1.0, 6.0, -2.0, 6.0, 8.0}));
}

TEST(Program, DelayedVariablesGetSlotsBehindTheVariables) {
  const Program program = compile({"x+delay(y,0.5)", "delay(x,1)*delay(y,0.5)"});
  const std::vector<DelayedVariable> expected{{1, 0.5}, {0, 1.0}};
  EXPECT_EQ(program.delays(), expected);
  EXPECT_EQ(program.slots(), 6);
  EXPECT_EQ(evaluate(program, {1.0, 2.0, 0.0, 0.0, 10.0, 20.0}),
            (std::vector<double>{11.0, 200.0}));
}

TEST(Program, NamesAnUnknownVariable) {
  try {
    compile({"x*theta"});
    FAIL();
  } catch (const ModelError& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("unknown name 'theta'"));
  }
}

/// The formula's value by plain recursion over the tree.
double reference(const Expression& e, const std::vector<double>& slots,
                 const Program& program) {
  static const std::vector<std::string> kNames{"x", "y", "th_1", "_u", "t"};
  const auto slot = [&](const std::string& name) {
    return static_cast<Index>(std::find(kNames.begin(), kNames.end(), name) - kNames.begin());
  };
  if (e.operation() == Operation::Number) return e.value();
  if (e.operation() == Operation::Variable)
    return slots[static_cast<std::size_t>(slot(e.name()))];
  if (e.operation() == Operation::Delay) {
    const DelayedVariable wanted{slot(e.name()), e.value()};
    const auto& delays = program.delays();
    const auto place = std::find(delays.begin(), delays.end(), wanted) - delays.begin();
    return slots[kNames.size() + static_cast<std::size_t>(place)];
  }
  std::vector<double> v;
  for (const Expression& operand : e.operands())
    v.push_back(reference(operand, slots, program));
  switch (e.operation()) {
    case Operation::Add:
      return v[0] + v[1];
    case Operation::Subtract:
      return v[0] - v[1];
    case Operation::Multiply:
      return v[0] * v[1];
    case Operation::Divide:
      return v[0] / v[1];
    case Operation::Power:
      return std::pow(v[0], v[1]);
    case Operation::Negate:
      return -v[0];
    case Operation::Sin:
      return std::sin(v[0]);
    default:
      return std::nan("");
  }
}

bool is_algebraic(const Expression& e) {
  if (!e.operands().empty() && e.operation() > Operation::Sin) return false;
  for (const Expression& operand : e.operands())
    if (!is_algebraic(operand)) return false;
  return true;
}

TEST(Program, AgreesWithPlainRecursion) {
  Random random(3);
  const Variables variables{{"x", "y", "th_1"}, {"_u"}};
  int compared = 0;
  for (int i = 0; i < 20000; ++i) {
    const Expression e = testing::random_expression(random, 3);
    if (!is_algebraic(e) || e.operands().empty()) continue;
    const Program program({&e, 1}, variables);
    std::vector<double> slots(static_cast<std::size_t>(program.slots()));
    for (double& slot : slots) slot = random.uniform(0.5, 1.5);
    const double expected = reference(e, slots, program);
    const double actual = evaluate(program, slots)[0];
    if (!std::isfinite(expected)) continue;
    EXPECT_NEAR(actual, expected, 1e-12 * std::max(1.0, std::abs(expected))) << e.to_string();
    ++compared;
  }
  EXPECT_GT(compared, 300);
}

TEST(Program, TilesGiveWhatSingleStatesGive) {
  const Program program = compile({"x^2*y", "1", "u", "sin(x)*exp(-y)", "x^2*y", "max(x,y)^-1",
                                   "clip(u,-0.1,0.1)+delay(x,1)", "step(x-y)"});
  constexpr Index kRows = 3 * 128 + 17;
  const Matrix all = Matrix::Random(kRows + 5, program.slots() + 2);
  const auto slots = all.block(2, 1, kRows, program.slots());
  Matrix wide = Matrix::Zero(kRows + 3, program.outputs());
  Program::Workspace workspace;
  program.evaluate(slots, wide.middleRows(1, kRows), workspace);
  EXPECT_TRUE((wide.row(0).array() == 0.0).all() && (wide.bottomRows(2).array() == 0.0).all());
  for (Index row = 0; row < kRows; ++row) {
    const Vector state = slots.row(row);
    Vector expected(program.outputs());
    program.evaluate(state.data(), expected.data(), workspace);
    ASSERT_EQ(Vector(wide.row(row + 1)), expected) << row;
  }
}

TEST(Program, OneWorkspaceServesManyPrograms) {
  const Program small = compile({"x+1"});
  const Program large = compile({"x^9*y^9+u^9", "sin(x)", "7*x"});
  Program::Workspace workspace;
  const Matrix slots = Matrix::Constant(300, 4, 2.0);
  for (int i = 0; i < 2; ++i) {
    Matrix a(300, 1);
    Matrix b(300, 3);
    small.evaluate(slots, a, workspace);
    large.evaluate(slots, b, workspace);
    EXPECT_TRUE((a.array() == 3.0).all());
    EXPECT_TRUE((b.col(0).array() == 262144.0 + 512.0).all());
    EXPECT_TRUE((b.col(2).array() == 14.0).all());
  }
}

TEST(Program, ChecksShapes) {
  const Program program = compile({"x"});
  Program::Workspace workspace;
  Matrix out(3, 1);
  EXPECT_THROW(program.evaluate(Matrix::Zero(3, 3), out, workspace), ArgumentError);
  EXPECT_THROW(program.evaluate(Matrix::Zero(2, 4), out, workspace), ArgumentError);
  Matrix two(3, 2);
  EXPECT_THROW(program.evaluate(Matrix::Zero(3, 4), two, workspace), ArgumentError);
}

/// Whether a block shows to the bit what a program makes of these slots.
::testing::AssertionResult shows(const Program& program, const Program::Block& block,
                                 const Matrix& slots) {
  Matrix expected(slots.rows(), program.outputs());
  Program::Workspace workspace;
  program.evaluate(slots, expected, workspace);
  for (Index k = 0; k < program.outputs(); ++k)
    if (std::memcmp(program.output(k, block), expected.col(k).data(),
                    sizeof(double) * static_cast<std::size_t>(slots.rows())) != 0)
      return ::testing::AssertionFailure() << "output " << k << " differs";
  return ::testing::AssertionSuccess();
}

/// Moves slots at random, about every third one.
Program::SlotSet change_some(Random& random, Matrix& slots) {
  Program::SlotSet changed = 0;
  for (Index slot = 0; slot < slots.cols(); ++slot) {
    if (random.below(3) != 0) continue;
    changed |= Program::slot_set(slot);
    for (double& value : slots.col(slot)) value = random.uniform(-2.0, 2.0);
  }
  return changed;
}

Matrix random_slots(Random& random, Index rows, Index count) {
  Matrix slots(rows, count);
  for (double& value : slots.reshaped()) value = random.uniform(-2.0, 2.0);
  return slots;
}

TEST(ProgramBlock, ChangedSlotsGiveWhatAllSlotsGive) {
  Random random(5);
  const Variables variables{{"x", "y", "th_1"}, {"_u"}};
  for (int i = 0; i < 500; ++i) {
    std::vector<Expression> outputs{parse_expression("x"), parse_expression("2*3")};
    for (int k = 0; k < 4; ++k) outputs.push_back(testing::random_expression(random, 4));
    outputs.push_back(outputs.back());
    const Program program(outputs, variables);
    const Index rows = 1 + static_cast<Index>(random.below(40));
    Matrix slots = random_slots(random, rows, program.slots());
    Program::Block block(program, rows);
    program.evaluate(slots, block);
    ASSERT_TRUE(shows(program, block, slots)) << i;
    for (int turn = 0; turn < 6; ++turn) {
      const Program::SlotSet changed = change_some(random, slots);
      program.evaluate_changed(slots, changed, block);
      ASSERT_TRUE(shows(program, block, slots)) << i << ", turn " << turn;
    }
  }
}

TEST(ProgramBlock, SlotsBeyondTheLastBitShareIt) {
  Random random(6);
  Variables many;
  std::vector<Expression> outputs;
  for (int i = 0; i < 90; ++i) many.states.push_back("x" + std::to_string(i));
  for (int i = 0; i < 90; ++i)
    outputs.push_back(parse_expression("sin(x" + std::to_string(i) + ")*x" +
                                       std::to_string((7 * i) % 90)));
  const Program program(outputs, many);
  Matrix slots = random_slots(random, 20, program.slots());
  Program::Block block(program, 20);
  program.evaluate(slots, block);
  for (int turn = 0; turn < 30; ++turn) {
    program.evaluate_changed(slots, change_some(random, slots), block);
    ASSERT_TRUE(shows(program, block, slots)) << turn;
  }
  slots.col(80).setConstant(0.25);
  program.evaluate_changed(slots, Program::slot_set(80), block);
  EXPECT_TRUE(shows(program, block, slots));
}

TEST(ProgramBlock, KeepsItsValuesWhateverElseIsDone) {
  const std::vector<std::string> formulas{"x", "x*y+sin(u)", "exp(-y)", "u"};
  Program program = compile(formulas);
  Matrix slots = Matrix::Random(7, 4);
  Program::Block block(program, 7), other(program, 7);
  program.evaluate(slots, block);
  const Program::Block copy = block;
  const Matrix before = slots;
  slots.setRandom();
  program.evaluate(slots, other);
  EXPECT_TRUE(shows(program, block, before)) << "it does not show the slots, it has them";
  slots = before;
  slots.col(0).setConstant(3.0);
  const Program moved = std::move(program);
  moved.evaluate_changed(slots, Program::slot_set(0), block);
  EXPECT_TRUE(shows(moved, block, slots));
  EXPECT_TRUE(shows(moved, copy, before));
}

TEST(ProgramBlock, ComputesOnlyWhatHasChanged) {
  const Program program = compile({"sin(u)", "x+y"});
  Matrix slots = Matrix::Constant(3, 4, 1.0);
  Program::Block block(program, 3);
  program.evaluate(slots, block);
  slots.setConstant(2.0);
  program.evaluate_changed(slots, Program::slot_set(0), block);
  EXPECT_EQ(program.output(0, block)[1], std::sin(1.0)) << "nothing was said of u";
  EXPECT_EQ(program.output(1, block)[1], 3.0) << "nothing was said of y";
  program.evaluate_changed(slots, 0, block);
  EXPECT_EQ(program.output(1, block)[1], 3.0);
}

TEST(ProgramBlock, ChecksShapes) {
  const Program program = compile({"x"});
  Program::Block block(program, 3);
  EXPECT_EQ(block.rows(), 3);
  EXPECT_THROW(program.evaluate_changed(Matrix::Zero(3, 4), 1, block), ArgumentError)
      << "it has not been evaluated";
  EXPECT_THROW(program.evaluate(Matrix::Zero(2, 4), block), ArgumentError);
  EXPECT_THROW(program.evaluate(Matrix::Zero(3, 3), block), ArgumentError);
  for (const Index rows : {Index{-1}, Program::kBlockRows + 1})
    EXPECT_THROW(Program::Block(program, rows), ArgumentError);
}

TEST(Program, KnowsWhetherItIsAffineInItsDelays) {
  const auto is_affine = [](const std::string& text) {
    const Expression formula = parse_expression(text);
    const Program program({&formula, 1}, {{"x"}, {"u"}});
    return program.delays().front().affine;
  };
  EXPECT_TRUE(is_affine("2*x*delay(u,0.1)-u"));
  EXPECT_TRUE(is_affine("-delay(u,0.1)/(1+x^2)+sin(x)"));
  EXPECT_FALSE(is_affine("delay(u,0.1)^2"));
  EXPECT_FALSE(is_affine("delay(u,0.1)*delay(x,0.2)"));
  EXPECT_FALSE(is_affine("x/delay(u,0.1)"));
  EXPECT_FALSE(is_affine("sqrt(delay(u,0.1))"));
}

}  // namespace
}  // namespace lacuna
