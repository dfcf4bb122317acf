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

// A short delay of a state acts like its rate of change, which could make up for the whole of
// the equation: what acts on a state is no faster than the state itself.
void bound_to_own_rate(const Scope& scope, Index equation, Candidate& candidate) {
  const VariableRange& x = scope.state(equation);
  candidate.most = 2.0 * (std::abs(slope(scope.model, equation, x.name)) + 1.0 / x.timescale);
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

std::vector<Candidate> make(const Scope& scope, Index equation) {
  std::vector<Candidate> result;
  for (const VariableRange& x : scope.variables) {
    const bool present = has_term(scope, equation, x.name);
    const std::string late = "delay(" + x.name + ",$T)";
    result.push_back(delayed(scope, present ? late + "-" + x.name : late, x.name, x.timescale));
    if (x.name == scope.state(equation).name) bound_to_own_rate(scope, equation, result.back());
  }
  for (const std::string& term : nonlinear_terms(scope, equation))
    result.push_back(delayed(scope, "delay(" + term + ",$T)-(" + term + ")", term,
                             timescale_of(scope, term)));
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
