// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "trajectories/sensitivities/rates.hpp"
#include "trajectories/sensitivities/stage_signals.hpp"

namespace lacuna {

/// Exact derivatives of single steps of the integrator, for blocks of consecutive steps:
/// x_{n+1} = F(x_n, p) has dx_{n+1} = Phi_n dx_n + Gamma_n dp.
///
/// By the adjoint of the Runge-Kutta step: Lambda_a = dx_{n+1}/df_a is m x m and comes
/// backwards from the last stage, Lambda_a = h (b_a + sum_{d>a} a_da Lambda_d J_d); then Phi =
/// 1 + sum_a Lambda_a J_a and Gamma = sum_a Lambda_a df_a/dp, so that a column costs s m
/// operations a step. They are the variational equations, integrated by the same method.
class StepMaps {
 public:
  static constexpr Index kBlock = 32;  ///< steps done at a time

  StepMaps(Rates& rates, const StepScheme& scheme);

  /// Steps first .. first + count - 1, count at most kBlock.
  /// @param states where f was evaluated: per stage steps x m.
  void evaluate(Rates& rates, const StageSignals& signals, const std::vector<Matrix>& states,
                Index first, Index count);

  /// Phi of each step: row i, column j * m + k holds the entry (k, j).
  const Matrix& transitions() const noexcept { return transitions_; }

  /// Gamma of each step: row i, column c * m + k holds the entry (k, c).
  const Matrix& responses() const noexcept { return responses_; }

 private:
  void evaluate_rates(Rates& rates, const StageSignals& signals,
                      const std::vector<Matrix>& states, Index first, Index count);
  void adjoint(Index stage, const Eigen::Ref<const Vector>& lengths,
               const std::vector<MatrixPlace>& places);
  void respond(Index stage, Index count, const std::vector<MatrixPlace>& places);

  const ButcherTableau& tableau_;
  Index dimension_, columns_;
  Matrix slots_, jacobian_, partials_;     // stage after stage
  std::vector<Matrix> influence_, moved_;  // Lambda_a and Lambda_a J_a, block x m^2
  Matrix transitions_, responses_;
};

}  // namespace lacuna
