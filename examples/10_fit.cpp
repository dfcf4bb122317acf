// SPDX-License-Identifier: MIT
// Parameters of a known structure, with intervals, from one record and judged by another.
#include <iomanip>
#include <iostream>
#include <lacuna/lacuna.hpp>

int main() {
  using namespace lacuna;
  const SystemModel pendulum = parse_ode_system(R"(
      time s
      input u [rad/s^2]
      state th [rad]
      state w [rad/s]
      param k = 15 [1/s^2]
      param d = 0.5 [1/s] in 0..10
      param f = 0.1 [rad/s^2] in 0..10
      dth/dt = w
      dw/dt = -k*sin(th) - d*w - f*sign(w) + u)",
                                                "pendulum");
  const ColumnRoles roles{.names = {{"th", "CH1"}, {"w", "CH2"}, {"u", "CH3"}}};
  const auto record = [&](const char* path) {
    return read_records(pendulum.model(), {path}, roles, finite_differences());
  };
  const Fit found =
      fit(pendulum, record("data/pendulum_scope_1.csv.gz"),
          record("data/pendulum_scope_2.csv.gz"), {.effort = Thoroughness::Quick});

  std::cout << sentence_of(standing_of(found)) << '\n';
  for (const FittedParameter& number : found.numbers) {
    std::cout << number.name << " = " << std::setprecision(4) << number.value;
    if (const auto& ends = number.ci95)  // where the records determine it
      std::cout << " +- " << std::setprecision(2) << 0.5 * ((*ends)[1] - (*ends)[0]);
    std::cout << ' ' << number.unit << '\n';
  }
  if (!found.gap) return 1;
  for (const FitQuality& channel : found.gap->channels)
    std::cout << channel.channel << ": free run off by " << channel.rmse << ", noise "
              << channel.noise << '\n';
}
