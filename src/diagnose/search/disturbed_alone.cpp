// SPDX-License-Identifier: MIT
#include "disturbed_alone.hpp"

#include "trajectories/smoother/hidden_states.hpp"

namespace lacuna {

Assimilation disturbed_alone(const Problem& problem, const Baseline& base, Index equation) {
  AssimilationOptions options;
  options.hidden = base.fit_options.hidden;
  options.disturbed.assign(static_cast<std::size_t>(problem.nominal.dimension()), false);
  options.disturbed[static_cast<std::size_t>(equation)] = true;
  const BoundRecords& records = problem.records;
  Assimilation given = assimilate_from_starts(problem.nominal, records.data, records.outliers,
                                              options, problem.context);
  given.free = base.fit_options.free;
  return given;
}

Assimilation loosened(Assimilation start, const Baseline& base) {
  constexpr double kLittle = 0.1;
  start.noise.disturbance =
      start.noise.disturbance.cwiseMax(kLittle * base.given.noise.disturbance);
  return start;
}

}  // namespace lacuna
