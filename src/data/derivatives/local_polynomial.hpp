// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "lacuna/data/derivatives/differentiators.hpp"

namespace lacuna {

/// What local_polynomial() makes.
class LocalPolynomial final : public Configured<Differentiator, LocalPolynomialOptions> {
 public:
  using Configured::Configured;

 private:
  Matrix do_differentiate(const Vector& time, const Eigen::Ref<const Matrix>& values,
                          int order) const override;
  std::optional<Matrix> do_standard_error(const Vector& time,
                                          const Eigen::Ref<const Matrix>& values,
                                          int order) const override;
  Index do_fewest_samples() const override { return options().degree + 2; }
};

}  // namespace lacuna
