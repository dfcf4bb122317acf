// SPDX-License-Identifier: MIT
#include "residual_test.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

#include "core/base/random.hpp"
#include "core/numerics/qr.hpp"

namespace lacuna {
namespace {

constexpr Index kTests = 7;
constexpr std::array<const char*, kTests> kNames = {
    "runs",   "neighbours", "correlation",       "trend",
    "blocks", "law",        "the same in records"};

constexpr Index kCosines = 6;      // offset and slow waves that count as a trend
constexpr Index kSlow = 4;         // those of the deviations that power is computed for
constexpr Index kMostLags = 20;    // as Ljung and Box's test of the residuals has
constexpr Index kLeastRows = 5;    // of a channel; fewer have no order
constexpr double kWork = 4e7;      // products of all draws, beyond which there are fewer
constexpr Index kLeastDraws = 199; // resolve 5 % to 1.5 %

/// One channel: its rows in the orders in which they are looked at.
struct ChannelRows {
  std::vector<std::vector<Index>> sequences;
  std::vector<Matrix> cosines;  // of each sequence: n x kCosines, columns of norm 1
  std::vector<Index> by_value;
  Index count = 0;
};

/// The slowest cosines over n samples, orthonormal columns.
Matrix cosines_of(Index n) {
  Matrix cosines = Matrix::Zero(n, kCosines);
  for (Index k = 0; k < std::min(kCosines, n); ++k)
    for (Index i = 0; i < n; ++i)
      cosines(i, k) = std::sqrt((k == 0 ? 1.0 : 2.0) / static_cast<double>(n)) *
                      std::cos(std::numbers::pi * static_cast<double>(k) *
                               (static_cast<double>(i) + 0.5) / static_cast<double>(n));
  return cosines;
}

std::vector<ChannelRows> channels_of(const FittedResiduals& fitted) {
  std::vector<ChannelRows> channels(static_cast<std::size_t>(fitted.channels));
  for (const ResidualSequence& sequence : fitted.sequences) {
    if (sequence.rows.empty()) continue;
    ChannelRows& channel = channels[static_cast<std::size_t>(sequence.channel)];
    channel.sequences.push_back(sequence.rows);
    channel.cosines.push_back(cosines_of(static_cast<Index>(sequence.rows.size())));
    channel.by_value.insert(channel.by_value.end(), sequence.rows.begin(), sequence.rows.end());
    channel.count += static_cast<Index>(sequence.rows.size());
  }
  for (ChannelRows& channel : channels)
    std::stable_sort(channel.by_value.begin(), channel.by_value.end(), [&](Index a, Index b) {
      return fitted.model[a] < fitted.model[b];
    });
  return channels;
}

/// Products of neighbours at a lag.
double products(const Vector& values, const std::vector<Index>& rows, std::size_t lag) {
  double sum = 0.0;
  for (std::size_t i = lag; i < rows.size(); ++i)
    sum += values[rows[i]] * values[rows[i - lag]];
  return sum;
}

/// Fewer changes of sign than chance makes: their number, negative.
double runs(const Vector& values, const ChannelRows& channel) {
  double changes = 0.0;
  for (const auto& rows : channel.sequences)
    for (std::size_t i = 1; i < rows.size(); ++i)
      changes += values[rows[i]] * values[rows[i - 1]] < 0.0 ? 1.0 : 0.0;
  return -changes;
}

double neighbours(const Vector& values, const ChannelRows& channel) {
  double sum = 0.0;
  for (const auto& rows : channel.sequences) sum += products(values, rows, 1);
  return sum;
}

double correlation(const Vector& values, const ChannelRows& channel) {
  const Index lags = std::clamp(channel.count / 5, Index{1}, kMostLags);
  double sum = 0.0;
  for (Index lag = 1; lag <= lags; ++lag) {
    double product = 0.0;
    for (const auto& rows : channel.sequences)
      product += products(values, rows, static_cast<std::size_t>(lag));
    sum += product * product / static_cast<double>(std::max(Index{1}, channel.count - lag));
  }
  return sum;
}

/// The most that the first of the slow cosines have together, beyond what noise has.
double trend(const Vector& values, const ChannelRows& channel) {
  Vector energy = Vector::Zero(kCosines);
  for (std::size_t s = 0; s < channel.sequences.size(); ++s)
    energy += (channel.cosines[s].transpose() * values(channel.sequences[s])).cwiseAbs2();
  const auto sequences = static_cast<double>(channel.sequences.size());
  double sum = 0.0, most = -1e300;
  for (Index k = 0; k < kCosines; ++k) {
    sum += energy[k] - sequences;
    most = std::max(most, sum / std::sqrt(2.0 * sequences * static_cast<double>(k + 1)));
  }
  return most;
}

/// The largest sum of squares of sums over blocks, beyond what noise has.
double blocks(const Vector& values, const ChannelRows& channel) {
  std::size_t longest = 0;
  for (const auto& rows : channel.sequences) longest = std::max(longest, rows.size());
  double most = -1e300;
  for (std::size_t length = 2; 2 * length <= longest; length *= 2) {
    double squares = 0.0, count = 0.0;
    for (const auto& rows : channel.sequences)
      for (std::size_t first = 0; first + length <= rows.size(); first += length) {
        double sum = 0.0;
        for (std::size_t i = first; i < first + length; ++i) sum += values[rows[i]];
        squares += sum * sum / static_cast<double>(length);
        ++count;
      }
    if (count > 0.0) most = std::max(most, (squares - count) / std::sqrt(2.0 * count));
  }
  return most;
}

/// Squares of sums over the records at the same sample.
double in_common(const Vector& values, const ChannelRows& channel) {
  if (channel.sequences.size() < 2) return 0.0;
  std::vector<double> sums;
  for (const auto& rows : channel.sequences) {
    sums.resize(std::max(sums.size(), rows.size()), 0.0);
    for (std::size_t i = 0; i < rows.size(); ++i) sums[i] += values[rows[i]];
  }
  return std::inner_product(sums.begin(), sums.end(), sums.begin(), 0.0);
}

/// All tests of all channels, larger where there is more structure; scaled so that the size of
/// the noise does not matter.
Vector statistics(Vector values, const std::vector<ChannelRows>& channels) {
  Vector all = Vector::Zero(kTests * static_cast<Index>(channels.size()));
  for (std::size_t c = 0; c < channels.size(); ++c) {
    const ChannelRows& channel = channels[c];
    const double power = values(channel.by_value).squaredNorm();
    if (channel.count < kLeastRows || !(power > 0.0)) continue;
    values(channel.by_value) *= std::sqrt(static_cast<double>(channel.count) / power);
    all.segment(static_cast<Index>(c) * kTests, kTests) =
        Vector{{runs(values, channel), neighbours(values, channel),
                correlation(values, channel), trend(values, channel), blocks(values, channel),
                products(values, channel.by_value, 1), in_common(values, channel)}};
  }
  return all;
}

/// The distribution of all tests where a model is right.
struct NullDraws {
  std::vector<std::vector<double>> sorted;  // of each test, rising
  std::vector<double> least;                // least probability of each draw, rising

  /// Probability of a value as large as this one, itself among the draws.
  double chance(Index test, double value) const {
    const auto& all = sorted[static_cast<std::size_t>(test)];
    const auto smaller = std::lower_bound(all.begin(), all.end(), value) - all.begin();
    const auto count = static_cast<double>(all.size());
    return (count - static_cast<double>(smaller) + 1.0) / (count + 1.0);
  }

  /// Probability of a least probability as small as this one.
  double together(double probability) const {
    const auto below = std::upper_bound(least.begin(), least.end(), probability * 1.0000001) -
                       least.begin();
    return (static_cast<double>(below) + 1.0) / (static_cast<double>(least.size()) + 1.0);
  }
};

Vector white_noise(Index n, Random& random) {
  Vector noise(n);
  for (double& value : noise) value = random.normal();
  return noise;
}

/// Noise without structure, of which the fit has taken its directions.
class NoiseDraws {
 public:
  NoiseDraws(const FittedResiduals& fitted, const FittedDirections& directions)
      : directions_(directions), sizes_(fitted.residual.cwiseAbs()) {
    constexpr double kLeastLeft = 0.05;  // of a value that the fit meets nearly by itself
    const Vector left = (1.0 - directions.leverage().array()).cwiseMax(kLeastLeft);
    sizes_ = sizes_.cwiseQuotient(left.cwiseSqrt()).eval();
  }

  Vector draw(Random& random) const {
    Vector noise = sizes_;
    for (double& value : noise)
      if (random.uniform() < 0.5) value = -value;
    directions_.remove(noise);
    return noise;
  }

 private:
  const FittedDirections& directions_;
  Vector sizes_;
};

NullDraws null_draws(const NoiseDraws& noise, const std::vector<ChannelRows>& channels,
                     Index count, Random& random) {
  Matrix draws(count, kTests * static_cast<Index>(channels.size()));
  for (Index b = 0; b < count; ++b)
    draws.row(b) = statistics(noise.draw(random), channels).transpose();
  NullDraws null;
  for (Index j = 0; j < draws.cols(); ++j) {
    null.sorted.emplace_back(draws.col(j).begin(), draws.col(j).end());
    std::sort(null.sorted.back().begin(), null.sorted.back().end());
  }
  for (Index b = 0; b < count; ++b) {
    double least = 1.0;
    for (Index j = 0; j < draws.cols(); ++j)
      least = std::min(least, null.chance(j, draws(b, j)));
    null.least.push_back(least);
  }
  std::sort(null.least.begin(), null.least.end());
  return null;
}

/// Slow waves in each channel with what the fit leaves of them as large as its residuals.
Vector slow_deviation(const FittedResiduals& fitted, const std::vector<ChannelRows>& channels,
                      const FittedDirections& directions, Random& random) {
  Vector deviation = Vector::Zero(fitted.residual.size());
  for (const ChannelRows& channel : channels)
    for (std::size_t s = 0; s < channel.sequences.size(); ++s)
      deviation(channel.sequences[s]) =
          channel.cosines[s].leftCols(kSlow) * white_noise(kSlow, random);
  const Vector whole = deviation;
  directions.remove(deviation);
  for (const ChannelRows& channel : channels) {
    constexpr double kVanishing = 1e-6;
    const double left = deviation(channel.by_value).norm();
    const double scale = left > kVanishing * whole(channel.by_value).norm()
                             ? fitted.residual(channel.by_value).norm() / left
                             : 0.0;
    deviation(channel.by_value) *= scale;
  }
  return deviation;
}

double least_chance(const NullDraws& null, const Vector& values, Index channel) {
  double least = 1.0;
  for (Index j = channel * kTests; j < (channel + 1) * kTests; ++j)
    least = std::min(least, null.chance(j, values[j]));
  return least;
}

}  // namespace

FittedDirections::FittedDirections(const Matrix& rows, std::vector<Index> begins, Index own)
    : begins_(std::move(begins)) {
  Matrix common = rows.rightCols(rows.cols() - own);
  for (std::size_t r = 0; r + 1 < begins_.size(); ++r) {
    const Index first = begins_[r], count = begins_[r + 1] - first;
    own_.push_back(orthonormal_basis(rows.block(first, 0, count, own)));
    auto part = common.middleRows(first, count);
    part -= (own_.back() * (own_.back().transpose() * part)).eval();
  }
  // The residual of a column that the own ones have is rounding.
  constexpr double kRounding = 1e-9;
  std::vector<Index> kept;
  for (Index j = 0; j < common.cols(); ++j)
    if (common.col(j).norm() > kRounding * rows.col(own + j).norm()) kept.push_back(j);
  common_ = orthonormal_basis(Matrix(common(Eigen::all, kept)));
}

void FittedDirections::remove(Vector& values) const {
  for (std::size_t r = 0; r + 1 < begins_.size(); ++r) {
    auto part = values.segment(begins_[r], begins_[r + 1] - begins_[r]);
    part -= (own_[r] * (own_[r].transpose() * part)).eval();
  }
  values -= (common_ * (common_.transpose() * values)).eval();
}

Vector FittedDirections::leverage() const {
  Vector all = common_.rowwise().squaredNorm();
  for (std::size_t r = 0; r + 1 < begins_.size(); ++r)
    all.segment(begins_[r], begins_[r + 1] - begins_[r]) += own_[r].rowwise().squaredNorm();
  return all;
}

Index FittedDirections::rank() const {
  Index rank = common_.cols();
  for (const Matrix& own : own_) rank += own.cols();
  return rank;
}

std::vector<ChannelStructure> test_structure(const FittedResiduals& fitted,
                                             const FittedDirections& directions,
                                             const StructureTestOptions& options) {
  std::vector<ChannelStructure> found(static_cast<std::size_t>(fitted.channels));
  const Index n = fitted.residual.size();
  if (n - directions.rank() < 2 || !(fitted.residual.squaredNorm() > 0.0)) return found;
  const std::vector<ChannelRows> channels = channels_of(fitted);
  const double each = static_cast<double>(n) * static_cast<double>(directions.rank() + 50);
  const Index count = std::clamp(static_cast<Index>(kWork / each), kLeastDraws, options.draws);
  Random random(options.seed);
  const NoiseDraws noise(fitted, directions);
  const NullDraws null = null_draws(noise, channels, count, random);
  const Vector observed = statistics(fitted.residual, channels);
  for (Index c = 0; c < fitted.channels; ++c) {
    ChannelStructure& channel = found[static_cast<std::size_t>(c)];
    const double least = least_chance(null, observed, c);
    channel.chance = null.together(least);
    for (Index j = kTests - 1; j >= 0; --j)
      if (null.chance(c * kTests + j, observed[c * kTests + j]) <= least)
        channel.sign = kNames[static_cast<std::size_t>(j)];
  }
  const Index tries = std::min<Index>(kLeastDraws, count);
  for (Index b = 0; b < tries; ++b) {
    const Vector values = statistics(
        noise.draw(random) + slow_deviation(fitted, channels, directions, random), channels);
    for (Index c = 0; c < fitted.channels; ++c)
      if (null.together(least_chance(null, values, c)) < options.level)
        found[static_cast<std::size_t>(c)].power += 1.0 / static_cast<double>(tries);
  }
  return found;
}

}  // namespace lacuna
