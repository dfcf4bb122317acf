// SPDX-License-Identifier: MIT
#include "disturbed_alone.hpp"

#include <utility>
#include <vector>

#include "trajectories/smoother/hidden_states.hpp"

namespace lacuna {

Assimilation disturbed_alone(const Problem& problem, const Baseline& base, Index equation) {
  AssimilationOptions options;
  options.hidden = base.fit_options.hidden;
  std::vector<bool> alone(static_cast<std::size_t>(problem.nominal.dimension()), false);
  alone[static_cast<std::size_t>(equation)] = true;
  options.disturbed = std::move(alone);
  Assimilation given =
      assimilate_from_starts(problem.nominal, problem.records, options, problem.context);
  given.free = base.fit_options.free;
  return given;
}

Assimilation loosened(Assimilation start, const Baseline& base) {
  constexpr double kFractionOfDisturbance = 0.1;  // a fact of the search: a start, no bound
  start.noise.disturbance =
      start.noise.disturbance.cwiseMax(kFractionOfDisturbance * base.given.noise.disturbance);
  return start;
}

}  // namespace lacuna
