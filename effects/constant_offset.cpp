// SPDX-License-Identifier: MIT
#include "lacuna/effects/families.hpp"
#include "lacuna/effects/terms.hpp"

namespace lacuna {
namespace {

std::vector<Candidate> make(const Scope& scope, Index equation) {
  if (has_term(scope, equation, "1")) return {};
  return {
      plain_candidate("1", "1", "constant offset of d" + scope.state(equation).name + "/dt")};
}

}  // namespace

const EffectFamily kConstantOffset{
    {"constant-offset", "A constant rate: an offset, a load, a source", ""},
    "input offset of an amplifier, a constant load, gravity, a steady inflow",
    {},
    make};

}  // namespace lacuna
