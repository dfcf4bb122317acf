// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <utility>

#include "effects/families.hpp"
#include "lacuna/effects/effects.hpp"

namespace lacuna {
namespace {

// A coarse converter may show 0 most of the time: the least limit is a fraction of the largest.
constexpr double kLeastLimit = 1e-3;

// Up to where a hard limit is reached in a few samples, and a soft one bends what is seen.
constexpr double kQuantileOfHardLimit = 0.995, kWidestSoftLimit = 3.0;

double hard_limit(const Scope& scope, const Expression& x) {
  return magnitude_quantile(scope, x, kQuantileOfHardLimit);
}

double soft_limit(const Scope& scope, const Expression& x) {
  return kWidestSoftLimit * magnitude_quantile(scope, x, 1.0);
}

Candidate limited(const Scope& scope, const char* form, const Expression& x, double widest) {
  const auto at = [&](double level) { return magnitude_quantile(scope, x, level); };
  const double least = std::max(at(0.05), kLeastLimit * at(1.0));
  return shaped_candidate(formula(scope, form, {{"x", x}}), x,
                          {"limit", scope.range_of(x).unit, least, widest, true},
                          starts_at({at(0.4), at(0.7), at(0.93), at(0.985)}));
}

// A hard limit and a soft one of something that the nominal model has unlimited: the form takes
// away what the term has too much, no more than the whole of it. With any coefficient it would
// be the action of clip or tanh, which is searched by itself, in another parametrisation.
void add_limits(const Scope& scope, Index equation, const Expression& x,
                std::vector<Candidate>& result) {
  if (!scope.range_of(x).changes_sign()) return;
  for (Candidate candidate :
       {limited(scope, "x-clip(x,-limit,limit)", x, hard_limit(scope, x)),
        limited(scope, "x-limit*tanh(x/limit)", x, soft_limit(scope, x))}) {
    bound_to_term(scope, equation, x, candidate);
    candidate.least = -std::exchange(candidate.most, -candidate.least);
    result.push_back(std::move(candidate));
  }
}

// Of the largest value: a steep action beside a term has reached its limit in most samples.
constexpr double kWidestSteepLimit = 0.3;

// An action of its own, which is at its limit soon, beside a term of the same argument.
void add_steep(const Scope& scope, const Expression& x, std::vector<Candidate>& result) {
  if (!scope.range_of(x).changes_sign()) return;
  result.push_back(plain_candidate(formula(scope, "sign(x)", {{"x", x}}), x));
  const double widest = magnitude_quantile(scope, x, 1.0);
  result.push_back(shaped_candidate(
      formula(scope, "tanh(x/limit)", {{"x", x}}), x,
      {"limit", scope.range_of(x).unit, kLeastLimit * widest, kWidestSteepLimit * widest, true},
      starts_at({0.01 * widest, 0.05 * widest, 0.15 * widest})));
}

// The same of something that the nominal equation does not have at all.
void add_new(const Scope& scope, const Expression& x, std::vector<Candidate>& result) {
  if (!scope.range_of(x).changes_sign()) return;
  result.push_back(limited(scope, "clip(x,-limit,limit)", x, hard_limit(scope, x)));
  result.push_back(limited(scope, "tanh(x/limit)", x, soft_limit(scope, x)));
}

std::vector<Candidate> saturation_forms(const Scope& scope, Index equation) {
  std::vector<Candidate> result;
  for (const Expression& x : linear_arguments(scope, equation))
    add_limits(scope, equation, x, result);
  for (const Expression& x : linear_arguments(scope, equation)) add_steep(scope, x, result);
  for (const Expression& g : nonlinear_terms(scope, equation))
    add_limits(scope, equation, g, result);
  for (const Expression& x : all_variables(scope))
    if (!has_term(scope, equation, x)) add_new(scope, x, result);
  return result;
}

// Whether a form acts of itself beside a nominal term that is what it was given as. Of a speed
// it is friction, or pushes and is nothing.
bool acts_beside_the_term(const FittedForm& fitted) {
  const Expression& x = fitted.candidate.argument;
  if (is_felt_speed(fitted.scope, fitted.candidate.equation, x)) return false;
  const double given = slope(fitted.scope.model, fitted.candidate.equation, x);
  return std::abs(nominal_slope(fitted) - given) <=
         fitted.options.equal_slopes * std::abs(given);
}

// Nothing of the slope is left beyond the limit. Where the nominal model has it, its term stays
// what acts inside and the form takes it away outside; a form that empties the nominal term
// is equivalent to it with other coefficients than were given.
std::optional<Reading> saturation_reading(const FittedForm& fitted) {
  const Candidate& candidate = fitted.candidate;
  if (has_form(candidate, "sign(x)") && acts_beside_the_term(fitted))
    return Reading{"action of " + candidate.argument.to_string() + " that switches"};
  const std::optional<Bend> bend = bend_of(fitted);
  if (!bend || !is_flat_outside(*bend, fitted.options)) return std::nullopt;
  const std::string x = candidate.argument.to_string();
  const bool known = slope(fitted.scope.model, candidate.equation, candidate.argument) != 0.0;
  const bool acts_inside =
      has_form(candidate, "clip(x,-a,a)") || has_form(candidate, "tanh(x/a)");
  const bool beside = has_form(candidate, "tanh(x/a)") && acts_beside_the_term(fitted);
  if (known && acts_inside && !beside) return std::nullopt;
  return Reading{known && !beside ? "saturation of " + x : "action of " + x + " that saturates",
                 Precedence::Plain,
                 {"limit"}};
}

}  // namespace

const EffectFamily kSaturation{
    {"saturation", "Something stops growing at a limit of both signs", ""},
    "an amplifier at its rails, a current limit, a magnetic core, a valve fully open",
    saturation_forms,
    saturation_reading};

}  // namespace lacuna
