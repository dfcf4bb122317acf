// SPDX-License-Identifier: MIT
// Numbers that are not finite make numbers that are not finite.
#pragma once

#include <utility>
#include <vector>

#include "lacuna/core/base/types.hpp"

namespace lacuna {

/// One summand of a constraint: factor times the coefficient of a term in an equation.
struct ConstrainedCoefficient {
  Index equation = 0;
  Index term = 0;  ///< number in the library
  double factor = 1.0;
};

/// What coefficients of a model have to satisfy: sum_i factor_i h_i = value. Coefficients of
/// terms that are not in the model are 0.
struct CoefficientConstraint {
  std::vector<ConstrainedCoefficient> summands;
  double value = 0.0;
};

/// Places of coefficients, (equation, term).
using CoefficientPlaces = std::vector<std::pair<Index, Index>>;

/// The constraints on some coefficients, the others being 0: A h = b.
struct ConstraintMatrix {
  Matrix a;  ///< constraints x coefficients
  Vector b;
};

/// One row for each constraint that names one of the places, one column for each place.
ConstraintMatrix constraint_matrix(const std::vector<CoefficientConstraint>& constraints,
                                   const CoefficientPlaces& places);

/// Every coefficient that a constraint names, each once, in order.
CoefficientPlaces constrained_coefficients(
    const std::vector<CoefficientConstraint>& constraints);

/// Places with those that constraints ask for: all of a constraint of which one is there alone
/// (which would have to be 0), or none though the value is not 0; in order.
CoefficientPlaces closure(const std::vector<CoefficientConstraint>& constraints,
                          CoefficientPlaces places);

}  // namespace lacuna
