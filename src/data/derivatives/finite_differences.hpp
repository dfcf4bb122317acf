// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "lacuna/data/derivatives/differentiators.hpp"

namespace lacuna {

/// What finite_differences() makes.
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
