// SPDX-License-Identifier: MIT
#include "lacuna/effects/families.hpp"
#include "lacuna/effects/terms.hpp"

namespace lacuna {
namespace {

// A bend between these quantiles lies in the middle of the motion.
constexpr double kMiddle = 0.4;

void add_bend(const Scope& scope, const std::string& x, std::vector<Candidate>& result) {
  const VariableRange range = range_of(scope, x);
  const auto at = [&](double level) { return range.quantile(level); };
  result.push_back(shaped_candidate(
      "max(" + x + "-$edge,0)", x, "bend in the characteristic of " + x,
      {"edge", range.unit, at(0.05), at(0.95), false}, starts_at({at(0.2), at(0.5), at(0.8)})));
}

void add_two_bends(const Scope& scope, const std::string& x, std::vector<Candidate>& result) {
  if (!range_of(scope, x).changes_sign()) return;
  const auto at = [&](double level) { return magnitude_quantile(scope, x, level); };
  result.push_back(shaped_candidate(
      "clip(" + x + ",-$edge,$edge)", x, "two bends in the characteristic of " + x,
      {"edge", range_of(scope, x).unit, at(0.02), at(0.98), false},
      starts_at({at(0.15), at(0.4), at(0.7)})));
}

/// A slope that is 0 on one side of the bends has a name of its own: dead zone or saturation.
/// So has a jump at standstill: dry friction.
bool has_two_slopes(const Scope& scope, const Candidate& candidate,
                    const FittedCandidate& fitted) {
  const double outside = slope(fitted.nominal, candidate.equation, candidate.argument);
  const double inside = outside + fitted.coefficient;
  if (slopes_agree(outside, -fitted.coefficient, fitted.deviation)) return false;
  if (slopes_agree(inside, fitted.coefficient, fitted.deviation)) return false;
  return !(inside < outside && bends_at_standstill(scope, candidate, fitted.shapes[0]));
}

bool bends_in_the_middle(const Scope& scope, const Candidate& candidate, double edge) {
  const VariableRange range = range_of(scope, candidate.argument);
  return edge > range.quantile(kMiddle) && edge < range.quantile(1.0 - kMiddle);
}

std::vector<Candidate> make(const Scope& scope, Index equation) {
  std::vector<Candidate> result;
  std::vector<std::string> arguments = variable_names(scope);
  for (const std::string& difference : differences(scope, equation))
    arguments.push_back(difference);
  for (const std::string& x : arguments) {
    add_bend(scope, x, result);
    add_two_bends(scope, x, result);
    if (!has_term(scope, equation, x) && range_of(scope, x).changes_sign())
      result.push_back(plain_candidate("abs(" + x + ")", x, "absolute value of " + x));
  }
  return result;
}

bool plausible(const Scope& scope, const Candidate& candidate, const FittedCandidate& fitted) {
  if (fitted.shapes.size() == 0) return true;
  if (candidate.form.rfind("clip", 0) == 0) return has_two_slopes(scope, candidate, fitted);
  // At the rim a bend is a stop, unless it lets go of a position instead of pushing it back.
  const auto position = scope.integral_of(candidate.equation);
  const bool lets_go =
      position && scope.state(*position).name == candidate.argument && fitted.coefficient > 0.0;
  return lets_go || bends_in_the_middle(scope, candidate, fitted.shapes[0]);
}

}  // namespace

const EffectFamily kPiecewiseLinear{
    {"piecewise-linear", "A characteristic of straight lines with one bend or two", ""},
    "a nonlinear resistor, a spring that lifts off, a rectifier",
    {},
    make,
    plausible};

}  // namespace lacuna
