// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "trajectories/sensitivities/library_rates.hpp"
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
/// J x + Theta h + offsets. Evaluates one window after the other; what is compiled is kept as
/// long as the same terms are wanted.
class WindowRates {
 public:
  /// @param equations must outlive this.
  explicit WindowRates(const CandidateEquations& equations) : equations_(&equations) {}

  const CandidateEquations& equations() const noexcept { return *equations_; }

  /// To be called before windows are evaluated. @param terms of Theta, increasing.
  void choose(std::vector<Index> terms, const Matrix& h0);

  void evaluate(const PathRecord& record, const SampleWindow& window);

  const Matrix& theta() const noexcept { return values_->theta(); }  ///< terms x nodes
  const Matrix& jacobians() const noexcept { return jacobians_; }    ///< m m x nodes
  const Matrix& path() const noexcept { return path_; }              ///< m x nodes

  /// m x nodes: -J path, 0 for exact equations.
  const Matrix& offsets() const noexcept { return offsets_; }

 private:
  const CandidateEquations* equations_;
  Matrix h0_;
  std::optional<LibraryRates> values_;
  Matrix jacobians_, path_, offsets_;
};

}  // namespace lacuna
