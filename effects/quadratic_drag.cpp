// SPDX-License-Identifier: MIT
#include "lacuna/effects/families.hpp"
#include "lacuna/effects/terms.hpp"

namespace lacuna {
namespace {

std::vector<Candidate> make(const Scope& scope, Index equation) {
  std::vector<Candidate> result;
  for (const std::string& v : felt_speeds(scope, equation)) {
    const std::string form = "(" + v + ")*abs(" + v + ")";
    if (range_of(scope, v).changes_sign() && !has_term(scope, equation, form))
      result.push_back(plain_candidate(form, v, "drag of the square of " + v));
  }
  return result;
}

}  // namespace

const EffectFamily kQuadraticDrag{
    {"quadratic-drag", "Drag of the square of the speed, against the motion", ""},
    "air or water resistance, turbulent flow, an orifice",
    {},
    make,
    opposes};

}  // namespace lacuna
