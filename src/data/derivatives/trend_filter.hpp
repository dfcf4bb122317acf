// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <optional>

#include "lacuna/data/derivatives/differentiators.hpp"

namespace lacuna {

/// What trend_filter() makes.
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
