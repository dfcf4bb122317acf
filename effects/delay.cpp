// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "effects/families.hpp"
#include "lacuna/effects/effects.hpp"

namespace lacuna {
namespace {

// Delays from a sampling step, below which a delay of a state is its rate (one of an input is
// known from a tenth of a step on), up to a quarter of the record;
// starts so dense that none lies further from the truth
// than half the time in which the variable forgets, up to a hundred.
constexpr double kMostStarts = 100.0;

// In sampling steps: what is shorter is a skew of the channel (a fact of the search).
constexpr double kShortestOfInput = 0.1;

Candidate delayed(const Scope& scope, const Expression& form, const Expression& argument,
                  double timescale) {
  const double shortest =
      is_input(scope, argument) ? kShortestOfInput * scope.step : scope.step;
  const double longest = 0.25 * scope.duration;
  const double spacing = std::max(0.5 * timescale, scope.step);
  std::vector<double> starts;
  if (shortest < scope.step && spacing < longest) {
    // An input that is held jumps at samples: its likelihood has a bend at each whole step. A
    // fact of the search: beyond so many steps the starts of all delays are near enough.
    constexpr int kFirstSteps = 4;
    for (int i = 0; i < kFirstSteps; ++i) starts.push_back((0.5 + i) * scope.step);
    std::erase_if(starts, [&](double start) { return start >= std::min(spacing, longest); });
    if (starts.empty()) starts.push_back(0.5 * scope.step);
  }
  for (double delay = spacing; delay < longest && delay <= kMostStarts * spacing;
       delay += spacing)
    starts.push_back(delay);
  return shaped_candidate(form, argument,
                          {"T", scope.model.time_unit(), shortest, longest, false},
                          starts_at(starts));
}

// A short delay acts like a rate of change, which could make up for the whole of the equation:
// what comes late is no more than twice what the nominal model has of it, and what a state does
// to itself no faster than the state is.
void bound_to(const Scope& scope, Index equation, const Expression& term, double rate,
              Candidate& candidate) {
  candidate.most = 2.0 * (std::abs(slope(scope.model, equation, term)) + rate);
  candidate.least = -candidate.most;
}

// The fastest of the variables that stand in a term.
double timescale_of(const Scope& scope, const Expression& term) {
  const auto names = term.variables();
  double shortest = scope.duration;
  for (const VariableRange& variable : scope.variables)
    if (names.contains(variable.name)) shortest = std::min(shortest, variable.timescale);
  return shortest;
}

void add_variables(const Scope& scope, Index equation, std::vector<Candidate>& result) {
  for (const VariableRange& range : scope.variables) {
    const Expression x = Expression::variable(range.name);
    const bool present = has_term(scope, equation, x);
    const bool own = x == own_state(scope, equation);
    const char* pattern = present ? "delay(x,T)-x" : "delay(x,T)";
    result.push_back(delayed(scope, formula(scope, pattern, {{"x", x}}), x, range.timescale));
    if (present || own)
      bound_to(scope, equation, x, own ? 1.0 / range.timescale : 0.0, result.back());
  }
}

// A term as a whole, and one factor of a product: x(t) x(t - T) in place of x^2.
void add_term(const Scope& scope, Index equation, const Expression& term,
              std::vector<Candidate>& result) {
  result.push_back(delayed(scope, formula(scope, "delay(x,T)-x", {{"x", term}}), term,
                           timescale_of(scope, term)));
  bound_to(scope, equation, term, 0.0, result.back());
  for (const TermFactor& part : factors_of(term)) {
    const Expression form =
        formula(scope, "rest*(delay(x,T)-x)", {{"rest", part.rest}, {"x", part.factor}});
    result.push_back(delayed(scope, form, part.factor, timescale_of(scope, part.factor)));
    result.back().within = term;
    bound_to(scope, equation, term, 0.0, result.back());
  }
}

std::vector<Candidate> delay_forms(const Scope& scope, Index equation) {
  std::vector<Candidate> result;
  add_variables(scope, equation, result);
  for (const Expression& term : nonlinear_terms(scope, equation))
    add_term(scope, equation, term, result);
  std::erase_if(result, [](const Candidate& candidate) { return candidate.starts.empty(); });
  return result;
}

// Shorter than a step the delay of a part of a term, or of what is new, is distinguished from a
// lag by nothing.
bool is_too_short(const FittedForm& fitted) {
  return fitted.shapes[0] < fitted.scope.step && !is_whole_term(fitted);
}

std::optional<Reading> delay_reading(const FittedForm& fitted) {
  const Candidate& candidate = fitted.candidate;
  if (candidate.shapes.size() != 1 || !contains(candidate.form, Operation::Delay) ||
      is_too_short(fitted) ||
      !(candidate.least <= fitted.coefficient && fitted.coefficient <= candidate.most))
    return std::nullopt;
  const std::string within =
      candidate.within ? " in " + candidate.within->to_string() : std::string();
  return Reading{"delayed action of " + candidate.argument.to_string() + within};
}

}  // namespace

const EffectFamily kDelay{{"delay", "Something acts a fixed time later", ""},
                          "transport, a queue, a computer in the loop, sound, gestation",
                          delay_forms,
                          delay_reading};

}  // namespace lacuna
