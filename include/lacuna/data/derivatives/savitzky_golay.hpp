// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "lacuna/core/base/options.hpp"
#include "lacuna/data/derivatives/differentiator.hpp"

namespace lacuna {

/// Options of SavitzkyGolay.
struct SavitzkyGolayOptions {
  static constexpr StageInfo kInfo{
      "savitzky-golay", "Derivatives of a polynomial fitted to the samples in a moving window",
      "A. Savitzky, M. J. E. Golay, Anal. Chem. 36 (1964) 1627-1639"};

  std::optional<int> window = {};  ///< samples, odd; without it, chosen from the record
  int degree = 4;                  ///< of the polynomial, below window

  void describe(OptionVisitor& v) {
    v.field({"window", "samples",
             "Length of the moving window; odd. Chosen from the record when not given.", 3.0,
             100001.0},
            window);
    v.field({"degree", "", "Degree of the polynomial; below the window.", 1.0, 20.0}, degree);
  }
};

/// Smoothing differentiator: at each sample the k-th derivative of the polynomial of degree d
/// that fits the `window` samples around it best; k = 0 smooths.
///
/// The first and last (window-1)/2 samples take the derivative, off centre, of the first and
/// the last window's polynomial. On a grid that is not uniform each sample has a fit of its own
/// in time scaled to the window. Needs `window` samples.
///
/// Without a window, that of degree + 2, and on by a quarter, to half the record (1001 samples at
/// most) is taken which has the least generalised cross-validation of the samples that all of
/// them see from both sides,
///
///   sum over states of log RSS - 2 log(1 - w_0),   w_0 the weight of a sample for itself,
///
/// one for all states and records.
class SavitzkyGolay final : public Configured<Differentiator, SavitzkyGolayOptions> {
 public:
  /// @throws ConfigError when the window is even or not longer than the degree.
  explicit SavitzkyGolay(Options options = {});

 private:
  Matrix do_differentiate(const Vector& time, const Eigen::Ref<const Matrix>& values,
                          int order) const override;
  Index do_fewest_samples() const override {
    return options().window.value_or(options().degree + 2);
  }
  Index do_margin() const override { return options().window.value_or(0) / 2; }
  std::shared_ptr<const Differentiator> do_fit(
      const Dataset& data, const std::optional<Vector>& noise) const override;
};

}  // namespace lacuna
