// SPDX-License-Identifier: MIT
#include "diagnose/journey/gap.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/statistics/robust_statistics.hpp"
#include "diagnose/candidates/candidate_column.hpp"
#include "explained_records.hpp"
#include "free_run.hpp"
#include "lacuna/data/records/marks.hpp"
#include "model/equations/formula_channel.hpp"
#include "trajectories/smoother/unknown_past.hpp"
#include "trajectories/windows/window_gap.hpp"
#include "trajectories/windows/window_paths.hpp"

namespace lacuna {
namespace {

/// First sample at which the model and all effects are known: delayed values lie in the record,
/// memories have forgotten where they began. The first one of all when no window is left.
Index first_known(const OdeModel& nominal, const std::vector<FittedEffect>& effects,
                  const Trajectory& record, Index length) {
  const LinearisedRecord grid = grid_of(nominal.inputs(), record, record.states);
  double time = record.time[0] + longest_delays(nominal).maxCoeff();
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

Vector deviations(const Dataset& data) {
  std::vector<Matrix> states;
  for (const Trajectory& record : data.trajectories) states.push_back(record.states);
  return moving_deviations(states);
}

/// White noise of a channel as its samples show it by themselves; 0 where they show none.
double noise_of_samples(const BoundRecords& records, std::size_t k) {
  const bool known =
      k < records.channels.size() && records.channels[k].noise.kind == NoiseKind::White;
  return known ? records.channels[k].noise.sigma : 0.0;
}

/// What the measurement noise alone makes: all of it, and without what of it has a memory,
/// beside which the fit may leave nothing to the white noise that the samples show.
struct NoiseFloors {
  double all = 0.0, white = 0.0;
};

NoiseFloors noise_floors(const NoiseModel& noise, const Vector& scale,
                         const HeldOutRecords& held_out) {
  NoiseFloors sums;
  double count = 0.0;
  for (std::size_t k = 0; k < noise.measurement.size(); ++k) {
    const double unit = scale[static_cast<Index>(k)];
    if (!noise.measurement[k] || unit == 0.0) continue;
    const double colour = noise.coloured[k] ? noise.coloured[k]->deviation : 0.0;
    const double shown = noise_of_samples(held_out.given, k);
    const double least = held_out.unexplained ? shown : 0.0;
    sums.all += std::pow(std::max(std::hypot(noise.rounded(k), colour), least) / unit, 2);
    sums.white += std::pow(std::max(noise.rounded(k), shown) / unit, 2);
    count += 1.0;
  }
  return {std::min(std::sqrt(sums.all / count), held_out.known_floor),
          std::min(std::sqrt(sums.white / count), held_out.known_floor)};
}

/// The noise of a model with fewer states.
NoiseModel narrowed(NoiseModel noise, Index m) {
  noise.disturbance.conservativeResize(m);
  noise.measurement.resize(static_cast<std::size_t>(m));
  noise.coloured.resize(static_cast<std::size_t>(m));
  return noise;
}

/// The nominal model and the one with effects on the same windows.
struct Comparison {
  WindowSquares before, after;
  GapRecord runs = {};
};

/// The samples that say something; NaN for the others, and for states that nobody measured.
Matrix said_by(const Trajectory& record, const NoiseModel& noise) {
  Matrix values = record.states;
  for (Index k = 0; k < values.cols(); ++k)
    for (Index i = 0; i < values.rows(); ++i)
      if (!noise.measurement[static_cast<std::size_t>(k)] ||
          !says_something(mark_of(record.marks, i, k)))
        values(i, k) = std::numeric_limits<double>::quiet_NaN();
  return values;
}

/// Paths on which the channels that are formulas have the values of these. In a window such a
/// channel is linearised and begins at a value of its own, so that its curve would jump in the
/// first sample and contradict those of the states.
Matrix with_channels(const OdeModel& model, const LinearisedRecord& record, Matrix paths) {
  CompiledModel formulas = model.compile();
  if (!formulas.delays().empty()) return paths;
  const Index m = model.dimension(), p = formulas.inputs();
  const Matrix slots = record.slots(record.sample_rows(), Eigen::all);
  Vector values(m);
  for (Index i = 0; i < paths.rows(); ++i) {
    const Vector state = paths.row(i), input = slots.row(i).segment(m, p);
    if (!state.allFinite()) continue;
    formulas.evaluate(record.time[i], state.data(), input.data(), nullptr, values.data());
    for (Index k = 0; k < m; ++k)
      if (is_formula_channel(model.states()[static_cast<std::size_t>(k)])) paths(i, k) = values[k];
  }
  return paths;
}

/// What the measurement adds to the states (n x m): nothing to those that nobody measured, whose
/// columns are where a search began.
Matrix added_by_measurement(const Trajectory& given, const Matrix& corrected,
                            const NoiseModel& noise) {
  Matrix added = given.states - corrected.leftCols(given.states.cols());
  for (Index k = 0; k < added.cols(); ++k)
    if (!noise.measurement[static_cast<std::size_t>(k)]) added.col(k).setZero();
  return added;
}

/// On one record.
Comparison compare_on(const OdeModel& nominal, const Assimilation& fit, std::size_t record,
                      const Trajectory& given, const Vector& scale, const WindowGrid& grid) {
  const Index m = nominal.dimension();
  const Matrix omitted = fit.omitted.empty() ? Matrix() : fit.omitted[record];
  const Matrix own = omitted.size() > 0 ? Matrix(omitted.leftCols(m)) : Matrix();
  const LinearisedRecord& full = fit.records[record];
  constexpr double kExact = 1e-4;  // of a deviation: no error of the integration shows
  const Vector accuracy = (scale.array() > 0.0).select(kExact * scale, kExact);
  const LinearisedRecord bare =
      linearise(nominal, given, Matrix(full.path.leftCols(m)), accuracy.head(m));
  const NoiseModel noise = narrowed(fit.noise, m);
  const Matrix& corrected = fit.measured[record];
  const Matrix after =
      with_channels(fit.model, full, window_paths(full, {corrected, omitted}, fit.noise, grid));
  return {window_squares(bare, {given.states, own}, noise, scale, grid),
          window_squares(full, {corrected, omitted}, fit.noise, scale, grid),
          // What the measurement adds stands in what the augmented model says of the samples.
          {given.source, given.time, said_by(given, noise),
           with_channels(nominal, bare, window_paths(bare, {given.states, own}, noise, grid)),
           after.leftCols(m) + added_by_measurement(given, corrected, noise), grid.begin,
           grid.length}};
}

/// Runs over whole records, of the nominal model and of the augmented one.
struct FreeRuns {
  std::optional<RunApart> before, after;
};

/// Along what both run.
struct WholeRecords {
  const Dataset& given;
  const Dataset& explained;  ///< without what the measurement adds by the explanation
  const Vector& scale;
  const std::vector<Index>& begins;
};

FreeRuns run_freely_both(const OdeModel& nominal, const Assimilation& fit,
                         const WholeRecords& along, Index least, const RunContext& context) {
  std::vector<Matrix> full, own;
  for (const LinearisedRecord& record : fit.records) {
    full.push_back(record.path);
    own.push_back(record.path.leftCols(nominal.dimension()));
  }
  const auto run = [&](const OdeModel& model, const std::vector<Matrix>& paths,
                       const Dataset& records) {
    return run_freely({model, paths, records, fit.noise, along.scale, along.begins}, least,
                      context);
  };
  return {run(nominal, own, along.given), run(fit.model, full, along.explained)};
}

std::vector<std::string> sources_of(const Dataset& data) {
  std::vector<std::string> sources;
  for (const Trajectory& record : data.trajectories)
    if (sources.empty() || sources.back() != record.source) sources.push_back(record.source);
  return sources;
}

/// Where the memory of an effect, or what corrects the records, has no finite values on them.
Gap not_measured(const Dataset& data) {
  constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();
  return {.metric = "none: the explanation has no finite values on these records",
          .before = kNothing,
          .after = std::numeric_limits<double>::infinity(),
          .records = sources_of(data)};
}

/// How long windows of so many samples last, the median of all: samples may be at uneven times.
double window_duration(const std::vector<GapRecord>& runs, Index length) {
  std::vector<double> durations;
  for (const GapRecord& run : runs)
    for (Index begin = run.begin; begin + 1 < run.time.size(); begin += length) {
      const Index end = std::min(begin + length, run.time.size() - 1);
      durations.push_back((run.time[end] - run.time[begin]) * static_cast<double>(length) /
                          static_cast<double>(end - begin));
    }
  return durations.empty() ? 0.0 : median(std::move(durations));
}

/// The gap on records whose clocks are those of the explanation.
Gap gap_on(const OdeModel& nominal, const Explanation& explanation,
           const HeldOutRecords& held_out, const RunContext& context) {
  const std::optional<ExplainedRecords> explained =
      explained_records(nominal, explanation, held_out, context);
  if (!explained) return not_measured(held_out.given.data);
  const auto& [records, fit] = *explained;
  const Vector scale = deviations(records.data);
  const Index length = window_samples(fit);
  Comparison all;
  std::vector<GapRecord> runs;
  std::vector<Index> begins;
  for (std::size_t r = 0; r < fit.records.size(); ++r) {
    const Index samples = std::min(length, fit.records[r].samples());
    const Trajectory& given = held_out.given.data.trajectories[r];
    const Index begin =
        first_known(nominal, explanation.effects, held_out.corrected.trajectories[r], samples);
    begins.push_back(begin);
    Comparison one = compare_on(nominal, fit, r, given, scale, {begin, samples});
    all.before.add(one.before);
    all.after.add(one.after);
    runs.push_back(std::move(one.runs));
  }
  const FreeRuns free = run_freely_both(
      nominal, fit, {held_out.given.data, records.data, scale, begins}, length, context);
  const double window = window_duration(runs, length);
  const NoiseFloors floors = noise_floors(fit.noise, scale, held_out);
  return {
      "rms of (measured - model) / standard deviation in windows of one mean period, "
      "initial state fitted",
      all.before.rms(),
      all.after.rms(),
      floors.all,
      all.after.above(floors.all),
      window,
      sources_of(held_out.given.data),
      all.before.diverged + all.after.diverged,
      std::move(runs),
      free.before,
      free.after,
      floors.white,
      all.after.above(floors.white)};
}

}  // namespace

Gap measure_gap(const OdeModel& nominal, const Explanation& explanation,
                const HeldOutRecords& held_out, const RunContext& context) {
  context.report("measuring the gap on records not used before", 0.0);
  const Vector offsets = clock_offsets(nominal, explanation, held_out, context);
  if (offsets.isZero(0.0)) return gap_on(nominal, explanation, held_out, context);
  BoundRecords given = held_out.given;
  given.data = with_clocks_ahead(std::move(given.data), offsets);
  const Dataset corrected = with_clocks_ahead(held_out.corrected, offsets);
  const HeldOutRecords shifted{given, corrected, held_out.outlying, held_out.known_floor,
                               held_out.unexplained};
  Gap gap = gap_on(nominal, explanation, shifted, context);
  for (std::size_t r = 0; r < gap.runs.size(); ++r)
    gap.runs[r].time.array() -= offsets[static_cast<Index>(r)];
  return gap;
}

}  // namespace lacuna
