// SPDX-License-Identifier: MIT
#include "lacuna/differentiators/finite_differences.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "lacuna/data/noise.hpp"
#include "lacuna/differentiators/stencil.hpp"

namespace lacuna {
namespace {

Matrix differences(const Vector& time, const Eigen::Ref<const Matrix>& values, int accuracy,
                   int order, Index margin = 0) {
  const StencilRule rule{std::string(FiniteDifferencesOptions::kInfo.name), order,
                         accuracy / 2 + (order - 1) / 2, accuracy + order,
                         [order](const Vector& nodes, double at) {
                           return interpolation_weights(nodes, at, order);
                         }};
  return apply_stencil(rule, time, values, margin);
}

/// First derivatives of one record by the orders that are asked for, without the samples at its
/// ends that the highest order sees from one side, and of a unit impulse in
/// its middle, whose square is that of the weights.
class OrderChoice {
 public:
  OrderChoice(const Trajectory& record, Vector noise, int highest)
      : time_(record.time),
        signals_(record.samples(), record.states.cols() + 1),
        noise_(std::move(noise)),
        highest_(highest),
        rates_(static_cast<std::size_t>(highest / 2)) {
    signals_ << record.states, Vector::Unit(record.samples(), record.samples() / 2);
  }

  /// The order of least error; the last one only tells the error of the one before. Higher
  /// orders amplify noise more: once noise alone is above the least error none of them is
  /// better.
  int best() {
    std::size_t best = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i + 1 < rates_.size(); ++i) {
      if (squared_error(i, false) > least) break;
      const double error = squared_error(i, true);
      if (!(error < least)) continue;
      least = error;
      best = i;
    }
    return 2 * static_cast<int>(best + 1);
  }

  /// T_p of every state.
  Vector truncation(int order) {
    const std::size_t i = static_cast<std::size_t>(order / 2 - 1);
    Vector errors(states());
    for (Index k = 0; k < states(); ++k) errors[k] = truncation(i, k);
    return errors;
  }

 private:
  Index states() const { return noise_.size(); }
  double rows() const { return static_cast<double>(signals_.rows() - highest_ / 2 * 2); }

  /// By order 2 (i + 1).
  const Matrix& rates(std::size_t i) {
    if (rates_[i].size() == 0)
      rates_[i] = differences(time_, signals_, 2 * static_cast<int>(i + 1), 1, highest_ / 2);
    return rates_[i];
  }

  double squared_error(std::size_t i, bool with_truncation) {
    const double own_gain = rates(i).col(states()).squaredNorm();
    double sum = 0.0;
    for (Index k = 0; k < states(); ++k) {
      const double rate = rates(i).col(k).squaredNorm() / rows();
      if (!(rate > 0.0)) continue;
      const double error = with_truncation ? truncation(i, k) : 0.0;
      sum += (error * error + own_gain * noise_[k] * noise_[k] / rows()) / rate;
    }
    return sum;
  }

  double truncation(std::size_t i, Index k) {
    const double change = difference(i, k);
    if (change == 0.0) return 0.0;
    return change / (1.0 - std::min(ratio(i, change, k), 0.9));
  }

  /// Of a difference and the one before it; of the first, that of the one behind it.
  double ratio(std::size_t i, double change, Index k) {
    if (i == 0) return rates_.size() > 2 ? difference(1, k) / change : 1.0;
    const double before = difference(i - 1, k);
    return before > 0.0 ? change / before : 1.0;
  }

  /// t_p: the rms of the next order's derivative minus this one's, without noise. The chance
  /// deviation of a mean square is sqrt(2/n) of it, times sqrt(highest) because neighbouring
  /// differences share samples.
  double difference(std::size_t i, Index k) {
    const double square = (rates(i + 1).col(k) - rates(i).col(k)).squaredNorm() / rows();
    const double gain = (rates(i + 1).col(states()) - rates(i).col(states())).squaredNorm();
    const double noise = gain * noise_[k] * noise_[k];
    const double chance = 1.96 * noise * std::sqrt(2.0 * highest_ / rows());
    return square > noise + chance ? std::sqrt(square - noise) : 0.0;
  }

  const Vector& time_;
  Matrix signals_;
  Vector noise_;
  int highest_;
  std::vector<Matrix> rates_;  ///< empty where not asked for yet
};

/// The middle of the longest record: so many samples tell mean squares to two per cent.
Dataset middle_of(const Dataset& data) {
  const Trajectory& record = longest_record(data);
  const Index count = std::min<Index>(record.samples(), 4096);
  const Index first = (record.samples() - count) / 2;
  Dataset part;
  part.states = data.states;
  part.trajectories.push_back({record.source,
                               record.time.segment(first, count),
                               record.states.middleRows(first, count),
                               Matrix(count, 0),
                               {}});
  return part;
}

/// At least a quarter of the record is to lie inside of the longest stencil's two ends.
int highest_order(const Dataset& part, int wanted) {
  const Index room = part.trajectories[0].samples() * 3 / 4;
  return static_cast<int>(std::min<Index>(room, wanted)) / 2 * 2;
}

/// What adding up `terms` rounded products leaves, per state.
Vector rounding_noise(const Trajectory& record, int terms) {
  const double unit = std::numeric_limits<double>::epsilon() * std::sqrt(1.0 * terms);
  return unit * record.states.cwiseAbs().colwise().maxCoeff().transpose();
}

OrderChoice choice_for(const Dataset& part, int highest) {
  const Trajectory& record = part.trajectories[0];
  return OrderChoice(record, estimate_noise(part).cwiseMax(rounding_noise(record, highest)),
                     highest);
}

}  // namespace

FiniteDifferences::FiniteDifferences(Options options) : Configured(options) {
  if (!options.order || *options.order % 2 == 0) return;
  throw ConfigError("finite-differences.order",
                    "the order " + std::to_string(*options.order) + " is odd",
                    "give an even number: central differences gain two orders at a time");
}

Matrix FiniteDifferences::do_differentiate(const Vector& time,
                                           const Eigen::Ref<const Matrix>& values,
                                           int order) const {
  if (order == 0) return values;
  if (options().order) return differences(time, values, *options().order, order);
  Dataset data;
  data.trajectories.push_back({"", time, values, Matrix(time.size(), 0), Matrix()});
  for (Index k = 0; k < values.cols(); ++k)
    data.states.push_back({"x" + std::to_string(k), ""});
  return do_fit(data)->differentiate(time, values, order);
}

std::shared_ptr<const Differentiator> FiniteDifferences::do_fit(const Dataset& data) const {
  if (options().order) return nullptr;
  const Dataset part = middle_of(data);
  const int highest = highest_order(part, kHighest + 2);
  if (highest < 4) return std::make_shared<const FiniteDifferences>(Options{.order = 2});
  OrderChoice choice = choice_for(part, highest);
  const int order = choice.best();
  auto fitted = std::make_shared<FiniteDifferences>(Options{.order = order});
  if (highest >= std::max(order + 2, 6)) fitted->truncation_ = choice.truncation(order);
  return fitted;
}

std::optional<Vector> FiniteDifferences::do_truncation_error(const Dataset& data) const {
  if (truncation_) return truncation_;
  if (!options().order) return do_fit(data)->truncation_error(data);
  const Dataset part = middle_of(data);
  const int next = std::max(*options().order + 2, 6);
  if (highest_order(part, next) < next) return std::nullopt;
  return choice_for(part, next).truncation(*options().order);
}

}  // namespace lacuna
