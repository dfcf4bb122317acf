// SPDX-License-Identifier: MIT
#include "lacuna/effects/friction.hpp"

#include <algorithm>

namespace lacuna {

std::string_view CoulombFriction::do_typical_cause() const {
  return "bearings, seals, guides, brushes";
}

std::vector<Candidate> CoulombFriction::do_candidates(const Scope& scope,
                                                      Index equation) const {
  const VariableRange& velocity = scope.state(equation);
  if (scope.is_identity(equation) || velocity.low >= 0.0 || velocity.high <= 0.0) return {};
  Candidate sharp;
  sharp.description = "dry friction opposing " + velocity.name;
  sharp.form = "sign(" + velocity.name + ")";
  Candidate smooth = sharp;
  smooth.form = "tanh(" + velocity.name + "/width)";
  // From where it cannot be told from a jump to where it cannot be told from a straight line.
  const double widest = std::max(-velocity.low, velocity.high);
  smooth.shapes = {{"width", velocity.unit, 1e-4 * widest, widest, true}};
  smooth.starts = {Vector::Constant(1, 0.01 * widest), Vector::Constant(1, 0.1 * widest)};
  return {sharp, smooth};
}

}  // namespace lacuna
