// SPDX-License-Identifier: MIT
// Regressors that fit the terms they are given, and the solvers inside of l1. Each function
// makes one from its options; `Registry` has the same by name.
#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "lacuna/core/base/options.hpp"
#include "lacuna/regression/stages/solvers.hpp"

namespace lacuna {

/// Options of ols(): none.
struct OlsOptions {
  static constexpr StageInfo kInfo{"ols", "Ordinary least squares.",
                                   "Karimov et al. 2023, eq. (7)"};

  void describe(OptionVisitor&) {}
};

/// Ordinary least squares, h = (E'E)^-1 E'y, (7) of Karimov et al. 2023, from the triangular
/// factor; for Effort::Final followed by one pass of iterative refinement over the rows.
Stage<Regressor> ols(const OlsOptions& options = {});

/// Options of ridge().
struct RidgeOptions {
  static constexpr StageInfo kInfo{"ridge", "Least squares with a penalty on large terms.",
                                   "Hoerl & Kennard, Technometrics 12 (1970) 55; Hoerl, "
                                   "Kennard & Baldwin, Commun. Statist. 4 (1975) 105"};

  std::optional<double> alpha = {};

  void describe(OptionVisitor& v) {
    v.field(
        {"alpha", "",
         "Penalty on the squared norms |h_j theta_j|^2 of the terms; from the residual when "
         "not given.",
         0.0},
        alpha);
  }
};

/// Ridge regression: minimises |y - Theta h|^2 + alpha sum_j |h_j theta_j|^2. The penalty is in
/// columns of unit norm, so that it does not depend on units. Shrinks every coefficient, most
/// where columns are alike, and removes none. Without an alpha it is that of Hoerl, Kennard &
/// Baldwin 1975, for the coefficients z_j = h_j |theta_j| of least squares on k terms and n
/// rows,
///
///   alpha = k s^2 / |z|^2,  s^2 = |y - Theta h|^2 / (n - k),
///
/// so that the bias stays below the scatter, however many the rows are and however small a
/// noise they have: of 4000 whitened rows a fixed one of 1e-6 hid the structure.
Stage<Regressor> ridge(const RidgeOptions& options = {});

/// Options of gls().
struct GlsOptions {
  static constexpr StageInfo kInfo{
      "gls", "Generalised least squares: residuals of neighbouring rows may be alike.",
      "Aitken, Proc. R. Soc. Edinburgh 55 (1935) 42; Cochrane & Orcutt, J. Am. Stat. Assoc. 44 "
      "(1949) 32; Prais & Winsten, Cowles Commission 383 (1954)"};

  int max_iterations = 50;

  void describe(OptionVisitor& v) {
    v.field({"max_iterations", "", "Most rounds.", 1.0, 1e6}, max_iterations);
  }
};

/// Generalised least squares with residuals of an autoregressive process of order 1:
///
///   min_h (y - Theta h)' V^-1 (y - Theta h),  V_ij = rho^|i-j|,
///
/// rho = sum_i r_i r_{i-1} / sum_i r_i^2 of the residuals r at the last h, beginning with least
/// squares, until rho no longer changes. Rows are whitened, e_i - rho e_{i-1}, the first by
/// sqrt(1 - rho^2); successive rows are taken for neighbours, ends of records included.
Stage<Regressor> gls(const GlsOptions& options = {});

/// Options of irls().
struct IrlsOptions {
  /// In which units delta is understood.
  enum class Tolerances {
    Relative,  ///< medians of |residual|: independent of units and of time scale
    Paper,     ///< units of the target, as published
  };

  static constexpr StageInfo kInfo{
      "irls", "Iteratively reweighted least squares: outliers count by size, not by square.",
      "Karimov et al. 2023, eq. (8)"};
  static constexpr std::array<std::string_view, 2> kTolerances{"relative", "paper"};

  Tolerances tolerances = Tolerances::Relative;
  std::optional<double> delta = {};
  double tolerance = 1e-8;
  int max_iterations = 100;

  /// delta, or the default of the chosen tolerances.
  double effective_delta() const {
    return delta.value_or(tolerances == Tolerances::Relative ? 1.0 : 1e-5);
  }

  void describe(OptionVisitor& v) {
    v.field({"tolerances", "",
             "'relative': delta in medians of |residual|; 'paper': in units of the target."},
            kTolerances, tolerances);
    v.field({"delta", "",
             "Residuals up to this have equal weight; 1 (relative) or 1e-5 (paper) when not "
             "given.",
             1e-300},
            delta);
    v.field(
        {"tolerance", "",
         "Ends when no term changes by more than this fraction of the largest.", 1e-15, 1.0},
        tolerance);
    v.field({"max_iterations", "", "Most passes over the rows.", 1.0, 1e6}, max_iterations);
  }
};

/// Iteratively reweighted least squares: minimises sum_i w_i (y_i - E_i h)^2 with the weights
/// (8) of Karimov et al. 2023, w_i = 1 / max(delta, |y_i - E_i h|), started at (7). Its limit
/// minimises the Huber function of the residuals with corner delta; the published delta is raw,
/// the default is one median of |residual|, so that half of the rows count as in least squares.
/// The paper gives no value for delta; 1e-5 is that of its other tolerances.
Stage<Regressor> irls(const IrlsOptions& options = {});

/// Options of ceres_l1().
struct CeresL1Options {
  static constexpr StageInfo kInfo{
      "ceres", "Levenberg-Marquardt of Ceres on smoothed penalties, ever less smooth.",
      "Agarwal, Mierle et al., Ceres Solver"};

  int max_iterations = 2000;

  void describe(OptionVisitor& v) {
    v.field({"max_iterations", "", "Most Levenberg-Marquardt steps.", 1.0, 1e6},
            max_iterations);
  }
};

/// Follows the minimum of the smooth convex problem
///   min_z |c - R z|^2 + sum_j p_j mu (sqrt(1 + z_j^2 / mu^2) - 1)
/// as mu falls from the size of the first guess to 1e-12 of it: the penalties are Ceres'
/// SoftLOneLoss, which tends to p_j |z_j|, and every minimum is the start of the next. After
/// each the optimum of the l1 problem is solved for exactly on the coefficients that are not
/// small, and taken where the optimality conditions confirm it.
Stage<L1Solver> ceres_l1(const CeresL1Options& options = {});

/// Options of coordinate_descent().
struct CoordinateDescentOptions {
  static constexpr StageInfo kInfo{"coordinate-descent",
                                   "Soft-thresholds one coefficient after the other.",
                                   "Friedman, Hastie & Tibshirani, J. Stat. Softw. 33 (2010)"};

  double tolerance = 1e-12;
  int max_sweeps = 1000;

  void describe(OptionVisitor& v) {
    v.field({"tolerance", "", "Ends when the optimality conditions hold to this.", 1e-15, 1.0},
            tolerance);
    v.field({"max_sweeps", "", "Most passes over the coefficients.", 1.0, 1e9}, max_sweeps);
  }
};

/// Cyclic coordinate descent in closed form,
///   z_j <- S(z_j G_jj + (R'(c - R z))_j, p_j / 2) / G_jj,  G = R'R, S the soft threshold,
/// ended by the optimality conditions (see l1_violation). A sweep decides which coefficients
/// come in; after each, those that are in go to their common minimum (see l1_face_minimum), so
/// that the number of sweeps does not grow with the condition of R.
Stage<L1Solver> coordinate_descent(const CoordinateDescentOptions& options = {});

/// Options of nlopt_l1().
struct NloptL1Options {
  static constexpr StageInfo kInfo{
      "nlopt", "Limited-memory BFGS of NLopt on the split form z = p - q.",
      "Johnson, The NLopt package; Nocedal, Math. Comput. 35 (1980) 773"};

  int max_evaluations = 5000;

  void describe(OptionVisitor& v) {
    v.field({"max_evaluations", "", "Most evaluations of the objective.", 1.0, 1e9},
            max_evaluations);
  }
};

/// Splits the coefficients into parts that cannot be negative,
///   min_{p,q >= 0} |c - R(p - q)|^2 + sum_j penalty_j (p_j + q_j),  z = p - q,
/// which is smooth with bounds, and gives it to NLopt (L-BFGS) in runs of 10 evaluations for
/// each coefficient. After each the nonzero coefficients go to their common minimum (see
/// l1_face_minimum), until the optimality conditions hold.
Stage<L1Solver> nlopt_l1(const NloptL1Options& options = {});

/// Options of irls_l1(); the inner solver has no default.
struct IrlsL1Options {
  /// In which units delta and alpha are understood.
  enum class Tolerances {
    Relative,  ///< independent of n, of units and of time scale
    Paper,     ///< raw, as published
  };

  static constexpr StageInfo kInfo{
      "irls-l1", "Iteratively reweighted least squares with an l1 penalty on the coefficients.",
      "Karimov et al. 2023, Sect. 2.1, eq. (8)"};
  static constexpr std::array<std::string_view, 2> kTolerances{"relative", "paper"};

  Stage<L1Solver> inner;
  double alpha = 1e-6;
  Tolerances tolerances = Tolerances::Relative;
  std::optional<double> delta = {};
  double tolerance = 1e-8;
  int max_iterations = 100;

  /// delta, or the default of the chosen tolerances.
  double effective_delta() const {
    return delta.value_or(tolerances == Tolerances::Relative ? 1.0 : 1e-5);
  }

  void describe(OptionVisitor& v) {
    v.field({"inner", "", "Solves the penalised problem for given weights."}, inner);
    v.field({"alpha", "",
             "Penalty; 'relative': as a fraction of the penalty that leaves no term.", 0.0},
            alpha);
    v.field(
        {"tolerances", "",
         "'relative': delta in medians of |residual|, alpha without unit; 'paper': both raw."},
        kTolerances, tolerances);
    v.field({"delta", "",
             "Residuals up to this have equal weight; 1 (relative) or 1e-5 (paper) when not "
             "given.",
             1e-300},
            delta);
    v.field(
        {"tolerance", "",
         "Ends when no term changes by more than this fraction of the largest.", 1e-15, 1.0},
        tolerance);
    v.field({"max_iterations", "", "Most passes over the rows.", 1.0, 1e6}, max_iterations);
  }
};

/// l1-regularised IRLS: minimises sum_i w_i (y_i - E_i h)^2 + alpha |h|_1 started at (7), with
/// weights (8) of Karimov et al. 2023 after each iteration; the inner problem goes to an
/// L1Solver in triangular form with columns scaled to unit norm, z_j = h_j |sqrt(W) e_j|.
///
/// Paper tolerances: alpha multiplies |h_j| as printed, so it depends on n, units and time
/// scale. Relative ones: |h_j| |e_j| has the penalty alpha * 2 max_j |e_j' W y| / |e_j| with
/// the weights W of the residuals y, which is the smallest that leaves no term for the present
/// delta: alpha = 1 leaves none, whatever n and the units are. For given delta the problem is
/// convex and every iteration lowers the objective. Terms whose coefficient is zero leave the
/// active set and are reported.
Stage<Regressor> irls_l1(const IrlsL1Options& options);

}  // namespace lacuna
