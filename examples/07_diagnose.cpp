// SPDX-License-Identifier: MIT
// What does a model lack? A pendulum whose bearing has dry friction, and a model without it.
#include <iostream>

#include "lacuna/lacuna.hpp"

int main() {
  using namespace lacuna;
  const auto th = Expression::variable("th"), w = Expression::variable("w");
  const std::vector<Quantity> states{{"th", "rad"}, {"w", "rad/s"}};
  const OdeModel nominal = written_model(states, {w, -9.81 * sin(th) - 0.1 * w});
  const OdeModel bench = written_model(states, {w, -9.81 * sin(th) - 0.1 * w - 0.15 * sign(w)});

  const Solution swing =
      simulate(bench, rk4(), Vector{{1.5, 0.0}}, sample_times(0.0, 0.01, 2001));
  Dataset measured;
  measured.states = {{"w", "rad/s"}, {"th", "rad"}};  // columns in any order
  measured.trajectories.resize(1);
  measured.trajectories[0].time = swing.time;
  measured.trajectories[0].states = swing.states.rowwise().reverse();
  std::cout << format_text(diagnose(nominal, add_relative_noise(measured, 0.01, 1)));
}
