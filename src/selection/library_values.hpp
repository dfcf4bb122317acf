// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lacuna/model/term.hpp"

namespace lacuna {

/// Candidate terms and their derivatives with respect to the states, for blocks of points.
class LibraryValues {
 public:
  explicit LibraryValues(const TermLibrary& library);

  Index terms() const noexcept { return terms_; }
  Index dimension() const noexcept { return dimension_; }
  const Program& program() const noexcept { return program_; }

  /// Evaluates at each row of slots.
  void evaluate(const Eigen::Ref<const Matrix>& slots);

  /// Column i: all terms at point i of the last evaluation.
  auto theta(Index point) const { return values_.col(point).head(terms_); }

  /// J(k, j) = sum_l coefficients(k, l) d theta_l / dx_j at a point.
  void jacobian(Index point, const Matrix& coefficients, Matrix& jacobian) const;

 private:
  struct Partial {
    Index term, state, output;
  };
  static Program compile(const TermLibrary& library, std::vector<Partial>& partials);

  Index terms_, dimension_;
  std::vector<Partial> partials_;  // those that are not always zero
  Program program_;
  Program::Workspace workspace_;
  Matrix rows_, values_;  // points x outputs, and transposed
};

}  // namespace lacuna
