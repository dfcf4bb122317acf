// SPDX-License-Identifier: MIT
#include "lacuna/data/records/noise.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "core/base/parallel.hpp"
#include "core/numerics/column_kernels.hpp"
#include "core/statistics/robust_statistics.hpp"
#include "data/records/check_record.hpp"
#include "data/records/lattice.hpp"
#include "data/records/state_statistics.hpp"
#include "lacuna/data/records/marks.hpp"

namespace lacuna {
namespace {

// Facts: weights of higher orders lose their digits, more values make no better median.
constexpr Index kHighestOrder = 14;
constexpr std::size_t kSamplesOfMedian = std::size_t{1} << 16U;
/// Fewer differences than this say nothing about a median.
constexpr std::size_t kFewest = 8;

/// One state in one record: its differences of rising order, each of unit noise gain.
class Differences {
 public:
  Differences(const Trajectory& trajectory, Index state)
      : time_(trajectory.time),
        values_(trajectory.states.col(state)),
        uniform_(uniform_step(trajectory).has_value()),
        count_(values_.size()) {
    const double scale = values_.size() > 0 ? values_.cwiseAbs().maxCoeff() : 0.0;
    if (scale > 0.0) values_ /= scale;
    scale_ = scale;
  }

  /// Goes on to the next order k and adds every `stride`-th |w' x| / |w| to the list.
  void advance(Index order, Index stride, std::vector<double>& sizes) {
    count_ = std::max<Index>(count_ - 1, 0);
    if (uniform_) {
      // C(2k, k) = C(2k - 2, k - 1) (4 - 2 / k)
      gain_ *= std::sqrt(4.0 - 2.0 / static_cast<double>(order));
      difference(values_.data(), count_);
    }
    const auto old = static_cast<Index>(sizes.size());
    const Index more = (count_ + stride - 1) / stride;
    sizes.resize(static_cast<std::size_t>(old + more));
    Eigen::Map<Vector> added(sizes.data() + old, more);
    if (uniform_)
      added = values_(Eigen::seqN(0, more, stride)).cwiseAbs() * (scale_ / gain_);
    else
      for (Index i = 0; i < more; ++i) added[i] = scale_ * std::abs(divided(i * stride, order));
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
  Vector values_;  ///< where steps are even: the differences of the present order
  bool uniform_;
  double scale_ = 0.0;
  double gain_ = 1.0;
  Index count_;  ///< of the differences
};

/// Orders after the one at which the estimates level off that count: the rest of the signal
/// goes on falling; much later ones only scatter more.
constexpr std::size_t kSettling = 3;

/// First estimate that the next one does not fall below noticeably; size() when all fall.
std::size_t first_level(const std::vector<double>& sigmas) {
  for (std::size_t k = 0; k + 1 < sigmas.size(); ++k)
    if (sigmas[k + 1] >= kLevelledOff * sigmas[k]) return k;
  return sigmas.size();
}

/// Noise estimated by the differences of order 1, 2, ..., as far as the level needs them.
std::vector<double> noise_by_order(const Dataset& data, Index state) {
  std::vector<Differences> records;
  for (const Trajectory& trajectory : data.trajectories)
    records.emplace_back(trajectory, state);
  const auto samples = static_cast<std::size_t>(data.samples());
  const auto stride = static_cast<Index>(1 + samples / kSamplesOfMedian);
  std::vector<double> sigmas, sizes;
  for (Index order = 1; order <= kHighestOrder; ++order) {
    sizes.clear();
    for (Differences& record : records) record.advance(order, stride, sizes);
    if (sizes.size() < kFewest) break;
    sigmas.push_back(normal_deviation(std::move(sizes)));
    if (first_level(sigmas) + 1 + kSettling < sigmas.size()) break;
  }
  return sigmas;
}

/// Value at which the estimates level off; nothing when they fall to the end.
std::optional<double> plateau(const std::vector<double>& sigmas) {
  const std::size_t first = first_level(sigmas);
  if (first == sigmas.size()) return std::nullopt;
  const std::size_t last = std::min(first + 1 + kSettling, sigmas.size() - 1);
  return *std::min_element(sigmas.begin() + static_cast<std::ptrdiff_t>(first),
                           sigmas.begin() + static_cast<std::ptrdiff_t>(last) + 1);
}

double least(const std::vector<double>& values) {
  return values.empty() ? 0.0 : *std::min_element(values.begin(), values.end());
}

/// The dataset with every `stride`-th sample.
Dataset thinned(const Dataset& data, Index state, Index stride) {
  Dataset result;
  result.states = {data.states[static_cast<std::size_t>(state)]};
  for (const Trajectory& record : data.trajectories) {
    const Index n = (record.samples() + stride - 1) / stride;
    Trajectory part;
    part.time = record.time(Eigen::seqN(0, n, stride));
    part.states = record.states.col(state)(Eigen::seqN(0, n, stride));
    result.trajectories.push_back(std::move(part));
  }
  return result;
}

/// Noise estimated by every second sample, where it is certainly more than every sample sees:
/// the scatter of a median of n values is about 1.2 / sqrt(n) of it, and differences of one
/// order more or less move a plateau by a tenth.
std::optional<double> coloured_level(const Dataset& data, Index state, double sigma) {
  const double margin =
      1.2 + 5.0 / std::sqrt(static_cast<double>(std::max<Index>(data.samples(), 1)));
  const std::optional<double> second = plateau(noise_by_order(thinned(data, state, 2), 0));
  if (!second || *second < margin * sigma) return std::nullopt;
  return second;
}

StateNoise analyse_state(const Dataset& data, Index state) {
  StateNoise noise;
  const std::vector<double> sigmas = noise_by_order(data, state);
  const std::optional<double> level = plateau(sigmas);
  noise.white = level.value_or(0.0);
  noise.sigma = level.value_or(least(sigmas));
  noise.kind = level && *level > 0.0 ? NoiseKind::White : NoiseKind::None;
  if (level) noise.order = static_cast<Index>(first_level(sigmas)) + 1;
  noise.lattice = lattice_of(data, state);
  const double rounding = noise.lattice.value_or(0.0) / std::sqrt(12.0);
  if (rounding > 0.0 && noise.sigma <= 1.5 * rounding) {
    noise.sigma = std::max(noise.sigma, rounding);
    noise.kind = NoiseKind::Quantised;
  } else if (noise.kind == NoiseKind::White) {
    if (const auto coloured = coloured_level(data, state, noise.sigma)) {
      noise.sigma = *coloured;
      noise.kind = NoiseKind::Coloured;
    }
  }
  std::size_t outliers = 0;
  for (const Trajectory& record : data.trajectories)
    outliers += outlying_samples(record, state, noise.sigma).size();
  noise.outliers =
      static_cast<double>(outliers) / static_cast<double>(std::max<Index>(data.samples(), 1));
  return noise;
}

/// One state by those of its samples that are values; records of fewer than two are left out.
Dataset values_only(const Dataset& data, Index state) {
  Dataset result;
  result.states = {data.states[static_cast<std::size_t>(state)]};
  for (const Trajectory& record : data.trajectories) {
    Trajectory values = values_of(record, state);
    if (values.samples() >= 2) result.trajectories.push_back(std::move(values));
  }
  return result;
}

StateNoise analyse(const Dataset& data, Index state) {
  return has_marks(data) ? analyse_state(values_only(data, state), 0)
                         : analyse_state(data, state);
}

/// x_i minus the straight line between its neighbours; 0 at the ends.
Vector bends(const Trajectory& record, Index state) {
  const Vector& t = record.time;
  const auto x = record.states.col(state);
  Vector bend = Vector::Zero(record.samples());
  for (Index i = 1; i + 1 < record.samples(); ++i) {
    const double fraction = (t[i] - t[i - 1]) / (t[i + 1] - t[i - 1]);
    bend[i] = x[i] - (1.0 - fraction) * x[i - 1] - fraction * x[i + 1];
  }
  return bend;
}

/// Each value without the median of those at most three samples away.
Vector without_local_median(const Vector& values) {
  // A fact of the statistic: a spike bends three of seven samples, the fewer.
  constexpr Index kReach = 3;
  Vector result = values;
  for (Index i = 0; i < values.size(); ++i) {
    const Index first = std::max<Index>(0, i - kReach);
    const Index last = std::min(values.size() - 1, i + kReach);
    std::vector<double> around(values.begin() + first, values.begin() + last + 1);
    result[i] -= upper_median(std::move(around));
  }
  return result;
}

}  // namespace

std::string to_string(NoiseKind kind) {
  switch (kind) {
    case NoiseKind::White:
      return "white";
    case NoiseKind::Coloured:
      return "coloured";
    case NoiseKind::Quantised:
      return "quantised";
    default:
      return "none";
  }
}

Vector difference_sizes(const Trajectory& record, Index state, Index order) {
  check_state(record, state, "difference_sizes");
  if (order >= record.samples()) return Vector(0);
  Differences differences(record, state);
  std::vector<double> sizes;
  for (Index k = 1; k <= order; ++k) {
    sizes.clear();
    differences.advance(k, 1, sizes);
  }
  return Eigen::Map<const Vector>(sizes.data(), static_cast<Index>(sizes.size()));
}

std::vector<Index> outlying_samples(const Trajectory& record, Index state, double sigma,
                                    double deviations) {
  if (!(sigma > 0.0)) sigma = std::numeric_limits<double>::min();
  return outlying_samples(record, state, Vector::Constant(record.samples(), sigma).eval(),
                          deviations);
}

std::vector<Index> outlying_samples(const Trajectory& record, Index state, const Vector& sigma,
                                    double deviations) {
  check_state(record, state, "outlying_samples");
  check_argument(sigma.size() == record.samples(), "outlying_samples",
                 "there is not one sigma for each sample");
  std::vector<Index> outliers;
  if (record.samples() < static_cast<Index>(kFewest)) return outliers;
  const Vector deviation =
      without_local_median(bends(record, state)).cwiseAbs().cwiseQuotient(sigma);
  std::vector<double> sizes(deviation.begin(), deviation.end());
  const double limit =
      deviations * std::max(std::sqrt(1.5), normal_deviation(std::move(sizes)));
  for (Index i = 1; i + 1 < deviation.size(); ++i)
    if (deviation[i] > limit && deviation[i] >= deviation[i - 1] &&
        deviation[i] >= deviation[i + 1])
      outliers.push_back(i);
  return outliers;
}

std::vector<StateNoise> analyse_noise(const Dataset& data, int threads) {
  check_states(data, "analyse_noise");
  std::vector<StateNoise> noise(static_cast<std::size_t>(data.state_count()));
  parallel_for(noise.size(), threads,
               [&](std::size_t k) { noise[k] = analyse(data, static_cast<Index>(k)); });
  return noise;
}

StateNoise analyse_noise_of(const Dataset& data, Index state) {
  check_states(data, "analyse_noise_of");
  check_number(state, data.state_count(), "analyse_noise_of", "state");
  return analyse(data, state);
}

Vector estimate_noise(const Dataset& data, int threads) {
  check_states(data, "estimate_noise");
  Vector noise(data.state_count());
  parallel_for(static_cast<std::size_t>(noise.size()), threads, [&](std::size_t k) {
    const auto state = static_cast<Index>(k);
    noise[state] = plateau(has_marks(data) ? noise_by_order(values_only(data, state), 0)
                                           : noise_by_order(data, state))
                       .value_or(0.0);
  });
  return noise;
}

}  // namespace lacuna
