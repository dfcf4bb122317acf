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

namespace lacuna {
namespace {

/// The pattern in x, with a shape parameter for each of the other names in it.
Candidate pattern_of(const Scope& scope, const Expression& x, Index equation,
                     const std::string& pattern, std::vector<ShapeParameter> shapes) {
  std::vector<std::pair<std::string, Expression>> names{{"x", x}};
  Candidate candidate;
  for (ShapeParameter& shape : shapes) {
    const std::string own = scope.free_name(shape.name);
    names.emplace_back(shape.name, Expression::variable(own));
    shape.name = own;
  }
  candidate.form = substitute(parse_expression(pattern), {names.begin(), names.end()});
  candidate.argument = x;
  candidate.equation = equation;
  candidate.shapes = std::move(shapes);
  return candidate;
}

/// From low to high, each so many times the one before.
std::vector<double> geometric(double low, double high, int count) {
  std::vector<double> values;
  for (int i = 0; i < count; ++i)
    values.push_back(low * std::pow(high / low, i / static_cast<double>(count - 1)));
  return values;
}

/// A sine, a power and an exponential of one variable. Their ranges are facts of the search: a
/// sine of an eighth of a turn to four turns over the range of the variable, an exponential that
/// grows by e^0.3 to e^12.
std::vector<Candidate> formulas_of(const Scope& scope, const VariableRange& range,
                                   Index equation) {
  constexpr double kTurn = 2.0 * std::numbers::pi;
  const double span = range.high - range.low;
  const Expression x = Expression::variable(range.name);
  const auto pattern = [&](const char* form, std::vector<ShapeParameter> shapes) {
    return pattern_of(scope, x, equation, form, std::move(shapes));
  };
  std::vector<Candidate> all{
      pattern("sin(wave*x+phase)", {{"wave", "", kTurn / (8.0 * span), 4.0 * kTurn / span, true},
                                    {"phase", "rad", -kTurn, kTurn, false}}),
      pattern(range.changes_sign() ? "sign(x)*abs(x)^power" : "abs(x)^power",
              {{"power", "", 0.2, 5.0, true}})};
  for (double turns = 0.2; turns < 4.0; turns += 0.25)
    for (const double phase : {0.0, 0.25 * kTurn})
      all[0].starts.push_back(Vector{{turns * kTurn / span, phase}});
  all[1].starts = {Vector::Constant(1, 0.5), Vector::Constant(1, 1.5), Vector::Constant(1, 2.5)};
  for (const char* form : {"exp(x/scale)", "exp(-x/scale)"}) {
    all.push_back(pattern(form, {{"scale", range.unit, span / 12.0, span / 0.3, true}}));
    for (const double scale : geometric(span / 6.0, span, 3))
      all.back().starts.push_back(Vector::Constant(1, scale));
  }
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
  const bool in_phase = shapes.size() == 2 && errors.size() == 2 &&
                        std::abs(shapes[1]) < 2.0 * errors[1];  // the second one of a sine
  const Expression form =
      in_phase ? Expression::make(Operation::Sin,
                                  {Expression::number(shapes[0]) * candidate.argument})
               : bind_form(candidate, as_span(shapes));
  return Expression::number(formula.coefficient) * form;
}

}  // namespace lacuna
