// SPDX-License-Identifier: MIT
#include "records.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "lacuna/core/error.hpp"
#include "lacuna/data/noise.hpp"

namespace lacuna {
namespace {

Trajectory rows_of(const Trajectory& record, Index first, Index count,
                   const std::string& addition) {
  Trajectory part;
  part.source = record.source + addition;
  part.time = record.time.segment(first, count);
  part.states = record.states.middleRows(first, count);
  part.inputs = record.inputs.middleRows(first, count);
  return part;
}

/// Deviations of the noise that a sample must be off to be an outlier.
constexpr double kOutlying = 6.0;

/// Whether the record is smooth but for this sample: a cubic goes through its neighbours to
/// the noise, and not through the sample. Where a fast stretch is sampled coarsely no cubic
/// goes through the neighbours either.
/// @param marked samples that are not to be used as neighbours.
bool stands_out(const Trajectory& record, Index state, Index i, double sigma,
                const std::vector<bool>& marked) {
  constexpr std::size_t kEachSide = 3;
  std::vector<Index> around;
  for (Index j = i - 1; j >= 0 && around.size() < kEachSide; --j)
    if (!marked[static_cast<std::size_t>(j)]) around.push_back(j);
  const std::size_t before = around.size();
  for (Index j = i + 1; j < record.samples() && around.size() < before + kEachSide; ++j)
    if (!marked[static_cast<std::size_t>(j)]) around.push_back(j);
  if (around.size() < 2 * kEachSide) return true;
  Matrix powers(static_cast<Index>(around.size()), 4);
  Vector values(powers.rows());
  const double reach = record.time[around.back()] - record.time[i];
  for (Index row = 0; row < powers.rows(); ++row) {
    const Index j = around[static_cast<std::size_t>(row)];
    const double s = (record.time[j] - record.time[i]) / reach;
    powers.row(row) << 1.0, s, s * s, s * s * s;
    values[row] = record.states(j, state);
  }
  const Vector cubic = powers.colPivHouseholderQr().solve(values);
  const double left = (values - powers * cubic).norm();
  return left < kOutlying * sigma &&
         std::abs(record.states(i, state) - cubic[0]) > kOutlying * sigma;
}

Trajectory joined(const std::vector<Trajectory>& pieces, std::size_t first, std::size_t end) {
  if (end == first + 1) return pieces[first];
  Index samples = 0;
  for (std::size_t i = first; i < end; ++i) samples += pieces[i].samples();
  Trajectory whole{file_of(pieces[first]),
                   Vector(samples),
                   Matrix(samples, pieces[first].states.cols()),
                   Matrix(samples, pieces[first].inputs.cols()),
                   {}};
  Index row = 0;
  for (std::size_t i = first; i < end; row += pieces[i++].samples()) {
    whole.time.segment(row, pieces[i].samples()) = pieces[i].time;
    whole.states.middleRows(row, pieces[i].samples()) = pieces[i].states;
    whole.inputs.middleRows(row, pieces[i].samples()) = pieces[i].inputs;
  }
  return whole;
}

}  // namespace

Dataset bridged(const Dataset& data, std::vector<std::string>& notes) {
  constexpr Index kShortest = 20;
  constexpr double kLongestGap = 10.5;  // steps
  check_dataset(data);
  const double longest_gap = kLongestGap * median_step(longest_record(data));
  const std::vector<Trajectory>& pieces = data.trajectories;
  Dataset result = data;
  result.trajectories.clear();
  std::size_t gaps = 0, left_out = 0;
  for (std::size_t first = 0, end = 1; first < pieces.size(); first = end++) {
    while (end < pieces.size() && goes_on(pieces[end - 1], pieces[end], longest_gap)) ++end;
    gaps += end - first - 1;
    Trajectory whole = joined(pieces, first, end);
    if (whole.samples() >= kShortest)
      result.trajectories.push_back(std::move(whole));
    else
      ++left_out;
  }
  if (result.trajectories.empty())
    throw DataError(pieces.front().source, "no record has 20 samples or more in a row",
                    "give longer records");
  if (gaps > 0)
    notes.push_back(std::to_string(gaps) + " short gaps in the records are bridged");
  if (left_out > 0)
    notes.push_back(std::to_string(left_out) + " pieces of less than 20 samples were left out");
  return result;
}

std::pair<Dataset, Dataset> split_in_time(const Dataset& data) {
  Dataset find = data, check = data;
  find.trajectories.clear();
  check.trajectories.clear();
  for (const Trajectory& record : data.trajectories) {
    const Index kept = record.samples() - record.samples() / 4;
    find.trajectories.push_back(rows_of(record, 0, kept, ""));
    check.trajectories.push_back(
        rows_of(record, kept, record.samples() - kept, ", last quarter"));
  }
  return {std::move(find), std::move(check)};
}

std::vector<Matrix> mark_outliers(const Dataset& data) {
  const std::vector<StateNoise> noise = analyse_noise(data);
  std::vector<Matrix> marks;
  for (const Trajectory& record : data.trajectories)
    marks.push_back(Matrix::Zero(record.samples(), data.state_count()));
  for (Index k = 0; k < data.state_count(); ++k) {
    const StateNoise& seen = noise[static_cast<std::size_t>(k)];
    if (!data.is_measured(k) || seen.kind == NoiseKind::None || seen.sigma <= 0.0) continue;
    for (std::size_t r = 0; r < marks.size(); ++r) {
      const Trajectory& record = data.trajectories[r];
      const std::vector<Index> suspects = outlying_samples(record, k, seen.sigma);
      std::vector<bool> marked(static_cast<std::size_t>(record.samples()), false);
      for (const Index i : suspects) marked[static_cast<std::size_t>(i)] = true;
      for (const Index i : suspects)
        if (stands_out(record, k, i, seen.sigma, marked)) marks[r](i, k) = 1.0;
    }
  }
  return marks;
}

bool clear_false_outliers(const Dataset& data, Assimilation& fit,
                          std::vector<std::string>& notes) {
  bool cleared = false;
  for (Index k = 0; k < data.state_count(); ++k) {
    const auto& white = fit.noise.measurement[static_cast<std::size_t>(k)];
    if (!white) continue;
    Index count = 0;
    for (std::size_t r = 0; r < fit.omitted.size(); ++r)
      for (Index i = 0; i < fit.omitted[r].rows(); ++i) {
        if (fit.omitted[r](i, k) == 0.0) continue;
        const double off = std::abs(fit.measured[r](i, k) - fit.records[r].path(i, k));
        const bool outlier = off > kOutlying * *white;
        fit.omitted[r](i, k) = outlier ? 1.0 : 0.0;
        cleared = cleared || !outlier;
        count += outlier ? 1 : 0;
      }
    if (count > 0)
      notes.push_back(std::to_string(count) + (count == 1 ? " outlier of " : " outliers of ") +
                      data.states[static_cast<std::size_t>(k)].name +
                      (count == 1 ? " was left out" : " were left out"));
  }
  return cleared;
}

bool mostly_repeats(const Dataset& data) {
  for (Index k = 0; k < data.state_count(); ++k) {
    if (!data.is_measured(k)) continue;
    Index repeats = 0, steps = 0;
    for (const Trajectory& record : data.trajectories) {
      const Index n = record.samples() - 1;
      repeats += (record.states.col(k).tail(n).array() == record.states.col(k).head(n).array())
                     .count();
      steps += n;
    }
    if (2 * repeats > steps) return true;
  }
  return false;
}

}  // namespace lacuna
