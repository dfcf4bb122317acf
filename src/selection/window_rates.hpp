// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "lacuna/flow/library_rates.hpp"
#include "windowed_path.hpp"

namespace lacuna {

/// Equations whose coefficients are sought.
struct CandidateEquations {
  TermLibrary library;
  Program program;                          ///< of the whole library
  std::vector<std::optional<Index>> exact;  ///< the state that is a state's rate, where known

  Index dimension() const noexcept { return static_cast<Index>(exact.size()); }
};

/// Terms with a coefficient in some equation.
std::vector<Index> present_terms(const Matrix& coefficients);

/// Right-hand sides at the nodes of a window, linearised about its path at coefficients h0:
/// J x + Theta h + offsets. Evaluates one window after the other.
class WindowRates {
 public:
  /// @param terms of Theta, increasing. The equations must outlive this.
  WindowRates(const CandidateEquations& equations, std::vector<Index> terms, const Matrix& h0);

  void evaluate(const PathRecord& record, const SampleWindow& window);

  const Matrix& theta() const noexcept { return values_.theta(); }  ///< terms x nodes
  const Matrix& jacobians() const noexcept { return jacobians_; }   ///< m m x nodes
  const Matrix& path() const noexcept { return path_; }             ///< m x nodes

  /// m x nodes: -J path, 0 for exact equations.
  const Matrix& offsets() const noexcept { return offsets_; }

 private:
  const CandidateEquations& equations_;
  const Matrix h0_;
  LibraryRates values_;
  Matrix jacobians_, path_, offsets_;
};

}  // namespace lacuna
