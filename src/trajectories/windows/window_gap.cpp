// SPDX-License-Identifier: MIT
#include "trajectories/windows/window_gap.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/check.hpp"
#include "lacuna/core/numerics/interval.hpp"
#include "lacuna/data/records/marks.hpp"
#include "lacuna/trajectories/smoother/innovation_filter.hpp"

namespace lacuna {
namespace {

/// Samples between upward crossings of the mean, on average; the whole record when there are
/// fewer than two.
double mean_period(const Eigen::Ref<const Vector>& values) {
  const double mean = values.mean();
  Index first = -1, last = -1, crossings = 0;
  for (Index i = 1; i < values.size(); ++i) {
    if (!(values[i - 1] < mean && values[i] >= mean)) continue;
    if (first < 0) first = i;
    last = i;
    ++crossings;
  }
  if (crossings < 2) return static_cast<double>(values.size());
  return static_cast<double>(last - first) / static_cast<double>(crossings - 1);
}

// A window has no fewer samples, so that the fitted initial state takes up little.
constexpr Index kShortest = 20;

/// Square of what a sample is off, and whether it counts.
struct Off {
  double square = 0.0;
  bool counts = false;
};

Off off_by(double left, Mark mark) {
  if (!says_something(mark)) return {};
  const bool beyond =
      (mark == Mark::AtTop && left < 0.0) || (mark == Mark::AtBottom && left > 0.0);
  return {beyond ? 0.0 : left * left, true};
}

/// Squares of what samples are off, and 1 for each that counts.
struct OffSquares {
  Matrix squares, counts;  ///< n x m
};

/// Sums over blocks of rows of no fewer than `shortest`.
WindowSquares in_blocks(const OffSquares& off, Index shortest) {
  WindowSquares squares;
  const Index rows = off.counts.rows(), blocks = std::max<Index>(1, rows / shortest);
  for (Index b = 0; b < blocks; ++b) {
    const Index first = b * rows / blocks, count = (b + 1) * rows / blocks - first;
    const double sum = off.squares.middleRows(first, count).sum();
    const double samples = off.counts.middleRows(first, count).sum();
    if (!(samples > 0.0)) continue;
    squares.sum += sum;
    squares.count += samples;
    squares.blocks.push_back(sum / samples);
  }
  return squares;
}

/// One window, its initial state being fitted.
WindowSquares one_window(const LinearisedRecord& window, const MarkedSamples& measured,
                         const NoiseModel& exact, const Vector& scale) {
  const SmoothedRecord smoothed = smooth(window, measured.values, measured.marks, exact);
  OffSquares all{Matrix::Zero(measured.values.rows(), window.states()), {}};
  all.counts = all.squares;
  for (Index k = 0; k < window.states(); ++k) {
    if (!exact.measurement[static_cast<std::size_t>(k)] || scale[k] == 0.0) continue;
    const Vector left =
        (measured.values.col(k) - window.path.col(k) - smoothed.deviation.col(k)) / scale[k];
    for (Index i = 0; i < left.size(); ++i) {
      const Off off = off_by(left[i], mark_of(measured.marks, i, k));
      all.squares(i, k) = off.square;
      all.counts(i, k) = off.counts ? 1.0 : 0.0;
    }
  }
  return in_blocks(all, kShortest);
}

Matrix rows_of(const Matrix& marks, Index first, Index count) {
  return marks.size() > 0 ? Matrix(marks.middleRows(first, count)) : Matrix();
}

}  // namespace

void WindowSquares::add(const WindowSquares& other) {
  if (!std::isfinite(other.sum)) {
    ++diverged;
    return;
  }
  sum += other.sum;
  count += other.count;
  diverged += other.diverged;
  blocks.insert(blocks.end(), other.blocks.begin(), other.blocks.end());
}

double WindowSquares::rms() const { return std::sqrt(sum / count); }

double WindowSquares::above(double floor) const {
  if (count == 0.0) return 0.0;
  return std::max(above_by_scatter(floor), rms() > 0.0 ? rms() / floor : 0.0);
}

double WindowSquares::above_by_scatter(double floor) const {
  if (blocks.size() < 2) return 0.0;
  const Eigen::Map<const Vector> all(blocks.data(), static_cast<Index>(blocks.size()));
  const auto freedom = static_cast<double>(blocks.size() - 1);
  const double mean = all.mean();
  const double variance = (all.array() - mean).square().sum() / freedom;
  const double error = std::sqrt(variance / (freedom + 1.0));
  if (!(error > 0.0)) return mean > floor * floor ? INFINITY : 0.0;
  constexpr double kNormal = 1.959963984540054;
  return (mean - floor * floor) / error * kNormal / student_quantile_975(freedom);
}

WindowSquares window_squares(const LinearisedRecord& record, const MarkedSamples& measured,
                             const NoiseModel& noise, const Vector& scale,
                             const WindowGrid& grid) {
  WindowSquares squares;
  NoiseModel exact = noise;
  exact.disturbance.setZero();
  for (Index first = grid.begin; first + grid.length <= record.samples();
       first += grid.length) {
    const Matrix values = measured.values.middleRows(first, grid.length);
    const Matrix marks = rows_of(measured.marks, first, grid.length);
    squares.add(one_window(part_of(record, first, grid.length), {values, marks}, exact, scale));
  }
  return squares;
}

Vector column_deviations(const std::vector<Matrix>& blocks) {
  Index rows = 0;
  for (const Matrix& block : blocks) {
    check_argument(block.cols() == blocks.front().cols(), "column_deviations",
                   "blocks have other numbers of columns");
    rows += block.rows();
  }
  check_argument(rows > 0, "column_deviations", "there is no row");
  Vector sum = Vector::Zero(blocks.front().cols());
  double count = 0.0;
  for (const Matrix& block : blocks) {
    sum += (block.rowwise() - block.colwise().mean()).colwise().squaredNorm().transpose();
    count += static_cast<double>(block.rows());
  }
  return (sum / count).cwiseSqrt().cwiseMax(1e-300);
}

Vector moving_deviations(const std::vector<Matrix>& blocks) {
  constexpr double kRounding = 1e-14;  // a fact: what subtracting a mean leaves of a constant
  Vector deviations = column_deviations(blocks);
  for (Index k = 0; k < deviations.size(); ++k) {
    double largest = 1e-300;
    for (const Matrix& block : blocks)
      if (block.rows() > 0) largest = std::max(largest, block.col(k).cwiseAbs().maxCoeff());
    if (deviations[k] <= kRounding * largest || deviations[k] <= 1e-300) deviations[k] = 0.0;
  }
  return deviations;
}

Index window_samples(const std::vector<Matrix>& paths, const std::vector<bool>& measured) {
  double shortest = static_cast<double>(paths.front().rows());
  for (const Matrix& path : paths)
    for (Index k = 0; k < path.cols(); ++k)
      if (measured[static_cast<std::size_t>(k)])
        shortest = std::min(shortest, mean_period(path.col(k)));
  return std::max(kShortest, static_cast<Index>(shortest));
}

Index window_samples(const Assimilation& fit) {
  std::vector<Matrix> paths;
  for (const LinearisedRecord& record : fit.records) paths.push_back(record.path);
  std::vector<bool> measured;
  for (const auto& noise : fit.noise.measurement) measured.push_back(noise.has_value());
  return window_samples(paths, measured);
}

double window_gap(const Assimilation& fit) {
  std::vector<Matrix> paths;
  for (const LinearisedRecord& record : fit.records) paths.push_back(record.path);
  const Vector scale = moving_deviations(paths);
  const Index length = window_samples(fit);
  const Matrix none;
  WindowSquares all;
  for (std::size_t r = 0; r < fit.records.size(); ++r) {
    const Matrix& marks = fit.omitted.empty() ? none : fit.omitted[r];
    all.add(window_squares(fit.records[r], {fit.measured[r], marks}, fit.noise, scale,
                           {0, std::min(length, fit.records[r].samples())}));
  }
  return all.rms();
}

}  // namespace lacuna
