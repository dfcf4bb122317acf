// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "lacuna/core/base/options.hpp"
#include "lacuna/data/derivatives/differentiator.hpp"
#include "lacuna/data/derivatives/penalty_choice.hpp"

namespace lacuna {

/// Options of SmoothingSpline.
struct SmoothingSplineOptions {
  static constexpr StageInfo kInfo{
      "smoothing-spline", "Derivatives of a spline that follows the samples and bends little",
      "F. O'Sullivan, Stat. Sci. 1 (1986) 502-518; G. Wahba, Spline Models for Observational "
      "Data, SIAM 1990"};

  int order = 3;
  PenaltyChoice choice = PenaltyChoice::Gcv;
  std::optional<double> lambda = {};

  void describe(OptionVisitor& v) {
    describe_penalty(v, "m: the m-th derivative is penalised.", "time^(2m-1)", *this);
  }
};

/// The spline f of degree 2m-1 with least
///
///   sum_i (y_i - f(t_i))^2 + lambda integral (f^(m))^2 dt
///
/// over knots at equal spacing, as many as samples, on any grid; over gaps it goes on with the
/// least penalty. Polynomials below degree m have no penalty. B-splines make the normal equations
/// banded; they are solved by sparse Cholesky. One lambda for all states and records: unequal
/// filters bias equations between states. Chosen between 1e-6 and 1e11 times h^(2m-1) of the mean
/// step h (beyond, rounding decides): features may have about 2 pi 1e11^(1/2m) samples, 430 for
/// m = 3; thin out records that are sampled more densely.
///
/// The standard error is that of the Bayesian model (Wahba 1983), sigma sqrt(b'A^-1 b), with
/// sigma^2 = RSS / (n - tr S).
class SmoothingSpline final : public Configured<Differentiator, SmoothingSplineOptions> {
 public:
  using Configured::Configured;

 private:
  Matrix do_differentiate(const Vector& time, const Eigen::Ref<const Matrix>& values,
                          int order) const override;
  std::optional<Matrix> do_standard_error(const Vector& time,
                                          const Eigen::Ref<const Matrix>& values,
                                          int order) const override;
  Index do_margin() const override { return margin_; }
  Index do_fewest_samples() const override { return options().order + 2; }
  std::shared_ptr<const Differentiator> do_fit(
      const Dataset& data, const std::optional<Vector>& noise) const override;

  Index margin_ = 0;  ///< of the records to which lambda was fitted
};

}  // namespace lacuna
