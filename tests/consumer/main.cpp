// SPDX-License-Identifier: MIT
// A program outside the source tree that uses the installed package.
#include <iostream>

#include "lacuna/cli/configuration/registry.hpp"
#include "lacuna/model/equations/ode_model.hpp"

int main() {
  const lacuna::Variables variables{{"x"}, {}};
  const lacuna::OdeModel decay({{"x", "V"}}, {},
                               {{{lacuna::Term::parse("x", variables), -2.0}}});
  std::cout << lacuna::to_text(decay) << '\n';
  return lacuna::default_registry().names("regressor").empty() ? 1 : 0;
}
