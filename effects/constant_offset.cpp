// SPDX-License-Identifier: MIT
#include "lacuna/effects/families.hpp"
#include "lacuna/effects/forms.hpp"
#include "lacuna/effects/terms.hpp"

namespace lacuna {
namespace {

std::vector<Candidate> constant_offset_forms(const Scope& scope, Index equation) {
  const Expression one = Expression::number(1.0);
  if (has_term(scope, equation, one)) return {};
  return {plain_candidate(one, one)};
}

std::optional<Reading> constant_offset_reading(const FittedForm& fitted) {
  const Candidate& candidate = fitted.candidate;
  if (candidate.form != Expression::number(1.0)) return std::nullopt;
  return Reading{"constant offset of d" + fitted.scope.state(candidate.equation).name + "/dt"};
}

}  // namespace

const EffectFamily kConstantOffset{
    {"constant-offset", "A constant rate: an offset, a load, a source", ""},
    "input offset of an amplifier, a constant load, gravity, a steady inflow",
    constant_offset_forms,
    constant_offset_reading};

}  // namespace lacuna
