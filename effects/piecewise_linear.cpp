// SPDX-License-Identifier: MIT
#include "effects/families.hpp"
#include "lacuna/effects/effects.hpp"

namespace lacuna {
namespace {

void add_bend(const Scope& scope, const Expression& x, std::vector<Candidate>& result) {
  const VariableRange range = scope.range_of(x);
  const auto at = [&](double level) { return range.quantile(level); };
  result.push_back(shaped_candidate(formula(scope, "max(x-edge,0)", {{"x", x}}), x,
                                    {"edge", range.unit, at(0.005), at(0.995), false},
                                    starts_at({at(0.2), at(0.5), at(0.8)})));
}

void add_two_bends(const Scope& scope, const Expression& x, std::vector<Candidate>& result) {
  const VariableRange range = scope.range_of(x);
  if (!range.changes_sign()) return;
  const auto at = [&](double level) { return magnitude_quantile(scope, x, level); };
  result.push_back(
      shaped_candidate(formula(scope, "clip(x,-edge,edge)", {{"x", x}}), x,
                       {"edge", range.unit, kNarrowestBend * at(1.0), at(0.995), true},
                       starts_at({at(0.04), at(0.15), at(0.4), at(0.7)})));
}

std::vector<Candidate> piecewise_linear_forms(const Scope& scope, Index equation) {
  std::vector<Candidate> result;
  std::vector<Expression> arguments = all_variables(scope);
  for (const Expression& difference : differences(scope, equation))
    arguments.push_back(difference);
  for (const Expression& x : arguments) {
    add_bend(scope, x, result);
    add_two_bends(scope, x, result);
    if (!has_term(scope, equation, x) && scope.range_of(x).changes_sign())
      result.push_back(plain_candidate(formula(scope, "abs(x)", {{"x", x}}), x));
  }
  return result;
}

/// A bend in the middle of the motion, or one that lets go of a position instead of pushing it
/// back.
bool is_one_bend(const FittedForm& fitted) {
  const Candidate& candidate = fitted.candidate;
  if (!has_form(candidate, "max(x-a,0)") && !has_form(candidate, "min(x-a,0)")) return false;
  const VariableRange range = range_of_argument(fitted);
  const double edge = fitted.shapes[0], rim = fitted.options.rim;
  const bool lets_go = is_position(fitted.scope, candidate.equation, candidate.argument) &&
                       fitted.coefficient > 0.0;
  return lets_go || (edge > range.quantile(1.0 - rim) && edge < range.quantile(rim));
}

// A slope that is 0 on one side of two bends has a name of its own.
std::optional<Reading> piecewise_linear_reading(const FittedForm& fitted) {
  const Candidate& candidate = fitted.candidate;
  const std::string x = candidate.argument.to_string();
  if (has_form(candidate, "abs(x)")) return Reading{"absolute value of " + x};
  if (is_one_bend(fitted))
    return Reading{"bend in the characteristic of " + x, Precedence::Plain, {"edge"}};
  const std::optional<Bend> bend = bend_of(fitted);
  if (!bend || !has_form(candidate, "clip(x,-a,a)") || is_flat_inside(*bend, fitted.options) ||
      is_flat_outside(*bend, fitted.options))
    return std::nullopt;
  return Reading{"two bends in the characteristic of " + x, Precedence::Plain, {"edge"}};
}

}  // namespace

const EffectFamily kPiecewiseLinear{
    {"piecewise-linear", "A characteristic of straight lines with one bend or two", ""},
    "a nonlinear resistor, a spring that lifts off, a rectifier",
    piecewise_linear_forms,
    piecewise_linear_reading};

}  // namespace lacuna
