// SPDX-License-Identifier: MIT
#include "regression/formulations/integral_form.hpp"

#include <algorithm>

#include "assemble_projections.hpp"

namespace lacuna {

LeastSquaresSystem IntegralForm::do_assemble(const Dataset& data, const TermLibrary& library,
                                             const RunContext& context) const {
  // Half overlapping: intervals that meet end to end would leave the noise of the samples in
  // between out of the comparison of neighbours.
  const Index span = options().span, stride = std::max<Index>(1, span / 2);
  std::vector<Projection> projections;
  for (const Trajectory& record : data.trajectories)
    projections.push_back(integral_projection(record, span, stride));
  return assemble_projections(data, library, projections, context);
}

std::optional<Vector> IntegralForm::do_target_noise(const Dataset&,
                                                    const Vector& state_noise) const {
  return state_noise;
}

Stage<Formulation> integral_form(const IntegralFormOptions& options) {
  return IntegralForm(options);
}

}  // namespace lacuna
