// SPDX-License-Identifier: MIT
#include "refitted.hpp"

#include <vector>

#include "trajectories/shooting/refine.hpp"

namespace lacuna {

Dataset measured_part(const Dataset& data) {
  std::vector<Index> measured;
  for (Index k = 0; k < data.state_count(); ++k)
    if (data.is_measured(k)) measured.push_back(k);
  Dataset result;
  result.time_unit = data.time_unit;
  result.inputs = data.inputs;
  for (const Index k : measured)
    result.states.push_back(data.states[static_cast<std::size_t>(k)]);
  for (const Trajectory& record : data.trajectories)
    result.trajectories.push_back({record.source, record.time,
                                   record.states(Eigen::all, measured), record.inputs,
                                   Matrix()});
  return result;
}

std::optional<OdeModel> refitted(const OdeModel& model, const Dataset& data,
                                 const RunContext& context) {
  std::vector<bool> exact;
  for (Index k = 0; k < data.state_count(); ++k)
    exact.push_back(data.rate_state(k).has_value());
  // The start is the optimum for windows of one length: what takes longer does not converge.
  constexpr int kIterations = 10;
  const Refinement fit = refine(with_free_coefficients(model, exact), measured_part(data),
                                {.max_iterations = kIterations}, context);
  if (fit.status != RefineStatus::Converged) return std::nullopt;
  return fit.fitted();
}

}  // namespace lacuna
