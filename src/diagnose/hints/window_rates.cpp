// SPDX-License-Identifier: MIT
#include "window_rates.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace lacuna {
namespace {

constexpr Index kShortestRadius = 4;       // half of the shortest window: phi is resolved
constexpr Index kMostWindows = 4000;       // enough for fractions of a per cent
constexpr double kPowerOverNoise = 400.0;  // power of the rates over that of their noise
constexpr double kLongestStep = 1.5;       // usual steps; a longer one is a gap

struct Weights {
  Vector value;  ///< of a mean
  Vector slope;  ///< of a rate
};

/// Weights of the samples at given times: trapezia, corrected so that constants have the mean
/// they have and no slope, and t has the slope 1.
Weights weights_at(const Eigen::Ref<const Vector>& time) {
  const Index n = time.size();
  const double half = 0.5 * (time[n - 1] - time[0]);
  const Vector offset = time.array() - (time[0] + half);
  Weights weights{Vector(n), Vector(n)};
  for (Index i = 0; i < n; ++i) {
    const double s = offset[i] / half, rest = 1.0 - s * s;
    const double reach = time[std::min(i + 1, n - 1)] - time[std::max<Index>(i - 1, 0)];
    weights.value[i] = reach * rest * rest * rest;
    weights.slope[i] = reach * s * rest * rest;
  }
  weights.value /= weights.value.sum();
  weights.slope -= weights.slope.sum() * weights.value;
  weights.slope /= weights.slope.dot(offset);
  return weights;
}

/// Whether each sample of a record can be used.
/// @param with_marked those that are marked (missing, clipped, outliers) too.
std::vector<bool> usable_samples(const BoundRecords& records, std::size_t record,
                                 bool with_marked) {
  const Trajectory& run = records.data.trajectories[record];
  const Matrix& outliers = records.outliers[record];
  const double longest = kLongestStep * median_step(records.data);
  std::vector<bool> usable;
  for (Index i = 0; i < run.samples(); ++i)
    usable.push_back(run.states.row(i).allFinite() && run.inputs.row(i).allFinite() &&
                     (with_marked || outliers.size() == 0 || outliers.row(i).isZero(0.0)) &&
                     (i == 0 || run.time[i] - run.time[i - 1] <= longest));
  return usable;
}

RateWindows placed(const BoundRecords& records, Index half_width, bool with_marked = false) {
  RateWindows result{half_width, {}};
  const Index stride =
      std::max({Index{1}, half_width / 2, records.data.samples() / kMostWindows});
  for (std::size_t r = 0; r < records.data.trajectories.size(); ++r) {
    const std::vector<bool> usable = usable_samples(records, r, with_marked);
    const auto n = static_cast<Index>(usable.size());
    for (Index first = 0; first + result.samples() <= n; first += stride)
      if (std::all_of(usable.begin() + first, usable.begin() + first + result.samples(),
                      [](bool ok) { return ok; }))
        result.windows.push_back({r, first});
  }
  // A channel that is sampled rarely, or an input that is held in its place, is marked nearly
  // everywhere; what stands between its values is better than nothing.
  if (result.count() < kFewestWindows && !with_marked) return placed(records, half_width, true);
  return result;
}

/// Least ratio, over the measured states, of the power of the rates to that of their noise.
double standing_out(const BoundRecords& records, const RateWindows& windows) {
  if (windows.count() == 0) return 0.0;
  const Matrix rates = window_rates(records.data, windows);
  const Vector noise = rate_noise(records, windows);
  double least = std::numeric_limits<double>::infinity();
  for (Index k = 0; k < rates.cols(); ++k) {
    const double power = rates.col(k).squaredNorm() / static_cast<double>(rates.rows());
    if (noise[k] > 0.0) least = std::min(least, power / noise[k] - 1.0);
  }
  return least;
}

/// Calls visit(number, record, first sample, weights) for each window.
template <class Visit>
void for_each_window(const Dataset& data, const RateWindows& windows, const Visit& visit) {
  for (Index i = 0; i < windows.count(); ++i) {
    const RateWindow& window = windows.windows[static_cast<std::size_t>(i)];
    const Trajectory& record = data.trajectories[window.record];
    visit(i, record, window.first,
          weights_at(record.time.segment(window.first, windows.samples())));
  }
}

}  // namespace

RateWindows rate_windows(const BoundRecords& records) {
  const Index longest = longest_record(records.data).samples() / 16;
  std::optional<RateWindows> best;
  double most = 0.0;
  for (Index half = kShortestRadius; half <= std::max(longest, kShortestRadius);
       half += half / 2) {
    RateWindows windows = placed(records, half);
    const double out = standing_out(records, windows);
    if (!best || out > most) {
      best = std::move(windows);
      most = out;
    }
    if (most >= kPowerOverNoise) break;
  }
  return *best;
}

Matrix window_rates(const Dataset& data, const RateWindows& windows) {
  Matrix rates(windows.count(), data.state_count());
  for_each_window(data, windows,
                  [&](Index i, const Trajectory& record, Index first, const Weights& weights) {
                    const auto part = record.states.middleRows(first, windows.samples());
                    // Without the offset nothing is lost to rounding on a large one.
                    rates.row(i) =
                        weights.slope.transpose() * (part.rowwise() - part.row(0)).eval();
                  });
  return rates;
}

Matrix window_means(const Dataset& data, const RateWindows& windows, Index functions,
                    const SampleValues& values) {
  Matrix means(windows.count(), functions);
  // Windows overlap and stand in order: each sample is evaluated once.
  Matrix samples;  // functions x n
  const Trajectory* of = nullptr;
  Index known = 0;
  for_each_window(data, windows,
                  [&](Index i, const Trajectory& record, Index first, const Weights& weights) {
                    if (&record != of) {
                      samples.resize(functions, record.samples());
                      of = &record;
                      known = 0;
                    }
                    const Index end = first + windows.samples();
                    for (known = std::max(known, first); known < end; ++known)
                      values(record, known, samples.col(known).data());
                    means.row(i) = samples.middleCols(first, windows.samples()) * weights.value;
                  });
  return means;
}

Matrix model_rates(const OdeModel& model, const Dataset& data, const RateWindows& windows) {
  CompiledModel compiled = model.compile();
  Vector x, u;
  return window_means(data, windows, model.dimension(),
                      [&](const Trajectory& record, Index i, double* out) {
                        x = record.states.row(i);
                        u = record.inputs.row(i);
                        compiled.evaluate(record.time[i], x.data(), u.data(), nullptr, out);
                      });
}

Matrix term_means(const OdeModel& model, Index equation, const Dataset& data,
                  const RateWindows& windows) {
  std::vector<Expression> terms;
  for (const WeightedTerm& summand : model.equations()[static_cast<std::size_t>(equation)])
    terms.push_back(summand.term.expression());
  const Program program(terms, model.variables());
  Program::Workspace workspace;
  Vector slots(program.slots());
  return window_means(data, windows, program.outputs(),
                      [&](const Trajectory& record, Index i, double* out) {
                        slots << record.states.row(i).transpose(),
                            record.inputs.row(i).transpose(), record.time[i];
                        program.evaluate(slots.data(), out, workspace);
                      });
}

Vector rate_noise(const BoundRecords& records, const RateWindows& windows) {
  Vector noise = Vector::Zero(records.data.state_count());
  if (windows.count() == 0) return noise;
  const RateWindow& some = windows.windows.front();
  const Weights weights = weights_at(
      records.data.trajectories[some.record].time.segment(some.first, windows.samples()));
  for (Index k = 0; k < noise.size(); ++k) {
    const Channel& channel = records.channels[static_cast<std::size_t>(k)];
    if (channel.measured)
      noise[k] = std::pow(channel.noise.sigma, 2) * weights.slope.squaredNorm();
  }
  return noise;
}

}  // namespace lacuna
