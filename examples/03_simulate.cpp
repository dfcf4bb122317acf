// SPDX-License-Identifier: MIT
// A model written by hand, simulated, and its orbit written as a record.
#include <iostream>

#include "lacuna/dynamics/integration/runge_kutta.hpp"
#include "lacuna/dynamics/integration/simulate.hpp"

int main() {
  using namespace lacuna;
  const Variables pendulum{{"th", "w"}, {}};
  const auto term = [&](const char* text) { return Term::parse(text, pendulum); };
  const OdeModel model({{"th", "rad"}, {"w", "rad/s"}}, {},
                       {{{term("w"), 1.0}}, {{term("sin(th)"), -19.62}, {term("w"), -0.15}}});

  const Vector start = Eigen::Vector2d(2.0, 0.0);
  const Solution orbit = simulate(model, Dopri5{}, start, sample_times(0.0, 0.01, 1001));
  std::cout << to_text(model) << "\nafter " << orbit.end_time
            << " s: th = " << orbit.end_state[0] << " rad, w = " << orbit.end_state[1]
            << " rad/s\n";
  return orbit.status == IntegrationStatus::Completed ? 0 : 1;
}
