// SPDX-License-Identifier: MIT
// Formulas of one variable in the place of a free curve.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "diagnose/candidates/candidate_column.hpp"
#include "diagnose/candidates/screening.hpp"
#include "diagnose/hypotheses/residual_function.hpp"
#include "lacuna/core/statistics/interval.hpp"
#include "lacuna/effects/effects.hpp"

namespace lacuna {
namespace {

/// A sine, a power and an exponential of one variable. Ranges and starts are facts of the search:
/// a sine of an eighth of a turn to four turns over the range of the variable, an exponential
/// that grows by e^0.3 to e^12.
std::vector<Candidate> formulas_of(const Scope& scope, const VariableRange& range,
                                   Index equation) {
  constexpr double kTurn = 2.0 * std::numbers::pi;
  const double span = range.high - range.low;
  const Expression x = Expression::variable(range.name);
  const auto form = [&](const char* pattern) { return formula(scope, pattern, {{"x", x}}); };
  const auto name = [&](const char* shape) { return scope.free_name(shape); };
  Candidate sine = plain_candidate(form("sin(wave*x+phase)"), x);
  sine.shapes = {{name("wave"), "", kTurn / (8.0 * span), 4.0 * kTurn / span, true},
                 {name("phase"), "rad", -kTurn, kTurn, false}};
  for (double turns = 0.2; turns < 4.0; turns += 0.25)
    for (const double phase : {0.0, 0.25 * kTurn})
      sine.starts.push_back(Vector{{turns * kTurn / span, phase}});
  std::vector<Candidate> all{
      std::move(sine),
      shaped_candidate(form(range.changes_sign() ? "sign(x)*abs(x)^power" : "abs(x)^power"), x,
                       {name("power"), "", 0.2, 5.0, true}, starts_at({0.5, 1.5, 2.5}))};
  for (const char* pattern : {"exp(x/scale)", "exp(-x/scale)"})
    all.push_back(shaped_candidate(form(pattern), x,
                                   {name("scale"), range.unit, span / 12.0, span / 0.3, true},
                                   geometric_starts(span / 6.0, span, 3)));
  for (Candidate& candidate : all) candidate.equation = equation;
  return all;
}

}  // namespace

std::vector<Explanation> fitted_formulas(const Problem& problem, const Baseline& base,
                                         const Explanation& rest, Index equation,
                                         const std::string& variable) {
  const VariableRange range = base.scope.range_of(Expression::variable(variable));
  if (!(range.high > range.low) || !std::isfinite(rest.fit.deviance)) return {};
  std::vector<Explanation> fits;
  for (const ScreenedCandidate& formula :
       screen(formulas_of(base.scope, range, equation), Screening(rest.fit), {},
              problem.context)) {
    std::vector<FittedEffect> effects = rest.effects;
    effects.push_back({formula.candidate, formula.shapes, formula.coefficient, 0.0});
    fits.push_back(explain_on(problem, base, rest.fit, effects));
  }
  std::erase_if(fits, [](const Explanation& fit) { return !std::isfinite(fit.fit.deviance); });
  std::sort(fits.begin(), fits.end(), [&](const Explanation& a, const Explanation& b) {
    return criterion_of(problem, base, a) < criterion_of(problem, base, b);
  });
  return fits;
}

Expression formula_with_numbers(const FittedEffect& formula) {
  const Candidate& candidate = formula.candidate;
  const Vector &shapes = formula.shapes, &errors = formula.shape_deviations;
  const auto with_number = [&](const Expression& form) {
    return Expression::number(formula.coefficient) * form;
  };
  if (candidate.form.operation() != Operation::Sin || errors.size() != shapes.size())
    return with_number(bind_form(candidate, as_span(shapes)));
  const auto phase = interval95(shapes[1], errors[1]);
  if (phase[0] > 0.0 || phase[1] < 0.0)
    return with_number(bind_form(candidate, as_span(shapes)));
  return with_number(Expression::make(
      Operation::Sin, {Expression::number(shapes[0]) * candidate.argument}));
}

}  // namespace lacuna
