// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/solvers/selection.hpp"

namespace lacuna {

/// The penalties of an elastic net.
struct ElasticPenalty {
  Vector l1;        ///< k, of each coefficient
  double l2 = 0.0;  ///< of all
};

/// argmin_z |c - R z|^2 + sum_j l1_j |z_j| + l2 / 2 sum_j z_j^2 by coordinate descent from
/// `start`.
/// @param triangle R, k x k; @param target c, k.
/// @throws ArgumentError when sizes differ, a number is not finite or a penalty is negative.
Vector elastic_net_minimum(const Matrix& triangle, const Vector& target,
                           const ElasticPenalty& penalty, Vector start,
                           const RunContext& context = {});

/// What elastic_net() makes.
class ElasticNet final : public Configured<Regressor, ElasticNetOptions> {
 public:
  using Configured::Configured;

 private:
  Regression do_fit(const LeastSquaresSystem& system, const Subproblem& problem, Effort effort,
                    const RunContext& context) const override;
};

}  // namespace lacuna
