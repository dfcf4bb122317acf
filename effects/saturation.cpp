// SPDX-License-Identifier: MIT
#include <algorithm>

#include "lacuna/effects/families.hpp"
#include "lacuna/effects/terms.hpp"

namespace lacuna {
namespace {

// A coarse converter may show 0 most of the time: the least limit is a share of the largest.
constexpr double kLeast = 1e-3;

ShapeParameter limit_of(const Scope& scope, const std::string& x, double widest) {
  const double largest = magnitude_quantile(scope, x, 1.0);
  const double least = std::max(magnitude_quantile(scope, x, 0.05), kLeast * largest);
  return {"limit", range_of(scope, x).unit, least, widest * largest, true};
}

std::vector<Vector> starts(const Scope& scope, const std::string& x) {
  return starts_at({magnitude_quantile(scope, x, 0.4), magnitude_quantile(scope, x, 0.7),
                    magnitude_quantile(scope, x, 0.93)});
}

// A hard limit and a soft one of something that the nominal model has unlimited.
void add_limits(const Scope& scope, const std::string& x, std::vector<Candidate>& result) {
  if (!range_of(scope, x).changes_sign()) return;
  const std::string description = "saturation of " + x;
  result.push_back(shaped_candidate("(" + x + ")-clip(" + x + ",-$limit,$limit)", x,
                                    description, limit_of(scope, x, 0.999), starts(scope, x)));
  result.push_back(shaped_candidate("(" + x + ")-$limit*tanh((" + x + ")/$limit)", x,
                                    description, limit_of(scope, x, 3.0), starts(scope, x)));
  result.back().plainer = "cubic-term";
}

// The same of something that the nominal equation does not have at all.
void add_new(const Scope& scope, const std::string& x, std::vector<Candidate>& result) {
  if (!range_of(scope, x).changes_sign()) return;
  const std::string description = "action of " + x + " that saturates";
  result.push_back(shaped_candidate("clip(" + x + ",-$limit,$limit)", x, description,
                                    limit_of(scope, x, 0.999), starts(scope, x)));
  result.push_back(shaped_candidate("tanh(" + x + "/$limit)", x, description,
                                    limit_of(scope, x, 3.0), starts(scope, x)));
}

std::vector<Candidate> make(const Scope& scope, Index equation) {
  std::vector<Candidate> result;
  for (const std::string& x : linear_arguments(scope, equation)) add_limits(scope, x, result);
  for (const std::string& g : nonlinear_terms(scope, equation)) add_limits(scope, g, result);
  for (const std::string& x : variable_names(scope))
    if (!has_term(scope, equation, x)) add_new(scope, x, result);
  return result;
}

// Nothing of the slope may be left beyond the limit, and a force against the motion that is at
// its limit as soon as something moves is dry friction.
bool plausible(const Scope& scope, const Candidate& candidate, const FittedCandidate& fitted) {
  const double inside = slope(fitted.nominal, candidate.equation, candidate.argument);
  const bool opposing = (inside == 0.0 ? fitted.coefficient : -fitted.coefficient) < 0.0;
  if (opposing && bends_at_standstill(scope, candidate, fitted.shapes[0])) return false;
  return inside == 0.0 || slopes_agree(inside, -fitted.coefficient, fitted.deviation);
}

}  // namespace

const EffectFamily kSaturation{
    {"saturation", "Something stops growing at a limit of both signs", ""},
    "an amplifier at its rails, a current limit, a magnetic core, a valve fully open",
    {},
    make,
    plausible};

}  // namespace lacuna
