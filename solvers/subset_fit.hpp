// SPDX-License-Identifier: MIT
// What methods that choose some of the terms share.
#pragma once

#include <string>

#include "lacuna/regression/stages/solvers.hpp"

namespace lacuna {

/// Least squares on some of the terms, and what each of the others would take off.
struct SubproblemFit {
  double residual = 0.0;  ///< |y - Theta_S h|
  Vector gains;  ///< k: what |residual|^2 loses by each further term; 0 for members of S, and
                 ///< where a term depends on them
};

/// @param positions of the terms S in the problem, independent of each other.
SubproblemFit fit_subset(const Subproblem& problem, const TermSet& positions);

/// rho: the residual that no coefficients remove.
double unexplained(const Subproblem& problem);

/// A penalty for terms (Schwarz 1978):
///
///   score = 2 n log(max(|r|, 1e-12 |y|) / |y|) + penalty k log n
///
/// for n rows, k terms and the residual r. A residual of 1e-12 |y| is rounding.
class SubsetScore {
 public:
  SubsetScore(const Subproblem& problem, double penalty);

  double operator()(double residual, Index terms) const;

  /// What a further term has to take off |residual|^2 to lower the score.
  double least_gain(double residual) const;

 private:
  double rows_;
  double term_penalty_;
  double target_norm_;
};

/// The answer of a method that chose terms: least squares on them, the others removed.
/// @param positions of the chosen terms, increasing.
/// @param quantity what a term was judged by; @param values of all terms of the problem.
/// @param threshold what the values were compared with.
struct SubsetChoice {
  TermSet positions = {};
  std::string quantity = {};
  Vector values = {};
  double threshold = 0.0;
  bool converged = true;
  int iterations = 0;
};
Regression regression_on(const LeastSquaresSystem& system, const Subproblem& problem,
                         const SubsetChoice& choice, Effort effort, const RunContext& context);

/// Of |c - R z|^2 + sum_j penalty_j z_j^2 the solution z, for columns of unit norm.
Vector ridge_solution(const Matrix& triangle, const Vector& target, const Vector& penalty);

/// Positions of entries that are not 0.
TermSet support_of(const Vector& coefficients);

}  // namespace lacuna
