// SPDX-License-Identifier: MIT
#include "identify/forms_beside/function_forms.hpp"

#include <algorithm>

#include "lacuna/effects/effects.hpp"
#include "product_forms.hpp"

namespace lacuna {
namespace {

/// Forms without shape parameters; x is in its place wherever it may be.
constexpr const char* kPlain[] = {"sin(x)", "cos(x)"};
/// The same for variables that are no amounts.
constexpr const char* kPlainOfBothSigns[] = {"abs(x)", "x*abs(x)", "sign(x)"};
/// The same for amounts, which are positive.
constexpr const char* kPlainOfAmounts[] = {"sqrt(x)", "log(x)", "x*log(x)"};

/// A form with one length `a` on the scale of x: from where it is a jump to where it is a
/// polynomial of low degree.
constexpr const char* kOfLength[] = {"sin(x/a)",      "cos(x/a)",      "exp(x/a)",
                                     "exp(-x/a)",     "1/(1+x^2/a^2)", "x/(1+x^2/a^2)",
                                     "x^2/(a^2+x^2)", "tanh(x/a)"};
constexpr const char* kOfLengthOfAmounts[] = {"x/(a+x)", "x^4/(a^4+x^4)"};

constexpr const char* kLogistic[] = {"1/(1+exp((middle-x)/width))",
                                     "1/(1+exp((x-middle)/width))"};

void add_plain(const Scope& scope, const char* pattern, const Expression& x,
               std::vector<Candidate>& result) {
  result.push_back(plain_candidate(formula(scope, pattern, {{"x", x}}), x));
}

void add_of_length(const Scope& scope, const char* pattern, const Expression& x,
                   std::vector<Candidate>& result) {
  const VariableRange range = scope.range_of(x);
  const double size = std::max(range.magnitude(), 1e-300);
  result.push_back(
      shaped_candidate(formula(scope, pattern, {{"x", x}}), x,
                       {scope.free_name("a"), range.unit, 0.02 * size, 20.0 * size, true},
                       geometric_starts(0.05 * size, 4.0 * size, 9)));
}

/// 1 / (1 + exp(-(x - middle) / width)), or what falls instead of rising.
void add_logistic(const Scope& scope, const char* pattern, const Expression& x,
                  std::vector<Candidate>& result) {
  const VariableRange range = scope.range_of(x);
  const double size = range.high - range.low;
  if (!(size > 0.0)) return;
  Candidate candidate = plain_candidate(formula(scope, pattern, {{"x", x}}), x);
  candidate.shapes = {
      {scope.free_name("middle"), range.unit, range.low - size, range.high + size, false},
      {scope.free_name("width"), range.unit, 0.005 * size, 2.0 * size, true}};
  candidate.starts.clear();
  for (const double place : {-0.3, 0.25, 0.5, 0.75, 1.3})
    for (const double width : {0.05, 0.2})
      candidate.starts.push_back(Eigen::Vector2d(range.low + place * size, width * size));
  result.push_back(std::move(candidate));
}

void add_power(const Scope& scope, const Expression& x, std::vector<Candidate>& result) {
  result.push_back(shaped_candidate(formula(scope, "x^power", {{"x", x}}), x,
                                    {scope.free_name("power"), "", 0.1, 8.0, true},
                                    starts_at({0.3, 0.7, 1.3, 2.5, 5.0})));
}

void add_functions_of(const Scope& scope, const VariableRange& range,
                      std::vector<Candidate>& result) {
  const Expression x = Expression::variable(range.name);
  for (const char* pattern : kPlain) add_plain(scope, pattern, x, result);
  if (!range.is_amount())
    for (const char* pattern : kPlainOfBothSigns) add_plain(scope, pattern, x, result);
  for (const char* pattern : kOfLength) add_of_length(scope, pattern, x, result);
  for (const char* pattern : kLogistic) add_logistic(scope, pattern, x, result);
  if (range.is_amount())
    for (const char* pattern : kOfLengthOfAmounts) add_of_length(scope, pattern, x, result);
  if (!(range.low > 0.0)) return;
  for (const char* pattern : kPlainOfAmounts) add_plain(scope, pattern, x, result);
  add_power(scope, x, result);
}

bool has_delay(const Expression& expression) {
  return expression.operation() == Operation::Delay ||
         std::any_of(expression.operands().begin(), expression.operands().end(), has_delay);
}

/// |x| of an amount is x.
Expression without_abs_of_amounts(const Expression& expression, const Scope& scope) {
  const auto operands = expression.operands();
  if (operands.empty() || expression.operation() == Operation::Delay) return expression;
  if (expression.operation() == Operation::Abs &&
      operands[0].operation() == Operation::Variable)
    for (const VariableRange& range : scope.variables)
      if (range.name == operands[0].name() && range.is_amount()) return operands[0];
  std::vector<Expression> plain;
  for (const Expression& operand : operands)
    plain.push_back(without_abs_of_amounts(operand, scope));
  return Expression::make(expression.operation(), std::move(plain));
}

/// Candidates for an equation, each with a start.
std::vector<Candidate> placed(std::vector<Candidate> candidates, Index equation) {
  for (Candidate& candidate : candidates) {
    candidate.equation = equation;
    if (candidate.starts.empty()) candidate.starts = {Vector()};
  }
  return candidates;
}

/// Adds those that are not there.
void add_new(const std::vector<Candidate>& more, std::vector<Candidate>& all) {
  const std::size_t known = all.size();
  for (const Candidate& candidate : more)
    if (std::none_of(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(known),
                     [&](const Candidate& other) { return are_one_form(other, candidate); }))
      all.push_back(candidate);
}

/// Whether a candidate is a function of what is measured at the moment.
bool acts_at_once(const Candidate& candidate) {
  return candidate.place == Place::Rate && candidate.memory.empty() &&
         !candidate.form.variables().contains("t") && !has_delay(candidate.form);
}

}  // namespace

std::vector<Candidate> function_forms(const Scope& scope,
                                      const std::vector<Stage<Effect>>& effects,
                                      Index equation) {
  std::vector<Candidate> all;
  for (const VariableRange& range : scope.variables)
    if (!range.is_input) add_functions_of(scope, range, all);
  for (const Stage<Effect>& effect : effects)
    for (Candidate& candidate : effect->candidates(scope, equation))
      if (acts_at_once(candidate)) {
        candidate.form = without_abs_of_amounts(candidate.form, scope);
        all.push_back(std::move(candidate));
      }
  all = merged(placed(std::move(all), equation));
  add_new(placed(product_forms(scope), equation), all);
  return all;
}

}  // namespace lacuna
