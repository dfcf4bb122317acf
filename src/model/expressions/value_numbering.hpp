// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <vector>

#include "lacuna/model/expressions/expression.hpp"

namespace lacuna {

/// A distinct value of a program: a slot, a number or an operation on values numbered before.
struct ProgramValue {
  Operation operation;
  std::array<int, 3> operands = {0, 0, 0};  ///< of a slot, the first is its number
  std::uint64_t bits = 0;                   ///< of a number

  auto operator<=>(const ProgramValue&) const = default;

  /// Whether it is there before anything is computed: a slot or a number.
  bool is_leaf() const noexcept;

  /// Its number. @pre the operation is Operation::Number.
  double number() const noexcept;
};

/// Numbers every distinct value once (hash-consing), folds constants, writes integer powers as
/// products. Each function returns the number of its value, that is its place in values().
class ValueNumbering {
 public:
  int slot(int index);
  int number(double value);

  /// An operation on as many of the operands as it has; constants are folded.
  int operation(Operation operation, std::array<int, 3> operands);

  /// base^exponent: a product where the exponent is an integer that is not too large.
  int power(int base, int exponent);

  /// Operands stand in front of the operations on them.
  const std::vector<ProgramValue>& values() const noexcept { return values_; }

 private:
  bool is_number(int value) const;
  double number_of(int value) const;
  int integer_power(int base, int exponent);
  int intern(const ProgramValue& value);

  std::vector<ProgramValue> values_;
  std::map<ProgramValue, int> numbers_;
};

}  // namespace lacuna
