// SPDX-License-Identifier: MIT
// The most probable individual values of one record of a population.
#pragma once

#include "population_problem.hpp"

namespace lacuna {

/// The mode of one record's own numbers, and Laplace's approximation about it.
struct RecordMode {
  Vector own;  ///< free initial values, own parameters, deviations in spreads
  /// -2 log of the likelihood, what is known of own numbers before with it; infinite where no
  /// free run is finite. Deviations are normal numbers: |z|^2 is part of it.
  double loss = 0.0;
  double log_determinant = 0.0;  ///< of the curvature of half the loss by the deviations
  Matrix covariance;             ///< own x own, the numbers of the population held
};

/// Rows and residuals of a record as normal equations: sums over its values.
struct RecordNormal {
  Matrix matrix;    ///< J'J of [own, global parameters], what is known before with it
  Vector gradient;  ///< J'r
};

/// Writes what own numbers make of a record into its row of a point.
void place_own(const PopulationProblem& problem, const PopulationValues& values,
               const Vector& own, Index record, FitPoint& point);

/// The normal equations along the path of a record.
RecordNormal record_normal(FitEngine& engine, const PopulationProblem& problem,
                           const PopulationValues& values, const Vector& own, Index record,
                           const FitPoint& point, const FitPath& path);

/// Maximises the likelihood of one record over its own numbers by the scoring method with the
/// damping of Levenberg and Marquardt; row and rows of the record in `point` and `path` are those
/// of the mode. -2 log of the likelihood with deviations z integrated out is, by Laplace,
///   loss + log det(I + Z'Z),  Z the whitened derivatives by z
/// (Wolfinger, Biometrika 80:791-795, 1993; with the expected information in the place of second
/// derivatives it is the first-order conditional estimate with interaction: Lindstrom and Bates,
/// Biometrics 46:673-687, 1990; Wang, J. Pharmacokinet. Pharmacodyn. 34:575-593, 2007). It is
/// exact where the model is linear in z and noise is normal of known size.
/// @param guess where the search starts.
RecordMode find_mode(FitEngine& engine, const PopulationProblem& problem,
                     const PopulationValues& values, Index record, const Vector& guess,
                     FitPoint& point, FitPath& path);

}  // namespace lacuna
