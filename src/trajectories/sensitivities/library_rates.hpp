// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lacuna/model/equations/term.hpp"
#include "trajectories/sensitivities/weighted_sums.hpp"

namespace lacuna {

/// Values of some terms of a library, theta, and the Jacobian of f_k = sum_l h_kl theta_l with
/// respect to the states, for blocks of points.
class LibraryRates {
 public:
  /// Which terms are wanted; both lists in increasing order.
  struct Choice {
    std::vector<Index> terms;   ///< by value
    std::vector<Index> moving;  ///< by derivative: those with a coefficient in some equation
    bool operator==(const Choice&) const = default;
  };

  /// @param delayed whether the library has delayed variables.
  LibraryRates(const TermLibrary& library, Choice choice, bool delayed);

  const Choice& choice() const noexcept { return choice_; }

  /// Evaluates at each row of slots, which are those of TermLibrary::compile().
  void evaluate(const Eigen::Ref<const Matrix>& slots);

  /// Terms x points of the last evaluation.
  const Matrix& theta() const noexcept { return theta_; }

  /// df_k/dx_j = sum_l coefficients(k, l) d theta_l / dx_j over the moving terms, in row
  /// k + m j of column i for point i.
  /// @param coefficients m x L, m states of the library.
  void jacobians(const Matrix& coefficients, Matrix& jacobians);

 private:
  Program compile(const TermLibrary& library, bool delayed);

  Choice choice_;
  Index first_ = 0;      // output of the first term
  PlacedSums jacobian_;  // parameter k + m l is the coefficient of term l in equation k
  Program program_;
  Program::Workspace workspace_;
  Matrix values_, theta_, entries_;  // points x outputs, terms x points, points x places
};

}  // namespace lacuna
