// SPDX-License-Identifier: MIT
// What is in these files? Records are read and looked at before anything is fitted to them.
#include <iomanip>
#include <iostream>
#include <lacuna/lacuna.hpp>

int main() {
  using namespace lacuna;
  // The oscilloscope calls its channels CH1 to CH3; whoever soldered them knows better.
  const ColumnRoles roles{.inputs = {"u"},
                          .names = {{"th", "CH1"}, {"w", "CH2"}, {"u", "CH3"}}};
  const Dataset data = read_dataset({"data/pendulum_scope_*.csv.gz"}, roles);

  for (const Trajectory& record : data.trajectories)
    std::cout << file_of(record) << ": " << record.samples() << " samples, one every "
              << mean_step(record) << ' ' << data.time_unit << '\n';

  const std::vector<StateNoise> noise = analyse_noise(data);
  for (std::size_t k = 0; k < data.states.size(); ++k) {
    const Quantity& state = data.states[k];
    const auto values = longest_record(data).states.col(static_cast<Index>(k));
    std::cout << std::setprecision(4) << state.name << " from " << values.minCoeff() << " to "
              << values.maxCoeff() << ' ' << state.unit << ", " << to_string(noise[k].kind)
              << " noise of " << std::setprecision(2) << noise[k].sigma << '\n';
  }
  for (const std::string& note : data.notes) std::cout << note << '\n';
}
