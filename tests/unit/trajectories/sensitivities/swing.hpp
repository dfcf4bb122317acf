// SPDX-License-Identifier: MIT
// A model with a shape parameter whose derivatives are known by hand.
#pragma once

#include <cmath>

#include "lacuna/model/equations/system_model.hpp"

namespace lacuna::testing {

/// x' = y,  y' = a sin(x) + b y + u tanh(x/w): free are a = -2, b = -0.3 and the shape w = 0.7.
inline ParametrisedModel swing() {
  const Variables variables{{"x", "y"}, {"u", "w"}};
  const auto term = [&](const char* text) { return Term::parse(text, variables); };
  return {OdeModel({{"x", ""}, {"y", ""}}, {{"u", ""}, {"w", ""}},
                   {{{term("y"), 1.0}},
                    {{term("sin(x)"), -2.0}, {term("y"), -0.3}, {term("u*tanh(x/w)"), 1.0}}}),
          {{1, 0}, {1, 1}},
          {{"w", 0.7}}};
}

/// y' by hand.
inline double swing_rate(double x, double y, double u, const Vector& p) {
  return p[0] * std::sin(x) + p[1] * y + u * std::tanh(x / p[2]);
}

}  // namespace lacuna::testing
