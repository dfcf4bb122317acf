// SPDX-License-Identifier: MIT
// Equations with libraries of their own.
#pragma once

#include <vector>

#include "lacuna/identify/pipeline/pipeline.hpp"

namespace lacuna {

/// States and inputs of a dataset.
Variables variables_of(const Dataset& data);

/// One library for a run, with the terms that each equation may have of it.
struct EquationLibraries {
  TermLibrary library;
  std::vector<TermSet> allowed = {};  ///< of each state; empty: all terms for all
  std::vector<bool> own = {};         ///< whether the equation's library was named; or empty
  std::vector<CoefficientConstraint> constraints = {};
  std::vector<CoefficientConstraint> bounds = {};  ///< sums that are at most the value

  /// Whether coefficients have to satisfy anything.
  bool is_constrained() const { return !constraints.empty() || !bounds.empty(); }
};

/// The libraries in which some of the bounds, by their numbers, are equalities: a coefficient
/// that is 0 then is that of a term which the equation may not have.
EquationLibraries with_active(EquationLibraries libraries,
                              const std::vector<std::size_t>& active);

/// The library of the basis, widened by the terms that equations and constraints name.
/// Equations without a library of their own have that of the basis and the terms of their
/// constraints.
/// @throws ConfigError for an unknown state, a state named twice, an equation without terms, a
///   constraint on an identity, constraints that contradict one another; ModelError for a
///   formula that cannot be read.
EquationLibraries equation_libraries(TermLibrary basis, const Dataset& data,
                                     const Pipeline& pipeline);

/// The terms that stand in both sets.
TermSet common_terms(const TermSet& a, const TermSet& b);

}  // namespace lacuna
