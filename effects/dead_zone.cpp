// SPDX-License-Identifier: MIT
#include "lacuna/effects/families.hpp"
#include "lacuna/effects/terms.hpp"

namespace lacuna {
namespace {

ShapeParameter edge_of(const Scope& scope, const std::string& x) {
  return {"edge", range_of(scope, x).unit, magnitude_quantile(scope, x, 0.02),
          magnitude_quantile(scope, x, 0.95), false};
}

std::vector<Vector> starts(const Scope& scope, const std::string& x) {
  return starts_at({magnitude_quantile(scope, x, 0.15), magnitude_quantile(scope, x, 0.4),
                    magnitude_quantile(scope, x, 0.7)});
}

// What acts linearly in the nominal model loses its action about zero: the clipped part goes.
std::vector<Candidate> make(const Scope& scope, Index equation) {
  std::vector<Candidate> result;
  for (const std::string& x : linear_arguments(scope, equation)) {
    if (!range_of(scope, x).changes_sign()) continue;
    result.push_back(shaped_candidate("clip(" + x + ",-$edge,$edge)", x, "dead zone in " + x,
                                      edge_of(scope, x), starts(scope, x)));
    if (is_transmission(scope, x)) result.back().plainer = "backlash";
  }
  for (const std::string& x : variable_names(scope))
    if (!has_term(scope, equation, x) && range_of(scope, x).changes_sign())
      result.push_back(shaped_candidate(x + "-clip(" + x + ",-$edge,$edge)", x,
                                        "action of " + x + " beyond a dead zone",
                                        edge_of(scope, x), starts(scope, x)));
  return result;
}

// Where the argument acts linearly, nothing of its slope may be left inside.
bool plausible(const Scope&, const Candidate& candidate, const FittedCandidate& fitted) {
  const double outside = slope(fitted.nominal, candidate.equation, candidate.argument);
  return outside == 0.0 || slopes_agree(outside, -fitted.coefficient, fitted.deviation);
}

}  // namespace

const EffectFamily kDeadZone{
    {"dead-zone", "Nothing happens about zero: no action within an edge", ""},
    "valve overlap, a threshold, crossover distortion",
    {},
    make,
    plausible};

}  // namespace lacuna
