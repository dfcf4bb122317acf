// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <optional>

#include "lacuna/core/base/options.hpp"
#include "lacuna/data/derivatives/differentiator.hpp"

namespace lacuna {

/// Options of TrendFilter.
struct TrendFilterOptions {
  static constexpr StageInfo kInfo{
      "trend-filter", "Samples smoothed by pieces of polynomials with few knots (total variation)",
      "S.-J. Kim, K. Koh, S. Boyd, D. Gorinevsky, SIAM Review 51 (2009) 339-360; R. Chartrand, "
      "ISRN Appl. Math. (2011) 164564"};

  int order = 3;
  std::optional<double> lambda = {};

  void describe(OptionVisitor& v) {
    v.field({"order", "",
             "d: pieces of degree d - 1; 2 is the total variation of the rate.", 2.0, 4.0},
            order);
    v.field({"lambda", "time^(d-1)",
             "Weight of the penalty in units of the noise; chosen when not given.", 1e-300},
            lambda);
  }
};

/// The samples z with least
///
///   sum_i (y_i - z_i)^2 + lambda sigma h sum_i |(D^d z)_i|,
///
/// sigma the noise of the state (estimate_noise()), h the mean step, D^d z as in Whittaker. Where
/// a signal is smooth but for some instants, a sum of absolute values leaves the instants as they
/// are, where a sum of squares rounds them off. Derivatives are differences of fourth order of z.
/// One lambda for all states and records, by Mallows' C_p (see choose_trend()). Samples without
/// noise stay as they are. It knows no standard error.
class TrendFilter final : public Configured<Differentiator, TrendFilterOptions> {
 public:
  using Configured::Configured;

 private:
  Matrix do_differentiate(const Vector& time, const Eigen::Ref<const Matrix>& values,
                          int order) const override;
  Index do_margin() const override { return margin_; }
  Index do_fewest_samples() const override { return std::max(options().order + 2, 5); }
  std::shared_ptr<const Differentiator> do_fit(
      const Dataset& data, const std::optional<Vector>& noise) const override;

  Index margin_ = 0;  ///< of the records to which lambda was fitted
  Vector noise_;      ///< of their states; empty: that of the values
};

}  // namespace lacuna
