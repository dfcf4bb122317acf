// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "lacuna/data/derivatives/differentiators.hpp"

namespace lacuna {

/// What savitzky_golay() makes.
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
