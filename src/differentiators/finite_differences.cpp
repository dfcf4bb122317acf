// SPDX-License-Identifier: MIT
#include "lacuna/differentiators/finite_differences.hpp"

#include "lacuna/differentiators/stencil.hpp"

namespace lacuna {

FiniteDifferences::FiniteDifferences(Options options) : Configured(options) {
  if (options.order % 2 == 0) return;
  throw ConfigError("finite-differences.order",
                    "the order " + std::to_string(options.order) + " is odd",
                    "give an even number: central differences gain two orders at a time");
}

Matrix FiniteDifferences::do_differentiate(const Vector& time,
                                           const Eigen::Ref<const Matrix>& values,
                                           int order) const {
  if (order == 0) return values;
  const Index accuracy = options().order;
  const StencilRule rule{std::string(info().name), order, accuracy / 2 + (order - 1) / 2,
                         accuracy + order, [order](const Vector& nodes, double at) {
                           return interpolation_weights(nodes, at, order);
                         }};
  return apply_stencil(rule, time, values);
}

}  // namespace lacuna
