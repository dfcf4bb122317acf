// SPDX-License-Identifier: MIT
#include "constrained_equations.hpp"

#include <algorithm>
#include <cmath>

#include "core/numerics/constrained_least_squares.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/core/statistics/interval.hpp"
#include "lacuna/regression/linear/least_squares_system.hpp"

namespace lacuna {
namespace {

CoefficientPlaces places_of(const IdentificationResult& result, const TermLibrary& library) {
  CoefficientPlaces places;
  for (std::size_t k = 0; k < result.fit.size(); ++k) {
    if (result.fit[k].identity) continue;
    for (const WeightedTerm& summand : result.model.equations()[k]) {
      const auto found = std::find(library.terms.begin(), library.terms.end(), summand.term);
      places.emplace_back(static_cast<Index>(k), found - library.terms.begin());
    }
  }
  return places;
}

/// The places of a model with those that constraints ask for: of a bound that absent terms do not
/// satisfy, all.
CoefficientPlaces places_under(const EquationLibraries& libraries,
                               const IdentificationResult& result) {
  CoefficientPlaces places = places_of(result, libraries.library);
  for (const CoefficientConstraint& bound : libraries.bounds) {
    if (!(bound.value < 0.0)) continue;
    const CoefficientPlaces all = constrained_coefficients({bound});
    const bool is_there = std::any_of(all.begin(), all.end(), [&](const auto& place) {
      return std::find(places.begin(), places.end(), place) != places.end();
    });
    if (!is_there) places.insert(places.end(), all.begin(), all.end());
  }
  return closure(libraries.constraints, std::move(places));
}

/// Whether a coefficient is 0 because it alone is bounded by 0.
bool is_held_at_zero(const EquationLibraries& libraries, const std::vector<Index>& active,
                     const std::pair<Index, Index>& place) {
  return std::any_of(active.begin(), active.end(), [&](Index number) {
    const CoefficientConstraint& bound = libraries.bounds[static_cast<std::size_t>(number)];
    return bound.summands.size() == 1 && bound.value == 0.0 &&
           bound.summands[0].equation == place.first && bound.summands[0].term == place.second;
  });
}

/// The terms of one equation among places.
TermSet terms_of(const CoefficientPlaces& places, Index equation) {
  TermSet terms;
  for (const auto& [k, term] : places)
    if (k == equation) terms.push_back(term);
  return terms;
}

/// The equations as one problem |R h - c|, each row divided by the rms of its equation's
/// residuals; coefficients in the order of the places.
struct JointProblem {
  Matrix r;
  Vector c;
};

JointProblem joint_problem(const LeastSquaresSystem& system, const CoefficientPlaces& places,
                           Index equations) {
  constexpr double kRoundingFraction = 1e-12;  // of the target: what rounding leaves
  const auto size = static_cast<Index>(places.size());
  JointProblem joint{Matrix::Zero(size, size), Vector::Zero(size)};
  Index first = 0;
  for (Index k = 0; k < equations; ++k) {
    const TermSet terms = terms_of(places, k);
    if (terms.empty()) continue;
    const Subproblem problem = system.subproblem(k, terms);
    const auto count = static_cast<Index>(terms.size());
    const double rms =
        std::max(problem.residual_norm(), kRoundingFraction * problem.target_norm()) /
        std::sqrt(std::max(1.0, double(problem.rows() - count)));
    const double weight = rms > 0.0 ? 1.0 / rms : 1.0;
    joint.r.block(first, first, count, count) =
        weight * (problem.triangle() * problem.column_norms().asDiagonal()).eval();
    joint.c.segment(first, count) = weight * problem.projected_target();
    first += count;
  }
  return joint;
}

void enter_in_trail(const std::string& equation, const WeightedTerm& summand,
                    std::vector<TrailEntry>& trail) {
  for (TrailEntry& entry : trail)
    if (entry.equation == equation && entry.term == summand.term.name())
      entry = {.equation = equation,
               .term = entry.term,
               .kept = true,
               .quantity = "coefficient",
               .value = summand.coefficient};
}

/// Notes that a term left because its coefficient would be beyond its bound.
void leave_trail(const std::string& equation, const Term& term,
                 std::vector<TrailEntry>& trail) {
  for (TrailEntry& entry : trail)
    if (entry.equation == equation && entry.term == term.name())
      entry = {.equation = equation,
               .term = entry.term,
               .kept = false,
               .stage = "constraint",
               .quantity = "coefficient"};
}

WeightedTerm summand_of(const Term& term, double coefficient, double variance) {
  WeightedTerm summand{term, coefficient};
  const double error = std::sqrt(variance);
  if (!(error > 1e-12 * std::abs(coefficient)) || !std::isfinite(error)) return summand;
  summand.standard_error = error;
  summand.ci95 = interval95(coefficient, error);
  return summand;
}

}  // namespace

std::vector<std::size_t> satisfy_constraints(const LeastSquaresSystem& system,
                                             const EquationLibraries& libraries,
                                             IdentificationResult& result) {
  if (!libraries.is_constrained()) return {};
  const CoefficientPlaces places = places_under(libraries, result);
  const ConstraintMatrix constraints = constraint_matrix(libraries.constraints, places);
  const ConstraintMatrix bounds = constraint_matrix(libraries.bounds, places);
  const JointProblem joint = joint_problem(system, places, result.model.dimension());
  const auto found = inequality_least_squares(joint.r, joint.c, constraints.a, constraints.b,
                                              bounds.a, bounds.b);
  if (!found)
    throw ConfigError("constraints", "the terms of the model cannot satisfy them",
                      "leave some of them out, or use --degree or --add for more terms");
  const ConstrainedSolution& solution = found->solution;
  std::vector<Equation> equations = result.model.equations();
  for (std::size_t k = 0; k < equations.size(); ++k)
    if (!result.fit[k].identity) equations[k].clear();
  for (std::size_t i = 0; i < places.size(); ++i) {
    const auto k = static_cast<std::size_t>(places[i].first);
    const Term& term = libraries.library.terms[static_cast<std::size_t>(places[i].second)];
    const auto at = static_cast<Index>(i);
    if (is_held_at_zero(libraries, found->active, places[i])) {
      leave_trail(result.fit[k].equation, term, result.trail);
      continue;
    }
    equations[k].push_back(summand_of(term, solution.h[at], solution.variances[at]));
    enter_in_trail(result.fit[k].equation, equations[k].back(), result.trail);
  }
  result.model = result.model.with_equations(std::move(equations));
  return {found->active.begin(), found->active.end()};
}

std::optional<std::size_t> most_violated(const EquationLibraries& libraries,
                                         const OdeModel& model) {
  constexpr double kRounding = 1e-9;  // of the summands
  std::optional<std::size_t> worst;
  double most = kRounding;
  for (std::size_t i = 0; i < libraries.bounds.size(); ++i) {
    const CoefficientConstraint& bound = libraries.bounds[i];
    double sum = -bound.value, size = std::abs(bound.value);
    for (const ConstrainedCoefficient& summand : bound.summands) {
      const Term& term = libraries.library.terms[static_cast<std::size_t>(summand.term)];
      const double value =
          summand.factor * model.coefficient(summand.equation, term.name());
      sum += value;
      size += std::abs(value);
    }
    if (!(size > 0.0) || !(sum / size > most)) continue;
    most = sum / size;
    worst = i;
  }
  return worst;
}

}  // namespace lacuna
