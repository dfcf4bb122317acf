// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "lacuna/data/derivatives/differentiators.hpp"

namespace lacuna {

/// What spectral() makes.
class Spectral final : public Configured<Differentiator, SpectralOptions> {
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
