// SPDX-License-Identifier: MIT
// A model from a text, its orbit, and the orbit as a file.
#include <iostream>
#include <lacuna/lacuna.hpp>

int main() {
  using namespace lacuna;
  const OdeModel model = parse_ode(R"(
      time s
      input u [rad/s^2]
      state th [rad]
      state w [rad/s]
      dth/dt = w
      dw/dt = -9.81/0.5*sin(th) - 0.15*w + u
  )",
                                   "pendulum");
  std::cout << to_text(model, 5) << '\n';

  // The motor pushes for a second; the integrator has to know where the push ends.
  const auto push = [](double t, double* u) { u[0] = t < 1.0 ? 15.0 : 0.0; };
  const DrivenModel driven{model, push, Vector{{1.0}}};
  const Solution orbit =
      simulate(driven, dopri5(), Vector{{0.0, 0.0}}, sample_times(0.0, 0.01, 1001));
  std::cout.precision(4);
  std::cout << "after " << orbit.end_time << " s: th = " << orbit.end_state[0]
            << " rad, w = " << orbit.end_state[1] << " rad/s\n";

  Matrix inputs(orbit.time.size(), 1);
  for (Index i = 0; i < inputs.rows(); ++i) push(orbit.time[i], &inputs(i, 0));
  write_csv("swing.csv", {.time_unit = model.time_unit(),
                          .states = model.states(),
                          .inputs = model.inputs(),
                          .trajectories = {{"swing", orbit.time, orbit.states, inputs, {}}},
                          .rate_of = {}});
  return orbit.status == IntegrationStatus::Completed ? 0 : 1;
}
