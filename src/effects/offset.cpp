// SPDX-License-Identifier: MIT
#include "lacuna/effects/offset.hpp"

#include <algorithm>

namespace lacuna {

std::string_view ConstantOffset::do_typical_cause() const {
  return "input offset of an amplifier, a constant load, gravity, a leak";
}

std::vector<Candidate> ConstantOffset::do_candidates(const Scope& scope, Index equation) const {
  const Equation& terms = scope.model.equations()[static_cast<std::size_t>(equation)];
  const bool present = std::any_of(terms.begin(), terms.end(), [](const WeightedTerm& summand) {
    return summand.term.name() == "1";
  });
  if (present || scope.is_identity(equation)) return {};
  Candidate candidate;
  candidate.description = "constant offset of d" + scope.state(equation).name + "/dt";
  candidate.form = "1";
  return {candidate};
}

}  // namespace lacuna
