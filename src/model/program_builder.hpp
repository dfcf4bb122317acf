// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "lacuna/model/program.hpp"

namespace lacuna {

/// Turns expressions into a program: numbers every distinct value once (hash-consing), folds
/// constants, writes integer powers as products, orders what is needed by depth and operation.
class ProgramBuilder {
 public:
  /// @throws ModelError naming a variable that is not in `variables`.
  ProgramBuilder(std::span<const Expression> outputs, const Variables& variables);

  /// Moves the result into the program.
  void move_into(Program& program);

 private:
  /// A distinct value: a slot, a number or an operation on values numbered before it.
  struct Value {
    Operation operation;
    std::array<int, 3> operands = {0, 0, 0};  ///< of a slot, the first is its number
    std::uint64_t bits = 0;                   ///< of a number
    auto operator<=>(const Value&) const = default;
  };
  struct Hash {
    std::size_t operator()(const Expression& e) const noexcept { return e.hash(); }
  };

  void collect_delays(const Expression& expression);
  Index slot_of(const Expression& variable) const;
  int slot_of_delay(const Expression& delayed) const;

  int value_of(const Expression& expression);
  int translate(const Expression& expression);
  int translate_power(const Expression& expression);
  int slot(int index);
  int number(double value);
  int operation(Operation operation, std::array<int, 3> operands);
  int integer_power(int base, int exponent);
  int intern(const Value& value);
  bool is_number(int value) const;
  double number_of(int value) const;

  std::vector<bool> needed_values() const;
  std::vector<int> scheduled(const std::vector<bool>& needed) const;
  std::vector<int> levels() const;
  void assign_registers(Program& program, const std::vector<bool>& needed);
  void emit(Program& program, const std::vector<int>& order);
  void emit_outputs(Program& program) const;

  std::vector<std::string> names_;
  std::vector<DelayedVariable> delays_;
  std::vector<Value> values_;
  std::map<Value, int> numbers_of_values_;
  std::unordered_map<Expression, int, Hash> translated_;
  std::vector<int> outputs_;
  std::vector<int> registers_;
};

}  // namespace lacuna
