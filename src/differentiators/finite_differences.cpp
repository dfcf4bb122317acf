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
                   int order) {
  const StencilRule rule{std::string(FiniteDifferencesOptions::kInfo.name), order,
                         accuracy / 2 + (order - 1) / 2, accuracy + order,
                         [order](const Vector& nodes, double at) {
                           return interpolation_weights(nodes, at, order);
                         }};
  return apply_stencil(rule, time, values);
}

/// Rows of a matrix that differences of order `highest` see from both sides.
auto inside(const Matrix& values, int highest) {
  const Index margin = highest / 2;
  return values.middleRows(margin, values.rows() - 2 * margin);
}

/// First derivatives of one record by every order, and of a unit impulse in its middle, whose
/// square is that of the weights.
class OrderChoice {
 public:
  OrderChoice(const Trajectory& record, Vector noise, int highest)
      : noise_(std::move(noise)), highest_(highest) {
    const Index n = record.samples();
    Matrix signals(n, record.states.cols() + 1);
    signals << record.states, Vector::Unit(n, n / 2);
    for (int p = 2; p <= highest; p += 2)
      rates_.push_back(inside(differences(record.time, signals, p, 1), highest));
  }

  /// The order of least error; the last one only tells the error of the one before.
  int best() const {
    std::vector<double> errors;
    for (std::size_t i = 0; i + 1 < rates_.size(); ++i) errors.push_back(squared_error(i));
    const auto least = std::min_element(errors.begin(), errors.end());
    return 2 * static_cast<int>(least - errors.begin() + 1);
  }

  /// T_p of every state.
  Vector truncation(int order) const {
    const std::size_t i = static_cast<std::size_t>(order / 2 - 1);
    Vector errors(states());
    for (Index k = 0; k < states(); ++k) errors[k] = truncation(i, k);
    return errors;
  }

 private:
  Index states() const { return noise_.size(); }
  double rows() const { return static_cast<double>(rates_[0].rows()); }

  double squared_error(std::size_t i) const {
    const double own_gain = rates_[i].col(states()).squaredNorm();
    double sum = 0.0;
    for (Index k = 0; k < states(); ++k) {
      const double rate = rates_[i].col(k).squaredNorm() / rows();
      if (!(rate > 0.0)) continue;
      const double error = truncation(i, k);
      sum += (error * error + own_gain * noise_[k] * noise_[k] / rows()) / rate;
    }
    return sum;
  }

  double truncation(std::size_t i, Index k) const {
    const double change = difference(i, k);
    if (change == 0.0) return 0.0;
    return change / (1.0 - std::min(ratio(i, change, k), 0.9));
  }

  /// Of a difference and the one before it; of the first, that of the one behind it.
  double ratio(std::size_t i, double change, Index k) const {
    if (i == 0) return rates_.size() > 2 ? difference(1, k) / change : 1.0;
    const double before = difference(i - 1, k);
    return before > 0.0 ? change / before : 1.0;
  }

  /// t_p: the rms of the next order's derivative minus this one's, without noise. The chance
  /// deviation of a mean square is sqrt(2/n) of it, times sqrt(highest) because neighbouring
  /// differences share samples.
  double difference(std::size_t i, Index k) const {
    const double square = (rates_[i + 1].col(k) - rates_[i].col(k)).squaredNorm() / rows();
    const double gain = (rates_[i + 1].col(states()) - rates_[i].col(states())).squaredNorm();
    const double noise = gain * noise_[k] * noise_[k];
    const double chance = 1.96 * noise * std::sqrt(2.0 * highest_ / rows());
    return square > noise + chance ? std::sqrt(square - noise) : 0.0;
  }

  Vector noise_;
  int highest_;
  std::vector<Matrix> rates_;
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
  const int order = highest < 4 ? 2 : choice_for(part, highest).best();
  return std::make_shared<const FiniteDifferences>(Options{.order = order});
}

std::optional<Vector> FiniteDifferences::do_truncation_error(const Dataset& data) const {
  if (!options().order) return do_fit(data)->truncation_error(data);
  const Dataset part = middle_of(data);
  const int next = std::max(*options().order + 2, 6);
  if (highest_order(part, next) < next) return std::nullopt;
  return choice_for(part, next).truncation(*options().order);
}

}  // namespace lacuna
