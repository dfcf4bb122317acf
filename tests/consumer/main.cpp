// SPDX-License-Identifier: MIT
// A program outside the source tree that uses the installed package: it identifies and
// diagnoses with one header.
#include <iostream>

#include "lacuna/lacuna.hpp"

int main() {
  using namespace lacuna;
  const auto q = Expression::variable("q"), v = Expression::variable("v");
  const std::vector<Quantity> states{{"q", "m"}, {"v", "m/s"}};
  const OdeModel oscillator = written_model(states, {v, -4 * q - 0.2 * v});
  const OdeModel bench =
      oscillator.with_term(1, {Term::parse("sign(v)", oscillator.variables()), -0.3});
  const Vector start{{1.5, 0.0}};

  const Dataset swings = record_of(oscillator, rk4(), start, 0.02, 1000);
  const Identification found = identify_records(swings);
  std::cout << to_text(found.result.model, 3) << '\n';

  const Dataset rubs = add_relative_noise(record_of(bench, rk4(), start, 0.02, 1000), 0.005, 1);
  std::cout << format_text(diagnose(oscillator, rubs)) << '\n';
  return library_version() == kVersion ? 0 : 1;
}
