// SPDX-License-Identifier: MIT
#include "trials.hpp"

#include <set>

#include "hidden/support/cases.hpp"

namespace lacuna::benchmarks {

std::vector<Trial> case_trials() {
  std::vector<Trial> trials;
  for (const hidden::HiddenCase& hidden : hidden::all_cases())
    for (const double level : {0.0, 0.001, 0.01, 0.05})
      trials.push_back({hidden, 1.0, level, 1});
  return trials;
}

std::vector<Trial> power_trials() {
  std::vector<Trial> trials;
  for (const double strength : {0.1, 0.3, 1.0}) {
    std::set<std::string> seen;
    for (const hidden::HiddenCase& hidden : hidden::all_cases(strength)) {
      if (hidden.kind != hidden::Kind::Effects) continue;
      if (!seen.insert(hidden.effects[0].names[0]).second) continue;
      for (const double level : {0.001, 0.01, 0.05})
        trials.push_back({hidden, strength, level, 11});
    }
  }
  return trials;
}

std::vector<Trial> alarm_trials(int count) {
  const std::vector<hidden::HiddenCase> systems = hidden::null_cases();
  const std::vector<hidden::NoiseKind> kinds{
      hidden::NoiseKind::White, hidden::NoiseKind::Coloured, hidden::NoiseKind::Outliers,
      hidden::NoiseKind::Quantised, hidden::NoiseKind::Drifting};
  const std::vector<double> levels{0.001, 0.01, 0.05};
  std::vector<Trial> trials;
  for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
    Trial trial{systems[i % systems.size()], 1.0, 0.0, 1000 + i};
    const std::size_t turn = i / systems.size();
    trial.hidden.noise = kinds[turn % kinds.size()];
    trial.level = levels[turn / kinds.size() % levels.size()];
    trials.push_back(std::move(trial));
  }
  return trials;
}

}  // namespace lacuna::benchmarks
