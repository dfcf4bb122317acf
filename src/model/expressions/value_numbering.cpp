// SPDX-License-Identifier: MIT
#include "value_numbering.hpp"

#include <bit>
#include <cmath>
#include <cstddef>
#include <utility>

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

}  // namespace

bool ProgramValue::is_leaf() const noexcept {
  return operation == Operation::Number || operation == Operation::Variable;
}

double ProgramValue::number() const noexcept { return std::bit_cast<double>(bits); }

int ValueNumbering::slot(int index) { return intern({Operation::Variable, {index, 0, 0}, 0}); }

int ValueNumbering::number(double value) {
  return intern({Operation::Number, {0, 0, 0}, std::bit_cast<std::uint64_t>(value)});
}

int ValueNumbering::operation(Operation operation, std::array<int, 3> operands) {
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

int ValueNumbering::power(int base, int exponent) {
  if (!is_number(exponent)) return operation(Operation::Power, {base, exponent, -1});
  const double power = number_of(exponent);
  if (power == 0.5) return operation(Operation::Sqrt, {base, -1, -1});
  if (power != std::floor(power) || std::abs(power) > kLargestProduct)
    return operation(Operation::Power, {base, exponent, -1});
  const int product = integer_power(base, static_cast<int>(std::abs(power)));
  if (power >= 0.0) return product;
  return operation(Operation::Divide, {number(1.0), product, -1});
}

int ValueNumbering::integer_power(int base, int exponent) {
  if (exponent == 0) return number(1.0);
  if (exponent == 1) return base;
  const int lower = exponent <= kLongestChain ? exponent - 1 : exponent / 2;
  const int first = integer_power(base, lower);
  return operation(Operation::Multiply, {first, integer_power(base, exponent - lower), -1});
}

int ValueNumbering::intern(const ProgramValue& value) {
  const auto [place, is_new] = numbers_.try_emplace(value, static_cast<int>(values_.size()));
  if (is_new) values_.push_back(value);
  return place->second;
}

bool ValueNumbering::is_number(int value) const {
  return values_[static_cast<std::size_t>(value)].operation == Operation::Number;
}

double ValueNumbering::number_of(int value) const {
  return values_[static_cast<std::size_t>(value)].number();
}

}  // namespace lacuna
