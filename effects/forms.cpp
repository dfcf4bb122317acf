// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <utility>

#include "lacuna/effects/effects.hpp"

namespace lacuna {

Expression formula(const Scope& scope, std::string_view pattern,
                   const std::map<std::string, Expression>& parts) {
  const Expression whole = parse_expression(pattern);
  std::map<std::string, Expression> all = parts;
  for (const std::string& name : whole.variables())
    if (!parts.contains(name)) all.emplace(name, Expression::variable(scope.free_name(name)));
  return substitute(whole, all);
}

Candidate plain_candidate(const Expression& form, const Expression& argument) {
  Candidate candidate;
  candidate.form = form;
  candidate.argument = argument;
  return candidate;
}

Candidate shaped_candidate(const Expression& form, const Expression& argument,
                           const ShapeParameter& shape, std::vector<Vector> starts) {
  Candidate candidate = plain_candidate(form, argument);
  candidate.shapes = {shape};
  candidate.starts = std::move(starts);
  for (Vector& start : candidate.starts) start = start.cwiseMax(shape.low).cwiseMin(shape.high);
  return candidate;
}

std::vector<Vector> geometric_starts(double low, double high, int count) {
  std::vector<Vector> starts;
  const double ratio = std::pow(high / low, 1.0 / std::max(1, count - 1));
  for (int i = 0; i < count; ++i)
    starts.push_back(Vector::Constant(1, std::min(high, low * std::pow(ratio, i))));
  return starts;
}

std::vector<Vector> starts_at(const std::vector<double>& values) {
  std::vector<Vector> starts;
  for (const double value : values) starts.push_back(Vector::Constant(1, value));
  return starts;
}

std::vector<ShapeParameter> rise_shapes(const Scope& scope, const Expression& v) {
  // Facts of the search: slower is standstill, faster a bend of the whole characteristic; from
  // a cusp to a step.
  constexpr double kSlowest = 0.005, kFastest = 0.5, kCusp = 0.5, kStep = 4.0;
  const VariableRange range = scope.range_of(v);
  const double widest = range.magnitude();
  return {{"speed", range.unit, kSlowest * widest, kFastest * widest, true},
          {"exponent", "", kCusp, kStep, true}};
}

Candidate play_of(const Scope& scope, Index equation, const Expression& x) {
  const VariableRange range = scope.range_of(x);
  const double reach = 0.5 * (range.high - range.low);
  Candidate candidate =
      shaped_candidate(formula(scope, "clip(follower-x,-gap,gap)", {{"x", x}}), x,
                       {"gap", range.unit, 0.01 * reach, reach, true},
                       starts_at({0.05 * reach, 0.15 * reach, 0.4 * reach}));
  // As good as at once for what is sampled.
  const Expression pace = Expression::number(8.0 / scope.step);
  candidate.memory = {{"follower",
                       formula(scope, "pace*((x-follower)-clip(x-follower,-gap,gap))",
                               {{"x", x}, {"pace", pace}}),
                       x}};
  bound_to_term(scope, equation, x, candidate);
  return candidate;
}

void bound_to_term(const Scope& scope, Index equation, const Expression& term,
                   Candidate& candidate) {
  // A fact of the search: a form does no more than undo the term and do the reverse.
  constexpr double kTimesSlope = 2.0;
  const double most = kTimesSlope * slope(scope.model, equation, term);
  candidate.least = std::min(0.0, most);
  candidate.most = std::max(0.0, most);
}

}  // namespace lacuna
