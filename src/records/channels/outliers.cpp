// SPDX-License-Identifier: MIT
#include "outliers.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>

#include "core/numerics/least_squares.hpp"
#include "lacuna/data/records/marks.hpp"

namespace lacuna {
namespace {

/// A polynomial of a degree through samples, seen from another one.
struct Curve {
  double jump = 0.0;       ///< of the other sample from the curve
  double left = 0.0;       ///< norm of what the curve leaves of its own samples
  double bend = 0.0;       ///< how far one degree more bends there, over what it leaves
  double deviation = 0.0;  ///< of the curve there, over that of the noise
};

Curve curve_through(const Trajectory& record, Index state, const std::vector<Index>& through,
                    Index degree, Index place) {
  const auto count = static_cast<Index>(through.size());
  Matrix powers(count, degree + 1), values(count, 2);
  const double reach = record.time[through.back()] - record.time[place];
  for (Index row = 0; row < count; ++row) {
    const Index j = through[static_cast<std::size_t>(row)];
    const double s = (record.time[j] - record.time[place]) / reach;
    double power = 1.0;
    for (Index c = 0; c <= degree; ++c, power *= s) powers(row, c) = power;
    values.row(row) << record.states(j, state), power;
  }
  const Matrix inverse = (powers.transpose() * powers).inverse();
  const Matrix curves = inverse * (powers.transpose() * values);
  const Eigen::RowVector2d left = (values - powers * curves).colwise().norm();
  return {std::abs(record.states(place, state) - curves(0, 0)), left[0],
          std::abs(curves(0, 1)) / left[1], std::sqrt(inverse(0, 0))};
}

/// Whether a sample is off by more than the curve is uncertain by there, and by more than what
/// bends the samples of the curve would take it away.
bool is_off(const Curve& curve, double off) {
  constexpr double kMargin = 2.0;  // of one degree more: what is above it bends by less
  return curve.jump > off * std::hypot(1.0, curve.deviation) &&
         curve.jump > kMargin * curve.bend * curve.left;
}

/// Whether a sample near an end is off a parabola through the six next to it. At the end
/// itself no bend shows a spike.
bool stands_out_at_end(const Trajectory& record, Index state, Index end, double off,
                       const std::vector<bool>& marked) {
  constexpr Index kBeside = 6;
  const Index step = 2 * end < record.samples() ? 1 : -1;
  std::vector<Index> beside;
  for (Index j = end + step; j >= 0 && j < record.samples() && beside.size() < kBeside;
       j += step)
    if (!marked[static_cast<std::size_t>(j)]) beside.push_back(j);
  return beside.size() == kBeside && is_off(curve_through(record, state, beside, 2, end), off);
}

/// Whether the record is smooth but for this sample: a cubic goes through its neighbours to
/// the noise, and not through the sample. Where a fast stretch is sampled coarsely no cubic
/// goes through the neighbours either.
/// @param off what is off. @param marked samples that are not to be used as neighbours.
bool stands_out(const Trajectory& record, Index state, Index i, double off,
                const std::vector<bool>& marked) {
  constexpr std::size_t kEachSide = 3;
  std::vector<Index> around;
  for (Index j = i - 1; j >= 0 && around.size() < kEachSide; --j)
    if (!marked[static_cast<std::size_t>(j)]) around.push_back(j);
  const std::size_t before = around.size();
  for (Index j = i + 1; j < record.samples() && around.size() < before + kEachSide; ++j)
    if (!marked[static_cast<std::size_t>(j)]) around.push_back(j);
  if (around.size() < 2 * kEachSide) return stands_out_at_end(record, state, i, off, marked);
  Matrix powers(static_cast<Index>(around.size()), 4);
  Vector values(powers.rows());
  const double reach = record.time[around.back()] - record.time[i];
  for (Index row = 0; row < powers.rows(); ++row) {
    const Index j = around[static_cast<std::size_t>(row)];
    const double s = (record.time[j] - record.time[i]) / reach;
    powers.row(row) << 1.0, s, s * s, s * s * s;
    values[row] = record.states(j, state);
  }
  const Vector cubic = least_squares(powers, values);
  const double left = (values - powers * cubic).norm();
  return left < off && std::abs(record.states(i, state) - cubic[0]) > off;
}

/// Marks of one state along a record of nothing but values.
std::vector<Index> outliers_of(const Trajectory& record, Index state, double off,
                               const std::vector<Index>& suspects) {
  std::vector<bool> marked(static_cast<std::size_t>(record.samples()), false);
  for (const Index i : suspects) marked[static_cast<std::size_t>(i)] = true;
  std::vector<Index> found;
  for (const Index end : {Index{0}, record.samples() - 1}) {
    if (!stands_out_at_end(record, state, end, off, marked)) continue;
    marked[static_cast<std::size_t>(end)] = true;
    found.push_back(end);
  }
  for (const Index i : suspects)
    if (stands_out(record, state, i, off, marked)) found.push_back(i);
  return found;
}

/// Samples one after another.
struct ShortRun {
  Index begin = 0, length = 0;
};

/// The largest step between neighbours among so many samples from one on.
double largest_step(const Trajectory& record, Index state, Index from, Index count) {
  double largest = 0.0;
  for (Index i = from; i + 1 < from + count; ++i)
    largest = std::max(largest,
                       std::abs(record.states(i + 1, state) - record.states(i, state)));
  return largest;
}

/// Whether a few samples are off together: each of them off a cubic through the three before
/// and the three behind, which are on it to the noise, and the record jumps there and back. At
/// a sharp turn, where no cubic goes through either, it jumps no more than beside it.
bool stand_out(const Trajectory& record, Index state, ShortRun run, double off) {
  constexpr Index kEachSide = 3;
  constexpr double kJump = 2.0;  // times the largest step beside
  const Index before = run.begin - kEachSide, behind = run.begin + run.length;
  if (before < 0 || behind + kEachSide > record.samples()) return false;
  const auto x = record.states.col(state);
  const double jump =
      std::min(std::abs(x[run.begin] - x[run.begin - 1]), std::abs(x[behind] - x[behind - 1]));
  const double beside = std::max(largest_step(record, state, before, kEachSide),
                                 largest_step(record, state, behind, kEachSide));
  if (!(jump > off) || !(jump > kJump * beside)) return false;
  std::vector<Index> around;
  for (Index j = 0; j < kEachSide; ++j) around.push_back(before + j);
  for (Index j = 0; j < kEachSide; ++j) around.push_back(behind + j);
  for (Index i = run.begin; i < behind; ++i) {
    const Curve curve = curve_through(record, state, around, 3, i);
    if (!(curve.left < off) || !is_off(curve, off)) return false;
  }
  return true;
}

/// Samples of a state along a record of nothing but values that are off together, two or three
/// in a row about a suspect.
std::vector<Index> runs_of_outliers(const Trajectory& record, Index state, double off,
                                    const std::vector<Index>& suspects) {
  std::vector<Index> found;
  for (const Index suspect : suspects)
    for (Index length = 2; length <= kLongestRun; ++length)
      for (Index begin = suspect - length; begin <= suspect + 1; ++begin) {
        if (!found.empty() && begin <= found.back()) continue;
        if (!stand_out(record, state, {begin, length}, off)) continue;
        for (Index i = begin; i < begin + length; ++i) found.push_back(i);
      }
  return found;
}

/// Places of the samples of a state that are values.
std::vector<Index> places_of_values(const Matrix& marks, Index state) {
  std::vector<Index> places;
  for (Index i = 0; i < marks.rows(); ++i)
    if (mark_of(marks, i, state) == Mark::Value) places.push_back(i);
  return places;
}

}  // namespace

std::vector<Matrix> mark_outliers(const Dataset& data, const std::vector<StateNoise>& noise,
                                  double deviations) {
  constexpr double kRare = 0.01;  // of the samples: short stretches that recur are motion
  std::vector<Matrix> marks;
  for (const Trajectory& record : data.trajectories) marks.push_back(marks_of(record));
  for (Index k = 0; k < data.state_count(); ++k) {
    const StateNoise& seen = noise[static_cast<std::size_t>(k)];
    if (!data.is_measured(k) || seen.kind == NoiseKind::None || seen.sigma <= 0.0) continue;
    std::vector<std::pair<std::size_t, Index>> together;
    double all = 0.0;
    for (std::size_t r = 0; r < marks.size(); ++r) {
      const Trajectory values = values_of(data.trajectories[r], k);
      const std::vector<Index> places = places_of_values(marks[r], k);
      const std::vector<Index> suspects = outlying_samples(values, 0, seen.sigma, deviations);
      const double off = deviations * seen.sigma;
      for (const Index i : outliers_of(values, 0, off, suspects))
        marks[r](places[static_cast<std::size_t>(i)], k) = number_of(Mark::Outlier);
      for (const Index i : runs_of_outliers(values, 0, off, suspects))
        together.push_back({r, places[static_cast<std::size_t>(i)]});
      all += static_cast<double>(places.size());
    }
    if (static_cast<double>(together.size()) > kRare * all) continue;
    for (const auto& [r, i] : together) marks[r](i, k) = number_of(Mark::Outlier);
  }
  return marks;
}

}  // namespace lacuna
