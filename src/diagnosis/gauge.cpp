// SPDX-License-Identifier: MIT
#include "lacuna/diagnosis/gauge.hpp"

#include <algorithm>
#include <cmath>

#include "lacuna/candidates/candidate_column.hpp"
#include "lacuna/estimation/innovation_filter.hpp"

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

/// Samples of a window: the shortest mean period of the smoothed states, no fewer than 20
/// samples.
Index window_length(const std::vector<LinearisedRecord>& records, const NoiseModel& noise) {
  double shortest = static_cast<double>(records.front().samples());
  for (const LinearisedRecord& record : records)
    for (Index k = 0; k < record.states(); ++k)
      if (noise.measurement[static_cast<std::size_t>(k)])
        shortest = std::min(shortest, mean_period(record.path.col(k)));
  return std::max<Index>(20, static_cast<Index>(shortest));
}

/// Sum of squares of the relative deviations, how many there are, and in how many windows the
/// model has no finite solution; those count for nothing else.
struct Squares {
  double sum = 0.0;
  double count = 0.0;
  Index diverged = 0;

  void add(const Squares& other) {
    if (!std::isfinite(other.sum)) {
      ++diverged;
      return;
    }
    sum += other.sum;
    count += other.count;
    diverged += other.diverged;
  }

  double rms() const { return std::sqrt(sum / count); }
};

/// First sample at which all effects are known: delayed values lie in the record, memories
/// have forgotten where they began. The first one of all when no window is left.
Index first_known(const OdeModel& nominal, const std::vector<FittedEffect>& effects,
                  const Trajectory& record, Index length) {
  const LinearisedRecord grid = grid_of(record, record.states);
  double time = record.time[0];
  for (const FittedEffect& effect : effects) {
    const auto known =
        known_from(effect.candidate,
                   {effect.shapes.data(), static_cast<std::size_t>(effect.shapes.size())},
                   nominal.variables(), grid);
    time = std::max(time, known.value_or(time));
  }
  Index first = 0;
  while (first < record.samples() && record.time[first] < time) ++first;
  return first + length <= record.samples() ? first : 0;
}

/// One window, its initial state being fitted.
Squares one_window(const LinearisedRecord& window, const Eigen::Ref<const Matrix>& measured,
                   const NoiseModel& exact, const Vector& scale) {
  Squares squares;
  const SmoothedRecord smoothed = smooth(window, measured, Matrix(), exact);
  for (Index k = 0; k < window.states(); ++k) {
    if (!exact.measurement[static_cast<std::size_t>(k)]) continue;
    const Vector left = measured.col(k) - window.path.col(k) - smoothed.deviation.col(k);
    squares.sum += left.squaredNorm() / (scale[k] * scale[k]);
    squares.count += static_cast<double>(left.size());
  }
  return squares;
}

/// Windows of one record from sample `begin` on, each fitted with its initial state free. The
/// record is linearised as a whole, so that delayed terms know what was before a window.
Squares window_squares(const LinearisedRecord& record, const Matrix& measured,
                       const NoiseModel& noise, const Vector& scale, Index begin,
                       Index length) {
  Squares squares;
  NoiseModel exact = noise;
  exact.disturbance.setZero();
  for (Index first = begin; first + length <= record.samples(); first += length)
    squares.add(one_window(part_of(record, first, length), measured.middleRows(first, length),
                           exact, scale));
  return squares;
}

/// Standard deviation of each column over several blocks of rows.
Vector deviations(const std::vector<Matrix>& blocks) {
  Vector sum = Vector::Zero(blocks.front().cols());
  double count = 0.0;
  for (const Matrix& block : blocks) {
    sum += (block.rowwise() - block.colwise().mean()).colwise().squaredNorm().transpose();
    count += static_cast<double>(block.rows());
  }
  return (sum / count).cwiseSqrt().cwiseMax(1e-300);
}

Vector deviations(const Dataset& data) {
  std::vector<Matrix> states;
  for (const Trajectory& record : data.trajectories) states.push_back(record.states);
  return deviations(states);
}

Vector path_deviations(const Assimilation& fit) {
  std::vector<Matrix> paths;
  for (const LinearisedRecord& record : fit.records) paths.push_back(record.path);
  return deviations(paths);
}

double noise_floor(const NoiseModel& noise, const Vector& scale) {
  double sum = 0.0;
  double count = 0.0;
  for (std::size_t k = 0; k < noise.measurement.size(); ++k) {
    if (!noise.measurement[k]) continue;
    const double colour = noise.coloured[k] ? noise.coloured[k]->deviation : 0.0;
    sum += (*noise.measurement[k] * *noise.measurement[k] + colour * colour) /
           (scale[static_cast<Index>(k)] * scale[static_cast<Index>(k)]);
    count += 1.0;
  }
  return std::sqrt(sum / count);
}

/// The model on records, with noise of the kind that was found and without the summands that
/// the measurement has: these are taken on a first path.
Assimilation without_faults(const Assimilation& found, Dataset& data,
                            const RunContext& context) {
  AssimilationOptions options;
  options.coloured = found.noise.coloured;
  Assimilation fit = assimilate(found.model, data, {}, options, context);
  if (found.channel_terms.empty()) return fit;
  for (std::size_t r = 0; r < fit.records.size(); ++r)
    data.trajectories[r].states =
        without_channel_terms(data.trajectories[r].states, fit.records[r],
                              found.model.variables(), found.channel_terms);
  return assimilate(found.model, data, {}, options, context);
}

/// The noise of a model with fewer states.
NoiseModel narrowed(NoiseModel noise, Index m) {
  noise.disturbance.conservativeResize(m);
  noise.measurement.resize(static_cast<std::size_t>(m));
  noise.coloured.resize(static_cast<std::size_t>(m));
  return noise;
}

}  // namespace

Index window_samples(const Assimilation& fit) { return window_length(fit.records, fit.noise); }

double window_gap(const Assimilation& fit) {
  const Vector scale = path_deviations(fit);
  const Index length = window_samples(fit);
  Squares all;
  for (std::size_t r = 0; r < fit.records.size(); ++r)
    all.add(window_squares(fit.records[r], fit.measured[r], fit.noise, scale, 0,
                           std::min(length, fit.records[r].samples())));
  return all.rms();
}

Gap gauge(const OdeModel& nominal, const Explanation& explanation, const Dataset& held_out,
          const RunContext& context) {
  context.report("gauging on records not used before", 0.0);
  const Index m = nominal.dimension();
  std::vector<Matrix> paths;
  for (const Trajectory& record : held_out.trajectories) paths.push_back(record.states);
  AugmentedProblem problem = augment(nominal, held_out, {}, explanation.effects, paths);
  const Assimilation fit = without_faults(explanation.fit, problem.data, context);
  const Vector scale = deviations(problem.data);
  const Index length = window_length(fit.records, fit.noise);
  Squares before, after;
  for (std::size_t r = 0; r < fit.records.size(); ++r) {
    const Index samples = std::min(length, fit.records[r].samples());
    const LinearisedRecord bare_record =
        linearise(nominal, held_out.trajectories[r], Matrix(fit.records[r].path.leftCols(m)),
                  1e-4 * scale.head(m));
    const Index begin =
        first_known(nominal, explanation.effects, held_out.trajectories[r], samples);
    const Squares full =
        window_squares(fit.records[r], fit.measured[r], fit.noise, scale, begin, samples);
    const Squares bare = window_squares(bare_record, held_out.trajectories[r].states,
                                        narrowed(fit.noise, m), scale, begin, samples);
    after.add(full);
    before.add(bare);
  }
  Gap gap{
      "rms of (measured - model) / standard deviation in windows of one mean period, initial "
      "state fitted",
      before.rms(),
      after.rms(),
      noise_floor(fit.noise, scale),
      0.0,
      {},
      before.diverged + after.diverged};
  const LinearisedRecord& first = fit.records.front();
  gap.window = static_cast<double>(length) * (first.time[1] - first.time[0]);
  for (const Trajectory& record : held_out.trajectories)
    if (gap.records.empty() || gap.records.back() != record.source)
      gap.records.push_back(record.source);
  return gap;
}

}  // namespace lacuna
