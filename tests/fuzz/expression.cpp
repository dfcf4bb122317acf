// SPDX-License-Identifier: MIT
#include "lacuna/model/expressions/expression.hpp"

#include <cstdlib>

#include "fuzz/target.hpp"
#include "lacuna/core/base/error.hpp"

namespace lacuna::fuzz {

std::vector<std::string> seeds() {
  return {"x^2*y",           "sin(x)*exp(-y/2)", "-x*abs(x)+1e-3", "clip(x,-1,1)",
          "max(x,min(y,0))", "delay(x,0.1)*y",   "--x^-y^2/(x-y)", "step(x)*tanh(x/0.02)"};
}

void take(std::string_view input) {
  const std::vector<std::string> known{"x", "y", "t"};
  try {
    const Expression e = parse_expression(input, known);
    const std::string text = e.to_string();
    // What a sign in front of a negative operand is printed as nests deeper than it was
    // written.
    if (input.size() < 100 && !(parse_expression(text, known) == e)) std::abort();
    const Expression slope = differentiate(e, "x");
    if (slope.to_string().empty()) std::abort();
  } catch (const Error&) {
  }
}

}  // namespace lacuna::fuzz
