// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "lacuna/core/base/options.hpp"
#include "lacuna/data/derivatives/differentiator.hpp"

namespace lacuna {

/// Options of FiniteDifferences.
struct FiniteDifferencesOptions {
  static constexpr StageInfo kInfo{
      "finite-differences",
      "Differences of any even order of accuracy on uniform and other grids; no smoothing",
      "B. Fornberg, Math. Comp. 51 (1988) 699-706"};

  std::optional<int> order = {};  ///< of accuracy, even; without it, chosen from the record

  void describe(OptionVisitor& v) {
    v.field(
        {"order", "",
         "Order of accuracy p: the error falls as step^p; even. Chosen from the record when "
         "not given.",
         2.0, 20.0},
        order);
  }
};

/// The k-th derivative by the polynomial through the nearest samples.
///
///   x^(k)(t_i) = sum_j w_j x(t_j) + O(h^p)
///
/// Inside a uniform grid the stencil is central, with p/2 + (k-1)/2 (rounded down) samples to
/// either side; near the ends and on other grids it takes the p + k samples nearest in number,
/// of the same order of accuracy. k = 0 gives the values. Needs p + k samples.
///
/// Without an order, p is chosen from 2, 4, .., 20 for the longest record such that
///
///   sum_k (T_pk^2 + g_p^2 s_k^2 / n) / rms(D_p x_k)^2
///
/// is least; g_p^2 is the sum of the squared weights, s_k the noise (estimate_noise(), and
/// no less than rounding leaves). Noise is counted with 1/n because a fit to n samples averages
/// it, while truncation is the same everywhere in state space and passes into the coefficients.
///
/// The truncation error T_p comes from t_p, the rms of D_{p+2} x - D_p x without what noise
/// contributes to it (0 where no more is left than chance leaves in one of 40 cases): what is
/// still to come is the geometric series T_p = t_p / (1 - t_p / t_{p-2}), the ratio at most
/// 0.9 (that of t_4 and t_2 for p = 2).
class FiniteDifferences final : public Configured<Differentiator, FiniteDifferencesOptions> {
 public:
  /// @throws ConfigError when the order is odd or out of range.
  explicit FiniteDifferences(Options options = {});

 private:
  Matrix do_differentiate(const Vector& time, const Eigen::Ref<const Matrix>& values,
                          int order) const override;
  Index do_margin() const override { return options().order.value_or(kHighest) / 2; }
  Index do_fewest_samples() const override { return options().order.value_or(2) + 1; }
  std::shared_ptr<const Differentiator> do_fit(
      const Dataset& data, const std::optional<Vector>& noise) const override;
  std::optional<Vector> do_truncation_error(const Dataset& data) const override;

  static constexpr int kHighest = 20;
  std::optional<Vector> truncation_;  ///< of the records to which the order was fitted
};

}  // namespace lacuna
