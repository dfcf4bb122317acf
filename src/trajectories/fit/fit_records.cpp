// SPDX-License-Identifier: MIT
#include "fit_records.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/text.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/data/records/marks.hpp"
#include "lacuna/data/records/noise.hpp"
#include "lacuna/records/binding/model_view.hpp"

namespace lacuna {
namespace {

ShootingRecord series_of(const ParametrisedModel& model, const Dataset& view) {
  ShootingRecord series;
  const Index m = model.symbolic().dimension(), n = view.samples();
  for (Index k = 0; k < m; ++k) {
    const bool is_there = !is_hidden(view, k);
    series.rows.push_back(is_there ? std::optional(static_cast<Index>(series.measured.size()))
                                   : std::nullopt);
    if (is_there) series.measured.push_back(k);
  }
  series.time.resize(n);
  series.values.resize(n, static_cast<Index>(series.measured.size()));
  series.inputs.resize(n, model.record_inputs());
  series.begins = {0};
  for (Index i = 0; i < model.record_inputs(); ++i)
    series.holds.push_back(
        interpolation_of(model.symbolic().inputs()[static_cast<std::size_t>(i)].hold));
  for (const Trajectory& run : view.trajectories) {
    const Index first = series.begins.back(), count = run.samples();
    const Matrix states = filled(run.states, run.marks);
    series.time.segment(first, count) = run.time;
    if (!series.measured.empty())
      series.values.middleRows(first, count) = states(Eigen::all, series.measured);
    series.inputs.middleRows(first, count) = run.inputs.leftCols(model.record_inputs());
    series.begins.push_back(first + count);
  }
  return series;
}

/// Values of one column, record behind record, and where they are values.
struct Column {
  Vector values, valid;
};

Column column_of(const Dataset& view, Index column) {
  Column all{Vector(view.samples()), Vector(view.samples())};
  Index i = 0;
  for (const Trajectory& run : view.trajectories)
    for (Index n = 0; n < run.samples(); ++n, ++i) {
      all.values[i] = run.states(n, column);
      all.valid[i] = mark_of(run.marks, n, column) == Mark::Value ? 1.0 : 0.0;
    }
  return all;
}

double spread_of(const Column& column) {
  const double count = std::max(1.0, column.valid.sum());
  const double mean = column.values.dot(column.valid) / count;
  return std::sqrt(((column.values.array() - mean).square() * column.valid.array()).sum() /
                   count);
}

/// Standard deviation over that of the rate, from differences over enough samples that noise
/// does not matter.
double time_scale_of(const ShootingRecord& series, const Column& column, double noise) {
  const double spread = spread_of(column);
  double best = 0.0;
  for (Index stride = 1; stride < series.samples() / 4; stride *= 2) {
    double squares = 0.0, span = 0.0, count = 0.0;
    for (Index i = 0; i + stride < series.samples(); ++i) {
      const double step = series.time[i + stride] - series.time[i];
      if (!(step > 0.0) || column.valid[i] * column.valid[i + stride] == 0.0) continue;
      squares += std::pow(column.values[i + stride] - column.values[i], 2);
      span += step;
      ++count;
    }
    if (count == 0.0) continue;
    const double change = std::sqrt(squares / count);
    best = change > 0.0 ? spread * span / count / change : best;
    if (change > 5.0 * noise) break;
  }
  return best;
}

void add_channel(const Dataset& view, Index column, const Expression& formula,
                 const KnownNoise& known, FitRecords& records) {
  const Column samples = column_of(view, column);
  if (samples.valid.sum() < 2.0) return;
  const Quantity& quantity = view.states[static_cast<std::size_t>(column)];
  const auto c = static_cast<Index>(records.channels.size());
  records.values.conservativeResize(view.samples(), c + 1);
  records.valid.conservativeResize(view.samples(), c + 1);
  records.values.col(c) = samples.values;
  records.valid.col(c) = samples.valid;
  const StateNoise noise = known ? (*known)[static_cast<std::size_t>(column)]
                                 : analyse_noise_of(view, column);
  records.channels.push_back({quantity.name, quantity.unit, formula,
                              noise.kind == NoiseKind::None ? 0.0 : noise.sigma,
                              spread_of(samples)});
}

/// The measured state of which another is the rate by an identity of the model; -1: none.
Index integral_of(const OdeModel& model, const Dataset& view, Index state) {
  for (Index k = 0; k < model.dimension(); ++k)
    if (identity_of(model, k) == state && view.is_measured(k)) return k;
  return -1;
}

/// Slope of a state over its first samples; 0 where noise makes it larger than rates are.
double first_slope(const Trajectory& run, const Vector& values, double usual) {
  constexpr double kUnusual = 5.0;
  const Index last = std::min<Index>(2, run.samples() - 1);
  if (last < 1) return 0.0;
  const double slope = (values[last] - values[0]) / (run.time[last] - run.time[0]);
  return std::abs(slope) < kUnusual * usual ? slope : 0.0;
}

/// First guess of the initial states: what is known, or measured, or the slope of what is
/// measured; else 0.
void guess_starts(const ParametrisedModel& model, const Dataset& view, FitRecords& records) {
  const OdeModel& symbolic = model.symbolic();
  const Index m = symbolic.dimension();
  records.starts = Matrix::Zero(records.records(), m);
  for (Index k = 0; k < m; ++k) {
    const auto& given = symbolic.initial()[static_cast<std::size_t>(k)];
    const bool measured = !is_hidden(view, k) && view.is_measured(k);
    const Index integral = measured ? -1 : integral_of(symbolic, view, k);
    const bool is_rate = integral >= 0;
    if (is_rate) records.scale[k] = records.scale[integral] / records.time_scale;
    records.guessed.push_back(!measured && !is_rate && !given);
    for (Index r = 0; r < records.records(); ++r) {
      const Trajectory& run = view.trajectories[static_cast<std::size_t>(r)];
      const Matrix states = filled(run.states, run.marks);
      if (given)
        records.starts(r, k) = given->value;
      else if (measured)
        records.starts(r, k) = states(0, k);
      else if (is_rate)
        records.starts(r, k) = first_slope(run, states.col(integral), records.scale[k]);
    }
  }
}

/// The record behind one more row of the same values.
Trajectory with_first_row(const Trajectory& record, double time) {
  const auto repeated = [](const Matrix& values) {
    if (values.rows() == 0) return values;
    Matrix all(values.rows() + 1, values.cols());
    all << values.row(0), values;
    return all;
  };
  Trajectory begun = record;
  begun.time.resize(record.samples() + 1);
  begun.time << time, record.time;
  begun.states = repeated(record.states);
  begun.inputs = repeated(record.inputs);
  begun.derivatives = repeated(record.derivatives);
  begun.marks = repeated(marks_of(record));
  begun.marks.row(0).setConstant(number_of(Mark::Missing));
  return begun;
}

}  // namespace

Dataset begun_at(Dataset data, const std::optional<double>& time) {
  if (!time) return data;
  for (Trajectory& record : data.trajectories) {
    if (!(*time <= record.time[0]))
      throw DataError(record.source,
                      "it begins at t = " + format_number(record.time[0]) +
                          ", before the start time " + format_number(*time),
                      "give a start time that is not behind the first sample");
    if (*time < record.time[0]) record = with_first_row(record, *time);
  }
  return data;
}

FitRecords fit_records(const ParametrisedModel& model, const Dataset& view,
                       const KnownNoise& noise) {
  FitRecords records;
  const OdeModel& symbolic = model.symbolic();
  records.series = series_of(model, view);
  records.scale = Vector::Zero(symbolic.dimension());
  for (const Trajectory& run : view.trajectories) records.sources.push_back(run.source);
  for (Index k = 0; k < symbolic.dimension(); ++k) {
    if (is_hidden(view, k) || !view.is_measured(k)) continue;
    records.scale[k] = spread_of(column_of(view, k));
    add_channel(view, k,
                Expression::variable(symbolic.states()[static_cast<std::size_t>(k)].name), noise,
                records);
  }
  for (const auto& [output, column] : measured_outputs(symbolic, view))
    add_channel(view, column, output.formula, noise, records);
  if (records.channels.empty())
    throw DataError("records", "nothing of the model is measured",
                    "name columns as states or outputs of the model");
  std::vector<double> scales;
  for (std::size_t c = 0; c < records.channels.size(); ++c) {
    const auto column = static_cast<Index>(c);
    const double scale =
        time_scale_of(records.series, {records.values.col(column), records.valid.col(column)},
                      records.channels[c].noise);
    if (scale > 0.0) scales.push_back(scale);
  }
  if (!scales.empty()) records.time_scale = *std::min_element(scales.begin(), scales.end());
  guess_starts(model, view, records);
  return records;
}

}  // namespace lacuna
