// SPDX-License-Identifier: MIT
// Numbers that are not finite make numbers that are not finite.
#pragma once

#include "lacuna/core/base/options.hpp"
#include "lacuna/regression/stages/regressor.hpp"

namespace lacuna {

/// Options of ElasticNet.
struct ElasticNetOptions {
  static constexpr StageInfo kInfo{
      "elastic-net",
      "Path of l1 and l2 penalties; least squares on the best set of terms on it.",
      "Zou & Hastie, J. R. Statist. Soc. B 67 (2005) 301; Friedman, Hastie & Tibshirani 2010; "
      "Meinshausen, Comput. Stat. Data Anal. 52 (2007) 374; Zou, J. Am. Stat. Assoc. 101 (2006) "
      "1418"};

  double mix = 0.9;
  double adaptivity = 0.0;
  int points = 60;
  double range = 1e-6;
  double penalty = 1.0;

  void describe(OptionVisitor& v) {
    v.field({"mix", "", "Fraction of the l1 penalty; 1 is the lasso.", 1e-3, 1.0}, mix);
    v.field({"adaptivity", "",
             "gamma: the l1 penalty of a term is divided by the power gamma of its part of the "
             "least-squares fit; 1 is the adaptive lasso, 0 the same for all.",
             0.0, 10.0},
            adaptivity);
    v.field({"points", "", "Penalties on the path, equally far apart in their logarithm.", 2.0,
             1e5},
            points);
    v.field({"range", "", "Smallest penalty, as a fraction of the one that leaves no term.",
             1e-15, 0.99},
            range);
    v.field({"penalty", "", "Penalty for a term in the score, in log n; 1 is that of the BIC.",
             0.0},
            penalty);
  }
};

/// The penalties of an elastic net.
struct ElasticPenalty {
  Vector l1;        ///< k, of each coefficient
  double l2 = 0.0;  ///< of all
};

/// argmin_z |c - R z|^2 + sum_j l1_j |z_j| + l2 / 2 sum_j z_j^2 by coordinate descent from
/// `start`.
/// @param triangle R, k x k; @param target c, k.
/// @throws ArgumentError when sizes differ, a number is not finite or a penalty is negative.
Vector elastic_net(const Matrix& triangle, const Vector& target,
                   const ElasticPenalty& penalty, Vector start, const RunContext& context = {});

/// The elastic net, relaxed: the path of
///
///   min_z |c - R z|^2 / |y|^2 + lambda (mix sum_j v_j |z_j| + (1 - mix) / 2 |z|_2^2),
///
/// columns of unit norm, v_j = (max |z_ls| / |z_ls_j|)^gamma with the least squares z_ls, from
/// the smallest lambda that leaves no term down by `range` gives sets of terms; the one with the
/// least score of SubsetScore (BIC) after least squares is taken, with the coefficients of least
/// squares.
class ElasticNet final : public Configured<Regressor, ElasticNetOptions> {
 public:
  using Configured::Configured;

 private:
  Regression do_fit(const LeastSquaresSystem& system, const Subproblem& problem, Effort effort,
                    const RunContext& context) const override;
};

}  // namespace lacuna
