// SPDX-License-Identifier: MIT
#include "program_builder.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <tuple>
#include <utility>

#include "lacuna/core/error.hpp"
#include "lacuna/core/text.hpp"
#include "operations.hpp"

namespace lacuna {
namespace {

/// Powers up to here are chains of products that lower powers share; higher ones are halved.
constexpr int kLongestChain = 16;

/// Integer powers beyond it are left to std::pow.
constexpr int kLargestProduct = 1024;

bool is_commutative(Operation operation) {
  return operation == Operation::Add || operation == Operation::Multiply;
}

bool is_leaf(Operation operation) {
  return operation == Operation::Number || operation == Operation::Variable;
}

}  // namespace

ProgramBuilder::ProgramBuilder(std::span<const Expression> outputs, const Variables& variables)
    : names_(variables.names()) {
  for (const Expression& output : outputs) collect_delays(output);
  for (const Expression& output : outputs) outputs_.push_back(value_of(output));
}

void ProgramBuilder::move_into(Program& program) {
  program.slot_count_ = static_cast<Index>(names_.size() + delays_.size());
  const std::vector<bool> needed = needed_values();
  const std::vector<int> order = scheduled(needed);
  assign_registers(program, needed);
  emit(program, order);
  emit_outputs(program);
  program.delays_ = std::move(delays_);
}

void ProgramBuilder::collect_delays(const Expression& expression) {
  if (expression.operation() == Operation::Delay) {
    if (!expression.operands().empty())
      throw ModelError(expression.to_string(), "the delay has no number yet",
                       "bind its parameters: substitute() numbers for their names");
    const DelayedVariable delayed{slot_of(expression), expression.value()};
    if (std::find(delays_.begin(), delays_.end(), delayed) == delays_.end())
      delays_.push_back(delayed);
  }
  for (const Expression& operand : expression.operands()) collect_delays(operand);
}

Index ProgramBuilder::slot_of(const Expression& variable) const {
  const auto found = std::find(names_.begin(), names_.end(), variable.name());
  if (found == names_.end())
    throw ModelError("expression", "unknown name '" + variable.name() + "'",
                     suggestion(variable.name(), names_));
  return found - names_.begin();
}

int ProgramBuilder::slot_of_delay(const Expression& delayed) const {
  const DelayedVariable wanted{slot_of(delayed), delayed.value()};
  const auto found = std::find(delays_.begin(), delays_.end(), wanted);
  return static_cast<int>(names_.size()) + static_cast<int>(found - delays_.begin());
}

int ProgramBuilder::value_of(const Expression& expression) {
  const auto known = translated_.find(expression);
  if (known != translated_.end()) return known->second;
  const int value = translate(expression);
  translated_.emplace(expression, value);
  return value;
}

int ProgramBuilder::translate(const Expression& expression) {
  switch (expression.operation()) {
    case Operation::Number:
      return number(expression.value());
    case Operation::Variable:
      return slot(static_cast<int>(slot_of(expression)));
    case Operation::Delay:
      return slot(slot_of_delay(expression));
    case Operation::Power:
      return translate_power(expression);
    default:
      break;
  }
  std::array<int, 3> operands{-1, -1, -1};
  std::size_t count = 0;
  for (const Expression& operand : expression.operands()) operands[count++] = value_of(operand);
  return operation(expression.operation(), operands);
}

int ProgramBuilder::translate_power(const Expression& expression) {
  const int base = value_of(expression.operands()[0]);
  const int exponent = value_of(expression.operands()[1]);
  if (!is_number(exponent)) return operation(Operation::Power, {base, exponent, -1});
  const double power = number_of(exponent);
  if (power == 0.5) return operation(Operation::Sqrt, {base, -1, -1});
  if (power != std::floor(power) || std::abs(power) > kLargestProduct)
    return operation(Operation::Power, {base, exponent, -1});
  const int product = integer_power(base, static_cast<int>(std::abs(power)));
  if (power >= 0.0) return product;
  return operation(Operation::Divide, {number(1.0), product, -1});
}

int ProgramBuilder::slot(int index) { return intern({Operation::Variable, {index, 0, 0}, 0}); }

int ProgramBuilder::number(double value) {
  return intern({Operation::Number, {0, 0, 0}, std::bit_cast<std::uint64_t>(value)});
}

int ProgramBuilder::operation(Operation operation, std::array<int, 3> operands) {
  const auto count = static_cast<std::size_t>(arity(operation));
  std::array<double, 3> constants{};
  bool constant = true;
  for (std::size_t i = 0; i < count; ++i) {
    constant = constant && is_number(operands[i]);
    if (constant) constants[i] = number_of(operands[i]);
  }
  if (constant) return number(apply_operation(operation, constants));
  if (is_commutative(operation) && operands[0] > operands[1])
    std::swap(operands[0], operands[1]);
  for (std::size_t i = count; i < operands.size(); ++i) operands[i] = operands[0];
  return intern({operation, operands, 0});
}

int ProgramBuilder::integer_power(int base, int exponent) {
  if (exponent == 0) return number(1.0);
  if (exponent == 1) return base;
  const int lower = exponent <= kLongestChain ? exponent - 1 : exponent / 2;
  const int first = integer_power(base, lower);
  return operation(Operation::Multiply, {first, integer_power(base, exponent - lower), -1});
}

int ProgramBuilder::intern(const Value& value) {
  const auto [place, is_new] =
      numbers_of_values_.try_emplace(value, static_cast<int>(values_.size()));
  if (is_new) values_.push_back(value);
  return place->second;
}

bool ProgramBuilder::is_number(int value) const {
  return values_[static_cast<std::size_t>(value)].operation == Operation::Number;
}

double ProgramBuilder::number_of(int value) const {
  return std::bit_cast<double>(values_[static_cast<std::size_t>(value)].bits);
}

std::vector<bool> ProgramBuilder::needed_values() const {
  std::vector<bool> needed(values_.size(), false);
  for (const int output : outputs_) needed[static_cast<std::size_t>(output)] = true;
  for (std::size_t i = values_.size(); i-- > 0;) {
    if (!needed[i] || is_leaf(values_[i].operation)) continue;
    for (const int operand : values_[i].operands)
      needed[static_cast<std::size_t>(operand)] = true;
  }
  return needed;
}

std::vector<int> ProgramBuilder::levels() const {
  std::vector<int> levels(values_.size(), 0);
  for (std::size_t i = 0; i < values_.size(); ++i) {
    if (is_leaf(values_[i].operation)) continue;
    for (const int operand : values_[i].operands)
      levels[i] = std::max(levels[i], levels[static_cast<std::size_t>(operand)] + 1);
  }
  return levels;
}

/// Operations by level, so that operands come first, and within a level by kind, so that equal
/// operations run in one loop.
std::vector<int> ProgramBuilder::scheduled(const std::vector<bool>& needed) const {
  const std::vector<int> level = levels();
  std::vector<int> order;
  for (std::size_t i = 0; i < values_.size(); ++i)
    if (needed[i] && !is_leaf(values_[i].operation)) order.push_back(static_cast<int>(i));
  std::stable_sort(order.begin(), order.end(), [&](int p, int q) {
    const auto a = static_cast<std::size_t>(p);
    const auto b = static_cast<std::size_t>(q);
    return std::tie(level[a], values_[a].operation) < std::tie(level[b], values_[b].operation);
  });
  return order;
}

void ProgramBuilder::assign_registers(Program& program, const std::vector<bool>& needed) {
  registers_.assign(values_.size(), 0);
  for (std::size_t i = 0; i < values_.size(); ++i) {
    if (values_[i].operation == Operation::Variable) registers_[i] = values_[i].operands[0];
    if (values_[i].operation != Operation::Number || !needed[i]) continue;
    registers_[i] =
        static_cast<int>(program.slot_count_) + static_cast<int>(program.constants_.size());
    program.constants_.push_back(std::bit_cast<double>(values_[i].bits));
  }
}

void ProgramBuilder::emit(Program& program, const std::vector<int>& order) {
  const auto reg = [this](int value) { return registers_[static_cast<std::size_t>(value)]; };
  program.register_count_ =
      static_cast<std::size_t>(program.slot_count_) + program.constants_.size();
  for (const int index : order) {
    const Value& value = values_[static_cast<std::size_t>(index)];
    const int target = static_cast<int>(program.register_count_++);
    registers_[static_cast<std::size_t>(index)] = target;
    const std::size_t position = program.instructions_.size();
    if (program.runs_.empty() || program.runs_.back().operation != value.operation)
      program.runs_.push_back({value.operation, position, position});
    program.runs_.back().end = position + 1;
    program.instructions_.push_back(
        {target, reg(value.operands[0]), reg(value.operands[1]), reg(value.operands[2])});
  }
}

void ProgramBuilder::emit_outputs(Program& program) const {
  const int first_result =
      static_cast<int>(program.slot_count_) + static_cast<int>(program.constants_.size());
  std::vector<bool> shown(program.register_count_, false);
  for (const int output : outputs_) {
    const int source = registers_[static_cast<std::size_t>(output)];
    const Program::Output entry{static_cast<Index>(program.outputs_.size()), source};
    const bool in_place = source >= first_result && !shown[static_cast<std::size_t>(source)];
    shown[static_cast<std::size_t>(source)] = true;
    (in_place ? program.written_ : program.copied_).push_back(entry);
    program.outputs_.push_back(source);
  }
}

}  // namespace lacuna
