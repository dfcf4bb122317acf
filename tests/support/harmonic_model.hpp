// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/model/equations/ode_model.hpp"

namespace lacuna::support {

/// dx/dt = v, dv/dt = -4 x + u in metres and seconds.
inline OdeModel harmonic_model() {
  const Variables variables{{"x", "v"}, {"u"}};
  const auto term = [&](const char* text) { return Term::parse(text, variables); };
  return {{{"x", "m"}, {"v", "m/s"}},
          {{"u", "N"}},
          {{{term("v"), 1.0}}, {{term("x"), -4.0}, {term("u"), 1.0}}}};
}

}  // namespace lacuna::support
