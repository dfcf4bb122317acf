// SPDX-License-Identifier: MIT
#include "many_valued.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/base/check.hpp"
#include "data/records/check_record.hpp"

namespace lacuna {
namespace {

/// Decisions (docs/decisions/numbers.md).
constexpr double kNear = 0.1, kMostOnPath = 4.0, kFraction = 0.15;

/// Facts of the search for returns: differences below this fraction of a deviation are none; a
/// path that was so many distances away comes back; fewer samples show nothing.
constexpr double kSameValue = 0.05, kAway = 3.0;
constexpr Index kFewestReturns = 20;

/// Facts of cost: samples that are looked at, and among which their neighbours are sought.
constexpr Index kLookedAt = 300, kMostSamples = 20000;

/// Columns of all records, one sample a column, in deviations.
struct Points {
  Matrix at;     ///< r x n, of what may determine
  Matrix value;  ///< k x n, of what is determined
  std::vector<Index> first, last;  ///< n: first and last sample of the record of each
};

/// Divides each row by its deviation; one that is constant stays.
void scale(Matrix& rows) {
  for (auto row : rows.rowwise()) {
    row.array() -= row.mean();
    const double deviation = std::sqrt(row.squaredNorm() / static_cast<double>(row.size()));
    if (deviation > 0.0) row /= deviation;
  }
}

Points points_of(const Dataset& data, const std::vector<Index>& states,
                 const std::vector<Index>& of) {
  const Index stride = 1 + data.samples() / kMostSamples;
  Index count = 0;
  for (const Trajectory& record : data.trajectories)
    count += (record.samples() + stride - 1) / stride;
  Points points{Matrix(static_cast<Index>(of.size()) + data.input_count(), count),
                Matrix(static_cast<Index>(states.size()), count), {}, {}};
  Index next = 0;
  for (const Trajectory& record : data.trajectories) {
    const Index begin = next;
    for (Index i = 0; i < record.samples(); i += stride, ++next) {
      points.at.col(next) << record.states(i, of).transpose(),
          record.inputs.row(i).transpose();
      points.value.col(next) = record.states(i, states).transpose();
    }
    points.first.insert(points.first.end(), static_cast<std::size_t>(next - begin), begin);
    points.last.insert(points.last.end(), static_cast<std::size_t>(next - begin), next - 1);
  }
  scale(points.at);
  scale(points.value);
  return points;
}

/// The part of a path around one of its samples.
struct Pass {
  Index begin = 0, end = 0;  ///< samples until it is away
  Vector spread;     ///< k: root mean square difference of values from those of the sample
};

Pass pass_of(const Points& points, Index sample, double near) {
  const auto index = static_cast<std::size_t>(sample);
  Vector squares = Vector::Zero(points.value.rows());
  Index count = 0;
  const auto follow = [&](Index direction, Index last) {
    Index i = sample;
    while (i != last) {
      i += direction;
      const double distance = (points.at.col(i) - points.at.col(sample)).norm();
      // The next sample counts wherever it is: paths may be sampled coarsely.
      if (distance <= near || i == sample + direction) {
        squares += (points.value.col(i) - points.value.col(sample)).cwiseAbs2();
        ++count;
      }
      if (distance > kAway * near) break;
    }
    return i;
  };
  const Index begin = follow(-1, points.first[index]), end = follow(1, points.last[index]);
  return {begin, end, (squares / std::max(static_cast<double>(count), 1.0)).cwiseSqrt()};
}

/// The nearest sample of other passes within a distance.
std::optional<Index> nearest(const Points& points, Index sample, const Pass& pass,
                             double near) {
  std::optional<Index> found;
  double least = near * near;
  for (Index i = 0; i < points.at.cols(); ++i) {
    if (i >= pass.begin && i <= pass.end) continue;
    const double square = (points.at.col(i) - points.at.col(sample)).squaredNorm();
    if (square > least) continue;
    least = square;
    found = i;
  }
  return found;
}

}  // namespace

bool is_many_valued(const Dataset& data, const std::vector<Index>& states,
                    const std::vector<Index>& of) {
  check_columns(data, "is_many_valued");
  for (const auto* columns : {&states, &of})
    for (const Index state : *columns)
      check_number(state, data.state_count(), "is_many_valued", "state");
  if (states.empty() || of.empty() || data.samples() == 0) return false;
  const Points points = points_of(data, states, of);
  const double near = kNear * std::sqrt(static_cast<double>(points.at.rows()));
  Index returns = 0, differ = 0;
  const Index step = 1 + points.at.cols() / kLookedAt;
  for (Index sample = 0; sample < points.at.cols(); sample += step) {
    const Pass pass = pass_of(points, sample, near);
    const auto other = nearest(points, sample, pass, near);
    if (!other) continue;
    ++returns;
    const Vector difference =
        (points.value.col(*other) - points.value.col(sample)).cwiseAbs();
    const Vector most = (kMostOnPath * pass.spread).cwiseMax(kSameValue);
    differ += (difference.array() > most.array()).any();
  }
  return returns >= kFewestReturns &&
         static_cast<double>(differ) >= kFraction * static_cast<double>(returns);
}

}  // namespace lacuna
