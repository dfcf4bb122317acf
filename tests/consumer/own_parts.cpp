// SPDX-License-Identifier: MIT
// The parts that pages show, in a program outside the source tree: a basis and a regressor find
// an oscillator with friction, an effect is the one that a diagnosis names.
#include <iostream>

#include "basis.hpp"
#include "effect.hpp"
#include "lacuna/lacuna.hpp"
#include "regressor.hpp"

int main() {
  using namespace lacuna;
  const auto x = Expression::variable("x"), v = Expression::variable("v");
  const std::vector<Quantity> states{{"x", "m"}, {"v", "m/s"}};
  const OdeModel free = written_model(states, {v, -4 * x});
  const auto with = [&](const char* term, double coefficient) {
    return free.with_term(1, {Term::parse(term, free.variables()), coefficient});
  };
  const Vector start{{1.5, 0.0}};

  const Dataset rubs = record_of(with("v*abs(v)", -0.3), rk4(), start, 0.01, 2000);
  const Pipeline own{sum_of_bases({monomials({.max_degree = 1}), page::Friction{}}),
                     strong_form({finite_differences()}),
                     abm(),
                     page::Ridge{{.alpha = 1e-12}},
                     sequential_thresholding(),
                     no_refiner()};
  std::cout << to_text(identify(rubs, own).model, 2) << '\n';

  Registry registry = default_registry();
  registry.add<page::Friction>();
  registry.add<page::OneSidedSpringEffect>();
  DiagnosisOptions options;
  options.effects = {page::OneSidedSpringEffect{}};
  const Dataset beyond = add_relative_noise(
      record_of(with("max(x-0.6,0)", -9.0), rk4(), start, 0.01, 2000), 1e-3, 1);
  std::cout << format_text(diagnose(free, beyond, {}, options)) << '\n';
  return 0;
}
