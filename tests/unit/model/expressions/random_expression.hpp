// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "core/base/random.hpp"
#include "lacuna/model/expressions/expression.hpp"

namespace lacuna::testing {

/// Number of an operation in the enumeration, for drawing one.
inline Operation operation_at(std::uint64_t offset, Operation first) {
  return static_cast<Operation>(static_cast<std::uint64_t>(first) + offset);
}

/// Numbers of all sizes and both signs: 0, integers, tiny, huge, denormal ones.
inline double random_number(Random& random) {
  switch (random.below(6)) {
    case 0:
      return 0.0;
    case 1:
      return static_cast<double>(random.below(9)) - 4.0;
    case 2:
      return random.uniform(-1.0, 1.0);
    case 3:
      return random.normal() * std::pow(10.0, random.uniform(-300.0, 300.0));
    case 4:
      return -5e-324 * static_cast<double>(random.below(1000));
    default:
      return std::round(random.uniform(-1000.0, 1000.0)) / 8.0;
  }
}

inline Expression random_leaf(Random& random) {
  static const std::array<const char*, 5> kNames{"x", "y", "th_1", "_u", "t"};
  const auto name = [&] { return kNames[random.below(kNames.size())]; };
  switch (random.below(4)) {
    case 0:
      return Expression::number(random_number(random));
    case 1:
      return Expression::delayed(kNames[random.below(4)], 3.0 * random.uniform());
    default:
      return Expression::variable(name());
  }
}

/// A tree of all operations, at most `depth` operations deep.
inline Expression random_expression(Random& random, int depth) {
  if (depth == 0 || random.below(8) == 0) return random_leaf(random);
  constexpr auto kFirst = static_cast<std::uint64_t>(Operation::Add);
  constexpr auto kLast = static_cast<std::uint64_t>(Operation::Clip);
  const Operation operation = operation_at(random.below(kLast - kFirst + 1), Operation::Add);
  const bool is_binary = operation <= Operation::Power || operation == Operation::Min ||
                         operation == Operation::Max;
  const int count = operation == Operation::Clip ? 3 : is_binary ? 2 : 1;
  std::vector<Expression> operands;
  for (int i = 0; i < count; ++i) operands.push_back(random_expression(random, depth - 1));
  return Expression::make(operation, std::move(operands));
}

}  // namespace lacuna::testing
