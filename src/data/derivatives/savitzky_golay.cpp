// SPDX-License-Identifier: MIT
#include "lacuna/data/derivatives/savitzky_golay.hpp"

#include "data/derivatives/stencil.hpp"

namespace lacuna {

SavitzkyGolay::SavitzkyGolay(Options options) : Configured(options) {
  if (options.window % 2 == 0)
    throw ConfigError("savitzky-golay.window",
                      "the window of " + std::to_string(options.window) + " samples is even",
                      "give an odd number, so that it has a middle");
  if (options.window <= options.degree)
    throw ConfigError("savitzky-golay.window",
                      "the window of " + std::to_string(options.window) +
                          " samples does not determine degree " +
                          std::to_string(options.degree),
                      "widen the window or lower the degree");
}

Matrix SavitzkyGolay::do_differentiate(const Vector& time,
                                       const Eigen::Ref<const Matrix>& values,
                                       int order) const {
  const int degree = options().degree;
  if (order > degree)
    throw ArgumentError("savitzky-golay.degree",
                        "a polynomial of degree " + std::to_string(degree) +
                            " has no derivative of order " + std::to_string(order),
                        "raise the degree to at least " + std::to_string(order));
  const StencilRule rule{std::string(info().name), order, options().window / 2,
                         options().window, [degree, order](const Vector& nodes, double at) {
                           return fit_weights(nodes, at, degree, order);
                         }};
  return apply_stencil(rule, time, values);
}

}  // namespace lacuna
