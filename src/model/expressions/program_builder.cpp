// SPDX-License-Identifier: MIT
#include "program_builder.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <tuple>
#include <unordered_map>
#include <utility>

#include "core/base/text.hpp"
#include "lacuna/core/base/error.hpp"

namespace lacuna {
namespace {

Index slot_of(const Expression& variable, const VariableIndex& names) {
  if (const auto slot = names.find(variable.name())) return *slot;
  throw ModelError("expression", "unknown name '" + variable.name() + "'",
                   suggestion(variable.name(), names.names()));
}

/// Degree of a formula in its delayed variables together: 0, 1, or 2 for whatever is not
/// affine.
int degree_in_delays(const Expression& expression) {
  constexpr int kNotAffine = 2;
  if (expression.operation() == Operation::Delay) return 1;
  int largest = 0, sum = 0, last = 0;
  for (const Expression& operand : expression.operands()) {
    last = degree_in_delays(operand);
    largest = std::max(largest, last);
    sum += last;
  }
  switch (expression.operation()) {
    case Operation::Add:
    case Operation::Subtract:
    case Operation::Negate:
      return largest;
    case Operation::Multiply:
      return std::min(sum, kNotAffine);
    case Operation::Divide:
      return last == 0 ? largest : kNotAffine;
    default:
      return largest == 0 ? 0 : kNotAffine;
  }
}

/// Adds the distinct delayed variables of an expression to those found before.
void collect_delays(const Expression& expression, const VariableIndex& names,
                    std::vector<DelayedVariable>& delays) {
  if (expression.operation() == Operation::Delay) {
    if (!expression.operands().empty())
      throw ModelError(expression.to_string(), "the delay has no number yet",
                       "bind its parameters: substitute() numbers for their names");
    const DelayedVariable delayed{slot_of(expression, names), expression.value()};
    if (std::find(delays.begin(), delays.end(), delayed) == delays.end())
      delays.push_back(delayed);
  }
  for (const Expression& operand : expression.operands())
    collect_delays(operand, names, delays);
}

/// Translates expressions into numbered values, each distinct one once.
class Translator {
 public:
  Translator(const VariableIndex& names, const std::vector<DelayedVariable>& delays)
      : names_(names), delays_(delays) {}

  int value_of(const Expression& expression) {
    const auto known = translated_.find(expression);
    if (known != translated_.end()) return known->second;
    const int value = translate(expression);
    translated_.emplace(expression, value);
    return value;
  }

  const std::vector<ProgramValue>& values() const noexcept { return numbering_.values(); }

 private:
  struct Hash {
    std::size_t operator()(const Expression& e) const noexcept { return e.hash(); }
  };

  int translate(const Expression& expression) {
    if (expression.operation() == Operation::Number)
      return numbering_.number(expression.value());
    if (expression.operation() == Operation::Variable)
      return numbering_.slot(static_cast<int>(slot_of(expression, names_)));
    if (expression.operation() == Operation::Delay)
      return numbering_.slot(slot_of_delay(expression));
    std::array<int, 3> operands{-1, -1, -1};
    std::size_t count = 0;
    for (const Expression& operand : expression.operands())
      operands[count++] = value_of(operand);
    if (expression.operation() == Operation::Power)
      return numbering_.power(operands[0], operands[1]);
    return numbering_.operation(expression.operation(), operands);
  }

  int slot_of_delay(const Expression& delayed) const {
    const DelayedVariable wanted{slot_of(delayed, names_), delayed.value()};
    const auto found = std::find(delays_.begin(), delays_.end(), wanted);
    return static_cast<int>(names_.names().size()) + static_cast<int>(found - delays_.begin());
  }

  const VariableIndex& names_;
  const std::vector<DelayedVariable>& delays_;
  ValueNumbering numbering_;
  std::unordered_map<Expression, int, Hash> translated_;
};

/// Which values the outputs show or are computed from.
std::vector<bool> needed_values(const std::vector<ProgramValue>& values,
                                const std::vector<int>& outputs) {
  std::vector<bool> needed(values.size(), false);
  for (const int output : outputs) needed[static_cast<std::size_t>(output)] = true;
  for (std::size_t i = values.size(); i-- > 0;) {
    if (!needed[i] || values[i].is_leaf()) continue;
    for (const int operand : values[i].operands)
      needed[static_cast<std::size_t>(operand)] = true;
  }
  return needed;
}

/// Slots that each value depends on.
std::vector<Program::SlotSet> dependences(const std::vector<ProgramValue>& values) {
  std::vector<Program::SlotSet> depends(values.size(), 0);
  for (std::size_t i = 0; i < values.size(); ++i)
    if (values[i].operation == Operation::Variable)
      depends[i] = Program::slot_set(values[i].operands[0]);
    else if (!values[i].is_leaf())
      for (const int operand : values[i].operands)
        depends[i] |= depends[static_cast<std::size_t>(operand)];
  return depends;
}

/// Depth of each value: 0 for leaves, else one more than that of its deepest operand.
std::vector<int> levels(const std::vector<ProgramValue>& values) {
  std::vector<int> levels(values.size(), 0);
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (values[i].is_leaf()) continue;
    for (const int operand : values[i].operands)
      levels[i] = std::max(levels[i], levels[static_cast<std::size_t>(operand)] + 1);
  }
  return levels;
}

/// Operations by level, so that operands come first, and within a level by kind, so that equal
/// operations run in one loop.
std::vector<int> scheduled(const std::vector<ProgramValue>& values,
                           const std::vector<bool>& needed) {
  const std::vector<int> level = levels(values);
  std::vector<int> order;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (needed[i] && !values[i].is_leaf()) order.push_back(static_cast<int>(i));
  std::stable_sort(order.begin(), order.end(), [&](int p, int q) {
    const auto a = static_cast<std::size_t>(p);
    const auto b = static_cast<std::size_t>(q);
    return std::tie(level[a], values[a].operation) < std::tie(level[b], values[b].operation);
  });
  return order;
}

}  // namespace

void ProgramBuilder::build(Program& program, std::span<const Expression> outputs,
                           const Variables& variables) {
  const VariableIndex names(variables);
  for (const Expression& output : outputs) collect_delays(output, names, program.delays_);
  const bool affine = program.delays_.empty() ||
                      std::all_of(outputs.begin(), outputs.end(), [](const Expression& output) {
                        return degree_in_delays(output) < 2;
                      });
  for (DelayedVariable& delayed : program.delays_) delayed.affine = affine;
  program.slot_count_ = static_cast<Index>(names.names().size() + program.delays_.size());
  Translator translator(names, program.delays_);
  std::vector<int> shown;
  for (const Expression& output : outputs) shown.push_back(translator.value_of(output));
  const std::vector<ProgramValue>& values = translator.values();
  const std::vector<bool> needed = needed_values(values, shown);
  std::vector<int> registers = leaf_registers(program, values, needed);
  emit(program, values, scheduled(values, needed), registers);
  emit_outputs(program, shown, registers);
}

/// The register of each slot and of each number that is needed, 0 for other values.
std::vector<int> ProgramBuilder::leaf_registers(Program& program,
                                                const std::vector<ProgramValue>& values,
                                                const std::vector<bool>& needed) {
  std::vector<int> registers(values.size(), 0);
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (values[i].operation == Operation::Variable) registers[i] = values[i].operands[0];
    if (values[i].operation != Operation::Number || !needed[i]) continue;
    registers[i] =
        static_cast<int>(program.slot_count_) + static_cast<int>(program.constants_.size());
    program.constants_.push_back(values[i].number());
  }
  return registers;
}

/// Writes the operations in their order and gives each the next register.
void ProgramBuilder::emit(Program& program, const std::vector<ProgramValue>& values,
                          const std::vector<int>& order, std::vector<int>& registers) {
  const std::vector<Program::SlotSet> depends = dependences(values);
  const auto reg = [&](int value) { return registers[static_cast<std::size_t>(value)]; };
  program.register_count_ =
      static_cast<std::size_t>(program.slot_count_) + program.constants_.size();
  for (const int index : order) {
    const ProgramValue& value = values[static_cast<std::size_t>(index)];
    const int target = static_cast<int>(program.register_count_++);
    registers[static_cast<std::size_t>(index)] = target;
    const std::size_t position = program.instructions_.size();
    if (program.runs_.empty() || program.runs_.back().operation != value.operation)
      program.runs_.push_back({value.operation, position, position});
    program.runs_.back().end = position + 1;
    program.instructions_.push_back(
        {target, reg(value.operands[0]), reg(value.operands[1]), reg(value.operands[2])});
    program.depends_.push_back(depends[static_cast<std::size_t>(index)]);
  }
}

/// The first output that shows a result has it computed in place.
void ProgramBuilder::emit_outputs(Program& program, const std::vector<int>& outputs,
                                  const std::vector<int>& registers) {
  const int first_result =
      static_cast<int>(program.slot_count_) + static_cast<int>(program.constants_.size());
  std::vector<bool> shown(program.register_count_, false);
  for (const int output : outputs) {
    const int source = registers[static_cast<std::size_t>(output)];
    const Program::Output entry{static_cast<Index>(program.outputs_.size()), source};
    const bool in_place = source >= first_result && !shown[static_cast<std::size_t>(source)];
    shown[static_cast<std::size_t>(source)] = true;
    (in_place ? program.written_ : program.copied_).push_back(entry);
    program.outputs_.push_back(source);
  }
}

}  // namespace lacuna
