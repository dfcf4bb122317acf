// SPDX-License-Identifier: MIT
// What does a model lack? A pendulum whose bearing has dry friction, and a model without it.
#include <iostream>

#include "lacuna/lacuna.hpp"

int main() {
  using namespace lacuna;
  const Variables names{{"th", "w"}, {}};
  const auto term = [&](const char* text) { return Term::parse(text, names); };
  const OdeModel nominal({{"th", "rad"}, {"w", "rad/s"}}, {},
                         {{{term("w"), 1.0}}, {{term("sin(th)"), -9.81}, {term("w"), -0.1}}});
  const OdeModel bench = nominal.with_term(1, {term("sign(w)"), -0.15});

  const Solution swing =
      simulate(bench, Rk4{}, Vector{{1.5, 0.0}}, sample_times(0.0, 0.01, 2001));
  Dataset measured;
  measured.states = {{"w", "rad/s"}, {"th", "rad"}};  // columns in any order
  measured.trajectories.resize(1);
  measured.trajectories[0].time = swing.time;
  measured.trajectories[0].states = swing.states.rowwise().reverse();
  measured = add_relative_noise(measured, 0.01, 1);

  const Registry registry = default_registry();
  const auto differentiator = registry.make<Differentiator>("finite-differences");
  const Dataset record = model_view(nominal, measured, *differentiator);
  DiagnosisOptions options;
  options.effects = registry.make_all<Effect>();
  std::cout << format_text(diagnose(nominal, record, {}, options, RunContext{}));
}
