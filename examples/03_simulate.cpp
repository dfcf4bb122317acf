// SPDX-License-Identifier: MIT
// A model written by hand, simulated, and its orbit written as a record.
#include <iostream>

#include "lacuna/dynamics/integration/integrators.hpp"
#include "lacuna/dynamics/integration/simulate.hpp"
#include "lacuna/model/equations/ode_model.hpp"
#include "lacuna/model/expressions/expression.hpp"

int main() {
  using namespace lacuna;
  const auto th = Expression::variable("th"), w = Expression::variable("w");
  const OdeModel model =
      written_model({{"th", "rad"}, {"w", "rad/s"}}, {w, -19.62 * sin(th) - 0.15 * w});

  const Vector start = Eigen::Vector2d(2.0, 0.0);
  const Solution orbit = simulate(model, dopri5(), start, sample_times(0.0, 0.01, 1001));
  std::cout << to_text(model) << "\nafter " << orbit.end_time
            << " s: th = " << orbit.end_state[0] << " rad, w = " << orbit.end_state[1]
            << " rad/s\n";
  return orbit.status == IntegrationStatus::Completed ? 0 : 1;
}
