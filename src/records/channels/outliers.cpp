// SPDX-License-Identifier: MIT
#include "outliers.hpp"

#include <cmath>

#include "core/numerics/least_squares.hpp"
#include "lacuna/data/records/marks.hpp"

namespace lacuna {
namespace {

/// Whether a sample near an end is off: by more than a parabola through the six next to it is
/// uncertain by there, and by more than what bends these six would take it away. At the end
/// itself no bend shows a spike.
bool stands_out_at_end(const Trajectory& record, Index state, Index end, double off,
                       const std::vector<bool>& marked) {
  constexpr Index kBeside = 6;
  constexpr double kMargin = 2.0;  // of a cubic: what is above it bends by less
  const Index step = 2 * end < record.samples() ? 1 : -1;
  std::vector<Index> beside;
  for (Index j = end + step; j >= 0 && j < record.samples() && beside.size() < kBeside;
       j += step)
    if (!marked[static_cast<std::size_t>(j)]) beside.push_back(j);
  if (beside.size() < kBeside) return false;
  Matrix powers(kBeside, 3), values(kBeside, 2);
  const double reach = record.time[beside.back()] - record.time[end];
  for (Index row = 0; row < kBeside; ++row) {
    const Index j = beside[static_cast<std::size_t>(row)];
    const double s = (record.time[j] - record.time[end]) / reach;
    powers.row(row) << 1.0, s, s * s;
    values.row(row) << record.states(j, state), s * s * s;
  }
  const Matrix inverse = (powers.transpose() * powers).inverse();
  const Matrix parabolas = inverse * (powers.transpose() * values);
  const Eigen::RowVector2d left = (values - powers * parabolas).colwise().norm();
  const double bend = std::abs(parabolas(0, 1)) / left[1];
  const double jump = std::abs(record.states(end, state) - parabolas(0, 0));
  return jump > off * std::sqrt(1.0 + inverse(0, 0)) && jump > kMargin * bend * left[0];
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
  std::vector<Matrix> marks;
  for (const Trajectory& record : data.trajectories) marks.push_back(marks_of(record));
  for (Index k = 0; k < data.state_count(); ++k) {
    const StateNoise& seen = noise[static_cast<std::size_t>(k)];
    if (!data.is_measured(k) || seen.kind == NoiseKind::None || seen.sigma <= 0.0) continue;
    for (std::size_t r = 0; r < marks.size(); ++r) {
      const Trajectory values = values_of(data.trajectories[r], k);
      const std::vector<Index> places = places_of_values(marks[r], k);
      const std::vector<Index> suspects = outlying_samples(values, 0, seen.sigma, deviations);
      for (const Index i : outliers_of(values, 0, deviations * seen.sigma, suspects))
        marks[r](places[static_cast<std::size_t>(i)], k) = number_of(Mark::Outlier);
    }
  }
  return marks;
}

}  // namespace lacuna
