// SPDX-License-Identifier: MIT
#include "data/derivatives/finite_differences.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "data/derivatives/excerpt.hpp"
#include "data/derivatives/stencil.hpp"
#include "lacuna/core/statistics/interval.hpp"
#include "lacuna/data/records/noise.hpp"

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

/// First derivatives of one record by rising orders, without the samples at its ends that the
/// highest order sees from one side; of the states, and of a unit impulse in the middle, of
/// which the square is that of the weights.
class RisingOrders {
 public:
  RisingOrders(const Trajectory& record, int highest)
      : time_(record.time),
        step_(common_step(record.time)),
        margin_(highest / 2),
        signals_(record.samples(), record.states.cols() + 1) {
    signals_ << record.states, Vector::Unit(record.samples(), record.samples() / 2);
    rates_ = step_ ? next_term() : by_stencil();
  }

  const Matrix& rates() const { return rates_; }

  /// Goes on to the next order. @return by how much the rates change.
  Matrix advance() {
    order_ += 2;
    Matrix change = step_ ? next_term() : Matrix(by_stencil() - rates_);
    rates_ += change;
    return change;
  }

 private:
  Matrix by_stencil() const { return differences(time_, signals_, order_, 1, margin_); }

  /// On a uniform grid h dx/dt = sum_i c_i mu delta^(2i+1) x with c_i = -i / (4i + 2) c_(i-1).
  Matrix next_term() {
    const Index i = order_ / 2 - 1;
    const Index rows = i == 0 ? signals_.rows() - 2 : term_.rows() - 2;
    if (i == 0)
      term_ = (signals_.bottomRows(rows) - signals_.topRows(rows)) / (2.0 * *step_);
    else
      term_ = ((term_.bottomRows(rows) - term_.middleRows(1, rows)) -
               (term_.middleRows(1, rows) - term_.topRows(rows)))
                  .eval();
    if (i > 0) factor_ *= -static_cast<double>(i) / static_cast<double>(4 * i + 2);
    return factor_ * term_.middleRows(margin_ - i - 1, signals_.rows() - 2 * margin_);
  }

  const Vector& time_;
  std::optional<double> step_;
  Index margin_;
  Matrix signals_;
  int order_ = 2;
  Matrix term_;          ///< mu delta^(2i+1) x / h
  double factor_ = 1.0;  ///< c_i
  Matrix rates_;
};

/// The order of least error, for white noise of known deviation.
class OrderChoice {
 public:
  OrderChoice(const Trajectory& record, Vector noise, int highest)
      : orders_(record, highest),
        noise_(std::move(noise)),
        highest_(highest),
        rows_(static_cast<double>(orders_.rates().rows())) {}

  /// The order of least error; the last one only estimates the error of the one before. Higher
  /// orders amplify noise more: once noise alone is above the least error none of them is
  /// better.
  int best() {
    std::size_t best = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i + 1 < count(); ++i) {
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
  /// Sums of squares over the rows, one per signal.
  struct Level {
    Vector rates;    ///< by order 2 (i + 1)
    Vector changes;  ///< from there to the next order
  };

  Index states() const { return noise_.size(); }
  std::size_t count() const { return static_cast<std::size_t>(highest_ / 2); }

  const Level& level(std::size_t i) {
    while (levels_.size() <= i) {
      levels_.push_back({orders_.rates().colwise().squaredNorm(), {}});
      levels_.back().changes = orders_.advance().colwise().squaredNorm();
    }
    return levels_[i];
  }

  double squared_error(std::size_t i, bool with_truncation) {
    const Vector rates = level(i).rates;
    double sum = 0.0;
    for (Index k = 0; k < states(); ++k) {
      if (!(rates[k] > 0.0)) continue;
      const double error = with_truncation ? truncation(i, k) : 0.0;
      sum += (error * error * rows_ + rates[states()] * noise_[k] * noise_[k]) / rates[k];
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
    if (i == 0) return count() > 2 ? difference(1, k) / change : 1.0;
    const double before = difference(i - 1, k);
    return before > 0.0 ? change / before : 1.0;
  }

  /// t_p: the rms of the next order's derivative minus this one's, without noise. The chance
  /// deviation of a mean square is sqrt(2/n) of it, times sqrt(highest) because neighbouring
  /// differences share samples.
  double difference(std::size_t i, Index k) {
    const Vector& changes = level(i).changes;
    const double square = changes[k] / rows_;
    const double noise = changes[states()] * noise_[k] * noise_[k];
    const double chance = kNormalQuantile975 * noise * std::sqrt(2.0 * highest_ / rows_);
    return square > noise + chance ? std::sqrt(square - noise) : 0.0;
  }

  RisingOrders orders_;
  Vector noise_;
  int highest_;
  double rows_;
  std::vector<Level> levels_;  ///< those that were asked for
};

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

OrderChoice choice_for(const Dataset& part, const Vector& noise, int highest) {
  const Trajectory& record = part.trajectories[0];
  return OrderChoice(record, noise.cwiseMax(rounding_noise(record, highest)), highest);
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
  return do_fit(dataset_of(time, values), std::nullopt)->differentiate(time, values, order);
}

std::shared_ptr<const Differentiator> FiniteDifferences::do_fit(
    const Dataset& data, const std::optional<Vector>& noise) const {
  if (options().order) return nullptr;
  const Dataset part = middle_of(data);
  const int highest = highest_order(part, kHighest + 2);
  if (highest < 4) return std::make_shared<const FiniteDifferences>(Options{.order = 2});
  OrderChoice choice = choice_for(part, noise ? *noise : estimate_noise(part), highest);
  const int order = choice.best();
  auto fitted = std::make_shared<FiniteDifferences>(Options{.order = order});
  if (highest >= std::max(order + 2, 6)) fitted->truncation_ = choice.truncation(order);
  return fitted;
}

std::optional<Vector> FiniteDifferences::do_truncation_error(const Dataset& data) const {
  if (truncation_) return truncation_;
  if (!options().order) return do_fit(data, std::nullopt)->truncation_error(data);
  const Dataset part = middle_of(data);
  const int next = std::max(*options().order + 2, 6);
  if (highest_order(part, next) < next) return std::nullopt;
  return choice_for(part, estimate_noise(part), next).truncation(*options().order);
}

Stage<Differentiator> finite_differences(const FiniteDifferencesOptions& options) {
  return FiniteDifferences(options);
}

}  // namespace lacuna
