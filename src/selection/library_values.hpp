// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lacuna/model/term.hpp"

namespace lacuna {

/// Values of some terms of a library, and derivatives of some with respect to the states, for
/// blocks of points.
class LibraryValues {
 public:
  /// Which terms are wanted; both lists in increasing order.
  struct Choice {
    std::vector<Index> terms;   ///< by value
    std::vector<Index> moving;  ///< by derivative
    bool operator==(const Choice&) const = default;
  };

  /// @param delayed whether the library has delayed variables.
  LibraryValues(const TermLibrary& library, Choice choice, bool delayed);

  const Choice& choice() const noexcept { return choice_; }

  /// Evaluates at each row of slots, which are those of TermLibrary::compile().
  void evaluate(const Eigen::Ref<const Matrix>& slots);

  /// Terms x points of the last evaluation.
  const Matrix& theta() const noexcept { return theta_; }

  /// J(k, j) = sum_l coefficients(k, l) d theta_l / dx_j over the moving terms, in row k + m j
  /// of column i for point i.
  void jacobians(const Matrix& coefficients, Matrix& jacobians) const;

 private:
  struct Partial {
    Index term, state, output;
  };
  Program compile(const TermLibrary& library, bool delayed);

  Choice choice_;
  Index first_ = 0;                // output of the first term
  std::vector<Partial> partials_;  // those that are not always zero
  Program program_;
  Program::Workspace workspace_;
  Matrix values_, theta_;  // points x outputs, terms x points
};

}  // namespace lacuna
