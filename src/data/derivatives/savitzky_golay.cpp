// SPDX-License-Identifier: MIT
#include "data/derivatives/savitzky_golay.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "data/derivatives/excerpt.hpp"
#include "data/derivatives/stencil.hpp"

namespace lacuna {
namespace {

StencilRule window_rule(std::string_view name, int window, int degree, int order) {
  return {std::string(name), order, window / 2, window,
          [degree, order](const Vector& nodes, double at) {
            return fit_weights(nodes, at, degree, order);
          }};
}

/// Odd windows from the least that smooths, by a quarter, to the longest.
std::vector<int> odd_windows(int degree, Index longest) {
  std::vector<int> windows;
  for (Index w = (degree + 2) | 1; w <= longest; w += 2 * std::max<Index>(1, w / 8))
    windows.push_back(static_cast<int>(w));
  return windows;
}

/// log RSS - 2 log(1 - w_0), summed over the states, of the rows behind the margin.
double window_score(const Trajectory& record, const StencilRule& rule, Index margin) {
  const Index rows = record.samples() - 2 * margin;
  const Matrix rest =
      record.states.middleRows(margin, rows) -
      apply_stencil(rule, record.time, record.states).middleRows(margin, rows);
  const Index first = record.samples() / 2 - rule.radius;
  const Vector nodes =
      record.time.segment(first, rule.width).array() - record.time[first + rule.radius];
  const double own = rule.weights(nodes, 0.0)[rule.radius];
  constexpr double kUnit = std::numeric_limits<double>::epsilon();
  const Vector rounding = kUnit * kUnit * record.states.colwise().squaredNorm().transpose();
  const Vector squares = rest.colwise().squaredNorm().transpose() + rounding;
  return (squares.array() + std::numeric_limits<double>::min()).log().sum() -
         2.0 * static_cast<double>(squares.size()) * std::log(1.0 - own);
}

}  // namespace

SavitzkyGolay::SavitzkyGolay(Options options) : Configured(options) {
  if (!options.window) return;
  if (*options.window % 2 == 0)
    throw ConfigError("savitzky-golay.window",
                      "the window of " + std::to_string(*options.window) + " samples is even",
                      "give an odd number, so that it has a middle");
  if (*options.window <= options.degree)
    throw ConfigError("savitzky-golay.window",
                      "the window of " + std::to_string(*options.window) +
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
  if (options().window)
    return apply_stencil(window_rule(info().name, *options().window, degree, order), time,
                         values);
  check_samples(info().name, time.size(), do_fewest_samples());
  return do_fit(dataset_of(time, values), std::nullopt)->differentiate(time, values, order);
}

std::shared_ptr<const Differentiator> SavitzkyGolay::do_fit(
    const Dataset& data, const std::optional<Vector>&) const {
  if (options().window) return nullptr;
  // A decision: longer windows than this cost more than they smooth.
  constexpr Index kLongest = 1001;
  const Dataset part = middle_of(data);
  const Trajectory& record = part.trajectories[0];
  check_samples(info().name, record.samples(), do_fewest_samples());
  const std::vector<int> windows =
      odd_windows(options().degree, std::min(record.samples() / 2, kLongest));
  Options fitted = options();
  const int narrowest = (options().degree + 2) | 1;
  fitted.window = std::min<int>(narrowest, static_cast<int>(record.samples() - 1) | 1);
  double least = std::numeric_limits<double>::infinity();
  for (const int window : windows) {
    const double score = window_score(
        record, window_rule(info().name, window, options().degree, 0), windows.back() / 2);
    if (!(score < least)) continue;
    least = score;
    fitted.window = window;
  }
  return std::make_shared<SavitzkyGolay>(fitted);
}

Stage<Differentiator> savitzky_golay(const SavitzkyGolayOptions& options) {
  return SavitzkyGolay(options);
}

}  // namespace lacuna
