// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/core/base/options.hpp"
#include "lacuna/data/derivatives/differentiator.hpp"

namespace lacuna {

/// Options of AutomaticDifferentiator.
struct AutomaticDifferentiatorOptions {
  static constexpr StageInfo kInfo{
      "auto", "The differentiator with the least error predicted for the records",
      "B. Efron, R. J. Tibshirani, An Introduction to the Bootstrap, 1993, ch. 6"};

  int draws = 3;

  void describe(OptionVisitor& v) {
    v.field({"draws", "", "Noisy copies on which the error of each differentiator is measured.",
             1.0, 1000.0},
            draws);
  }
};

/// Chooses among the differentiators by a parametric bootstrap. Pilots are smoothed records with
/// known derivatives: the three of SmoothingSpline, KalmanSmoother, Spectral and TrendFilter
/// with the least estimated error of the signal,
///
///   |y - signal|^2 / noise^2 - n + 2 trace(d signal / d y)
///
/// (C. Stein, Annals of Statistics 9 (1981), the trace by random changes of y: S. Ramani,
/// T. Blu, M. Unser, IEEE Transactions on Image Processing 17 (2008), eq. (13)). Each gets white
/// noise of the size that is estimated in the record, and every differentiator, fitted anew, is
/// measured by
///
///   sum over pilots and states of log mean (rate - rate of the pilot)^2
///
/// over `draws` copies, of the middle of the longest record (1024 samples at most). The seed is
/// fixed. A record whose noise cannot be distinguished from its signal gets finite differences.
class AutomaticDifferentiator final
    : public Configured<Differentiator, AutomaticDifferentiatorOptions> {
 public:
  using Configured::Configured;

 private:
  Matrix do_differentiate(const Vector& time, const Eigen::Ref<const Matrix>& values,
                          int order) const override;
  std::optional<Matrix> do_standard_error(const Vector& time,
                                          const Eigen::Ref<const Matrix>& values,
                                          int order) const override;
  Index do_fewest_samples() const override { return 5; }
  std::shared_ptr<const Differentiator> do_fit(
      const Dataset& data, const std::optional<Vector>& noise) const override;
};

}  // namespace lacuna
