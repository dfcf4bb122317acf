// SPDX-License-Identifier: MIT
#include "lacuna/data/noise.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

namespace lacuna {
namespace {

constexpr Index kHighestOrder = 14;
constexpr std::size_t kSamplesOfMedian = std::size_t{1} << 16U;
/// Fewer differences than this say nothing about a median.
constexpr std::size_t kFewest = 8;

/// Median absolute value of a standard normal variable.
constexpr double kNormalMedian = 0.674489750196082;

double median(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// One state in one record: its differences of rising order, each of unit noise gain.
class Differences {
 public:
  Differences(const Trajectory& trajectory, Index state)
      : time_(trajectory.time),
        values_(trajectory.states.col(state)),
        uniform_(uniform_step(trajectory).has_value()) {
    const double scale = values_.size() > 0 ? values_.cwiseAbs().maxCoeff() : 0.0;
    if (scale > 0.0) values_ /= scale;
    scale_ = scale;
    differences_ = values_;
  }

  /// Goes on to the next order k and adds every `stride`-th |w' x| / |w| to the list.
  void advance(Index order, Index stride, std::vector<double>& sizes) {
    if (differences_.size() < 2) return differences_.resize(0);
    const Index count = differences_.size() - 1;
    if (uniform_) {
      // C(2k, k) = C(2k - 2, k - 1) (4 - 2 / k)
      gain_ *= std::sqrt(4.0 - 2.0 / static_cast<double>(order));
      differences_ = (differences_.tail(count) - differences_.head(count)).eval();
    } else {
      differences_.conservativeResize(count);
    }
    for (Index i = 0; i < count; i += stride)
      sizes.push_back(scale_ *
                      std::abs(uniform_ ? differences_[i] / gain_ : divided(i, order)));
  }

 private:
  /// Divided difference of samples i .. i + order with weights of norm 1.
  double divided(Index i, Index order) const {
    const double span = (time_[i + order] - time_[i]) / 4.0;  // keeps the products near 1
    double sum = 0.0, squares = 0.0;
    for (Index j = i; j <= i + order; ++j) {
      double product = 1.0;
      for (Index k = i; k <= i + order; ++k)
        if (k != j) product *= (time_[j] - time_[k]) / span;
      sum += values_[j] / product;
      squares += 1.0 / (product * product);
    }
    return sum / std::sqrt(squares);
  }

  const Vector& time_;
  Vector values_;
  bool uniform_;
  double scale_ = 0.0;
  double gain_ = 1.0;
  Vector differences_;
};

/// Noise seen by the differences of order 1, 2, ...
std::vector<double> noise_by_order(const Dataset& data, Index state) {
  std::vector<Differences> records;
  for (const Trajectory& trajectory : data.trajectories)
    records.emplace_back(trajectory, state);
  const auto samples = static_cast<std::size_t>(data.samples());
  const auto stride = static_cast<Index>(1 + samples / kSamplesOfMedian);
  std::vector<double> sigmas;
  for (Index order = 1; order <= kHighestOrder; ++order) {
    std::vector<double> sizes;
    for (Differences& record : records) record.advance(order, stride, sizes);
    if (sizes.size() < kFewest) break;
    sigmas.push_back(median(sizes) / kNormalMedian);
  }
  return sigmas;
}

/// Value at which the estimates level off; nothing when they fall to the end.
std::optional<double> plateau(const std::vector<double>& sigmas) {
  constexpr double kLevel = 0.93;
  constexpr std::size_t kSettling = 3;
  for (std::size_t k = 0; k + 1 < sigmas.size(); ++k) {
    if (sigmas[k + 1] < kLevel * sigmas[k]) continue;
    // What is left of the signal goes on falling; much later orders only scatter more.
    const std::size_t last = std::min(k + 1 + kSettling, sigmas.size() - 1);
    return *std::min_element(sigmas.begin() + static_cast<std::ptrdiff_t>(k),
                             sigmas.begin() + static_cast<std::ptrdiff_t>(last) + 1);
  }
  return std::nullopt;
}

}  // namespace

Vector estimate_noise(const Dataset& data) {
  Vector noise = Vector::Zero(data.state_count());
  for (Index state = 0; state < data.state_count(); ++state)
    noise[state] = plateau(noise_by_order(data, state)).value_or(0.0);
  return noise;
}

}  // namespace lacuna
