// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "lacuna/data/derivatives/differentiators.hpp"

namespace lacuna {

/// What kalman_smoother() makes.
class KalmanSmoother final : public Configured<Differentiator, KalmanSmootherOptions> {
 public:
  /// @throws ConfigError when lambda is given without the order.
  explicit KalmanSmoother(Options options = {});

 private:
  Matrix do_differentiate(const Vector& time, const Eigen::Ref<const Matrix>& values,
                          int order) const override;
  std::optional<Matrix> do_standard_error(const Vector& time,
                                          const Eigen::Ref<const Matrix>& values,
                                          int order) const override;
  Index do_margin() const override { return margin_; }
  Index do_fewest_samples() const override { return 5; }
  std::shared_ptr<const Differentiator> do_fit(
      const Dataset& data, const std::optional<Vector>& noise) const override;

  Index margin_ = 0;  ///< of the records to which lambda was fitted
};

}  // namespace lacuna
