// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/core/options.hpp"
#include "lacuna/stages/differentiator.hpp"

namespace lacuna {

/// Options of FiniteDifferences.
struct FiniteDifferencesOptions {
  static constexpr StageInfo kInfo{
      "finite-differences",
      "Differences of any even order of accuracy on uniform and other grids; no smoothing",
      "B. Fornberg, Math. Comp. 51 (1988) 699-706"};

  int order = 4;  ///< of accuracy, even

  void describe(OptionVisitor& v) {
    v.field({"order", "", "Order of accuracy p: the error falls as step^p; even.", 2.0, 20.0},
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
class FiniteDifferences final : public Configured<Differentiator, FiniteDifferencesOptions> {
 public:
  /// @throws ConfigError when the order is odd or out of range.
  explicit FiniteDifferences(Options options = {});

 private:
  Matrix do_differentiate(const Vector& time, const Eigen::Ref<const Matrix>& values,
                          int order) const override;
};

}  // namespace lacuna
