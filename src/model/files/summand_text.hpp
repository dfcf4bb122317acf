// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "lacuna/model/expressions/expression.hpp"

namespace lacuna {

/// Whether a number 1 in front of a term is written.
enum class One { Written, LeftOut };

/// A number times a term as text, in which the number is `factor`, not negative: "2*x",
/// "3/(1+x)", "2*(x-y)".
std::string summand_text(const Expression& term, std::string factor, One one);

}  // namespace lacuna
