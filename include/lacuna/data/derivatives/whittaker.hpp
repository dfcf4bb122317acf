// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <optional>

#include "lacuna/core/base/options.hpp"
#include "lacuna/data/derivatives/differentiator.hpp"
#include "lacuna/data/derivatives/penalty_choice.hpp"

namespace lacuna {

/// Options of Whittaker.
struct WhittakerOptions {
  static constexpr StageInfo kInfo{
      "whittaker", "Samples smoothed by a penalty on their differences (Whittaker-Henderson)",
      "E. T. Whittaker, Proc. Edinb. Math. Soc. 41 (1923) 63-75; P. H. C. Eilers, Anal. Chem. "
      "75 (2003) 3631-3636"};

  int order = 3;
  PenaltyChoice choice = PenaltyChoice::Gcv;
  std::optional<double> lambda = {};

  void describe(OptionVisitor& v) {
    describe_penalty(v, "d: divided differences of order d are penalised.", "time^(2d-1)", *this);
  }
};

/// The samples z with least
///
///   sum_i (y_i - z_i)^2 + lambda h sum_i (D^d z)_i^2,
///
/// D^d z the d-th derivative of the polynomial through d + 1 neighbours and h the mean step, by
/// sparse Cholesky; derivatives are differences of fourth order of z. Polynomials below degree d
/// have no penalty. One lambda for all states and records, chosen within the range of
/// SmoothingSpline. The standard error is given of z itself (order 0).
class Whittaker final : public Configured<Differentiator, WhittakerOptions> {
 public:
  using Configured::Configured;

 private:
  Matrix do_differentiate(const Vector& time, const Eigen::Ref<const Matrix>& values,
                          int order) const override;
  std::optional<Matrix> do_standard_error(const Vector& time,
                                          const Eigen::Ref<const Matrix>& values,
                                          int order) const override;
  Index do_margin() const override { return margin_; }
  Index do_fewest_samples() const override { return std::max(options().order + 2, 5); }
  std::shared_ptr<const Differentiator> do_fit(
      const Dataset& data, const std::optional<Vector>& noise) const override;

  Index margin_ = 0;  ///< of the records to which lambda was fitted
};

}  // namespace lacuna
