// SPDX-License-Identifier: MIT
// What records determine, and what only in combination.
#pragma once

#include <string>
#include <vector>

#include "fit_solver.hpp"
#include "lacuna/trajectories/fit/fit.hpp"

namespace lacuna {

/// Numbers of a problem with the triangle of its whitened rows.
struct DeterminedBy {
  const Matrix& triangle;                 ///< G x G
  const Vector& values;                   ///< G
  const std::vector<std::string>& names;  ///< G
};

/// Directions in which the whitened rows say nothing: the null space of R diag(|value|), which
/// has changes by a fraction of each number, and so an exponent for each in a product that is
/// determined. Each column has one entry 1; those of the numbers that it does not need are 0.
/// A direction counts as not determined below 1e-6 of the strongest one, or where the numbers
/// in it may change by more than their size though two of them at least would be known to a
/// fifth of it by themselves.
Matrix undetermined_directions(const DeterminedBy& problem);

/// What one direction says: "k1 and k4 only as k1*k4", "k: the records do not determine it".
/// @param is_sum whether the numbers count as a sum (see below) and not as a product.
FitCombination combination_of(const DeterminedBy& problem, const Vector& direction,
                              bool is_sum = false);

/// Whether a direction is that of a sum or difference of two numbers: their changes, not their
/// fractions, are equal.
bool may_be_sum(const DeterminedBy& problem, const Vector& direction);

/// Whether its exponents are those of a product or quotient of whole powers.
bool may_be_product(const Vector& direction);

}  // namespace lacuna
