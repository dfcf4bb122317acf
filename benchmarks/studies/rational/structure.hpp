// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <map>
#include <set>
#include <string>

#include "lacuna/model/equations/ode_model.hpp"

namespace lacuna::benchmarks {

/// A product of powers, without its coefficient: the exponent of each factor.
using Powers = std::map<std::string, int>;

/// Which monomials stand in the numerator and in the denominator of a function when it is
/// written as one fraction; numbers do not count. exp of something is a factor by its
/// variables, any other function by its text.
struct Fraction {
  std::set<Powers> numerator, denominator;

  bool operator==(const Fraction&) const = default;
};

/// The fraction of a right-hand side, so that a + b x/(c+x) and a + b/(c+x) are the same.
Fraction fraction_of(const Equation& equation);

/// Coefficients, and numbers inside terms that are no whole numbers.
std::size_t numbers_in(const Equation& equation);

}  // namespace lacuna::benchmarks
