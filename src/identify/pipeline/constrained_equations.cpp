// SPDX-License-Identifier: MIT
#include "constrained_equations.hpp"

#include <algorithm>
#include <cmath>

#include "core/numerics/constrained_least_squares.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/core/statistics/interval.hpp"
#include "lacuna/regression/linear/subproblem.hpp"

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

WeightedTerm summand_of(const Term& term, double coefficient, double variance) {
  WeightedTerm summand{term, coefficient};
  const double error = std::sqrt(variance);
  if (!(error > 1e-12 * std::abs(coefficient)) || !std::isfinite(error)) return summand;
  summand.standard_error = error;
  summand.ci95 = interval95(coefficient, error);
  return summand;
}

}  // namespace

void satisfy_constraints(const LeastSquaresSystem& system, const EquationLibraries& libraries,
                         IdentificationResult& result) {
  if (libraries.constraints.empty()) return;
  const CoefficientPlaces places =
      closure(libraries.constraints, places_of(result, libraries.library));
  const ConstraintMatrix constraints = constraint_matrix(libraries.constraints, places);
  if (!is_feasible(constraints.a, constraints.b))
    throw ConfigError("constraints", "the terms of the model cannot satisfy them",
                      "leave some of them out, or use --degree or --add for more terms");
  const JointProblem joint = joint_problem(system, places, result.model.dimension());
  const ConstrainedSolution solution =
      constrained_least_squares(joint.r, joint.c, constraints.a, constraints.b);
  std::vector<Equation> equations = result.model.equations();
  for (std::size_t k = 0; k < equations.size(); ++k)
    if (!result.fit[k].identity) equations[k].clear();
  for (std::size_t i = 0; i < places.size(); ++i) {
    const auto k = static_cast<std::size_t>(places[i].first);
    const Term& term = libraries.library.terms[static_cast<std::size_t>(places[i].second)];
    const auto at = static_cast<Index>(i);
    equations[k].push_back(summand_of(term, solution.h[at], solution.variances[at]));
    enter_in_trail(result.fit[k].equation, equations[k].back(), result.trail);
  }
  result.model = result.model.with_equations(std::move(equations));
}

}  // namespace lacuna
