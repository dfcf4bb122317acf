// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "lacuna/effects/families.hpp"
#include "lacuna/effects/terms.hpp"

namespace lacuna {
namespace {

// Delays from a sampling step, below which a delay is a lag, up to a quarter of the record;
// starts so dense that none lies further from the truth
// than half the time in which the variable forgets, up to a hundred.
constexpr double kMostStarts = 100.0;

Candidate delayed(const Scope& scope, const std::string& form, const std::string& argument,
                  double timescale) {
  const double longest = 0.25 * scope.duration;
  const double spacing = std::max(0.5 * timescale, scope.step);
  std::vector<double> starts;
  for (double delay = spacing; delay < longest && delay <= kMostStarts * spacing;
       delay += spacing)
    starts.push_back(delay);
  return shaped_candidate(form, argument, "delayed action of " + argument,
                          {"T", scope.model.time_unit(), scope.step, longest, false},
                          starts_at(starts));
}

// A short delay acts like a rate of change, which could make up for the whole of the equation:
// what comes late is no more than twice what the nominal model has of it, and what a state does
// to itself no faster than the state is.
void bound_to(const Scope& scope, Index equation, const std::string& term, double rate,
              Candidate& candidate) {
  candidate.most = 2.0 * (std::abs(slope(scope.model, equation, term)) + rate);
  candidate.least = -candidate.most;
}

// The fastest of the variables that stand in a term.
double timescale_of(const Scope& scope, const std::string& term) {
  const auto names = parse_expression(term, scope.model.variables().names()).variables();
  double shortest = scope.duration;
  for (const VariableRange& variable : scope.variables)
    if (names.contains(variable.name)) shortest = std::min(shortest, variable.timescale);
  return shortest;
}

void add_variables(const Scope& scope, Index equation, std::vector<Candidate>& result) {
  for (const VariableRange& x : scope.variables) {
    const bool present = has_term(scope, equation, x.name);
    const bool own = x.name == scope.state(equation).name;
    const std::string late = "delay(" + x.name + ",$T)";
    result.push_back(delayed(scope, present ? late + "-" + x.name : late, x.name, x.timescale));
    if (present || own)
      bound_to(scope, equation, x.name, own ? 1.0 / x.timescale : 0.0, result.back());
  }
}

// A term as a whole, and one factor of a product: x(t) x(t - T) in place of x^2.
void add_term(const Scope& scope, Index equation, const std::string& term,
              std::vector<Candidate>& result) {
  const auto add = [&](const std::string& rest, const std::string& late,
                       const std::string& argument) {
    result.push_back(delayed(scope, rest + "(delay(" + late + ",$T)-(" + late + "))", argument,
                             timescale_of(scope, late)));
    bound_to(scope, equation, term, 0.0, result.back());
  };
  add("", term, term);
  for (const Factor& factor : factors_of(scope, term))
    add("(" + factor.rest + ")*", factor.factor, factor.factor + " in " + term);
}

std::vector<Candidate> make(const Scope& scope, Index equation) {
  std::vector<Candidate> result;
  add_variables(scope, equation, result);
  for (const std::string& term : nonlinear_terms(scope, equation))
    add_term(scope, equation, term, result);
  std::erase_if(result, [](const Candidate& candidate) { return candidate.starts.empty(); });
  return result;
}

bool plausible(const Scope&, const Candidate& candidate, const FittedCandidate& fitted) {
  return candidate.least <= fitted.coefficient && fitted.coefficient <= candidate.most;
}

}  // namespace

const EffectFamily kDelay{{"delay", "Something acts a fixed time later", ""},
                          "transport, a queue, a computer in the loop, sound, gestation",
                          {},
                          make,
                          plausible};

}  // namespace lacuna
