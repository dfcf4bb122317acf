// SPDX-License-Identifier: MIT
#include "fit_records.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "core/base/text.hpp"
#include "dynamics/integration/event_stepper.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/data/records/marks.hpp"
#include "lacuna/data/records/noise.hpp"
#include "lacuna/dynamics/integration/simulate.hpp"
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

/// The law that the model has for the column of a state: of the output of its name, else of the
/// first one that is just the state, by which a column may be called (model_columns.hpp).
std::optional<NoiseLaw> law_of(const OdeModel& model, const std::string& state) {
  for (const Output& output : model.outputs())
    if (output.name == state) return output.noise;
  for (const Output& output : model.outputs())
    if (output.formula.operation() == Operation::Variable && output.formula.name() == state)
      return output.noise;
  return std::nullopt;
}

/// Why a law of noise cannot make a value; nothing where it can.
const char* impossible(const NoiseLaw& law, double value) {
  if (law.truncated && (value < law.below.value_or(value) || value > law.above.value_or(value)))
    return " are beyond the limits at which the noise is truncated: they were left out (without "
           "the word `truncated` they count as beyond a limit)";
  if (law.form == NoiseForm::LogNormal && !(value > 0.0) && !law.below)
    return " are not above 0, which lognormal noise cannot make: they were left out (write "
           "`below LIMIT` where they are below a limit)";
  if (law.form == NoiseForm::Proportional && value == 0.0)
    return " are exactly 0, where proportional noise has no deviation: they were left out "
           "(`noise both` has one there)";
  return nullptr;
}

/// Takes out values that the law of a channel cannot make.
void leave_out_impossible(FitRecords& records, Index c) {
  const FitChannel& channel = records.channels[static_cast<std::size_t>(c)];
  if (!channel.law) return;
  std::map<std::string, Index> left_out;
  for (Index i = 0; i < records.values.rows(); ++i) {
    const char* why = impossible(*channel.law, records.values(i, c));
    if (records.valid(i, c) == 0.0 || why == nullptr) continue;
    records.valid(i, c) = 0.0;
    ++left_out[why];
  }
  for (const auto& [why, count] : left_out)
    records.notes.push_back(std::to_string(count) + " values of " + channel.name + why);
}

void add_channel(const Dataset& view, Index column, const Expression& formula,
                 const KnownNoise& known, const std::optional<NoiseLaw>& law,
                 FitRecords& records) {
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
                              spread_of(samples), law});
  leave_out_impossible(records, c);
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
/// measured; else 0. What is not known exactly begins where the model is defined.
void guess_starts(const ParametrisedModel& model, const Dataset& view, FitRecords& records) {
  const OdeModel& symbolic = model.symbolic();
  const Index m = symbolic.dimension();
  records.starts = Matrix::Zero(records.records(), m);
  records.inside = state_ranges(model);
  for (Index k = 0; k < m; ++k) {
    const auto& given = symbolic.initial()[static_cast<std::size_t>(k)];
    const bool measured = !is_hidden(view, k) && view.is_measured(k);
    const Index integral = measured ? -1 : integral_of(symbolic, view, k);
    const bool is_rate = integral >= 0;
    if (is_rate) records.scale[k] = records.scale[integral] / records.time_scale;
    records.guessed.push_back(!measured && !is_rate && !given);
    records.fixed.push_back(given && given->fixed);
    for (Index r = 0; r < records.records(); ++r) {
      const Trajectory& run = view.trajectories[static_cast<std::size_t>(r)];
      const Matrix states = filled(run.states, run.marks);
      if (given)
        records.starts(r, k) = given->value;
      else if (measured)
        records.starts(r, k) = states(0, k);
      else if (is_rate)
        records.starts(r, k) = first_slope(run, states.col(integral), records.scale[k]);
      if (!(given && given->fixed))
        records.starts(r, k) = std::min(std::max(records.starts(r, k), records.inside.lower[k]),
                                        records.inside.upper[k]);
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

/// The record with one more row of no value in front of another.
Trajectory with_row(const Trajectory& record, Index before, double time, const Vector& inputs) {
  const auto extended = [&](const Matrix& values) {
    if (values.rows() == 0) return values;
    Matrix all(values.rows() + 1, values.cols());
    all << values.topRows(before), values.row(before - 1),
        values.bottomRows(values.rows() - before);
    return all;
  };
  Trajectory longer = record;
  longer.time.resize(record.samples() + 1);
  longer.time << record.time.head(before), time, record.time.tail(record.samples() - before);
  longer.states = extended(record.states);
  longer.inputs = extended(record.inputs);
  longer.derivatives = extended(record.derivatives);
  longer.marks = extended(marks_of(record));
  longer.marks.row(before).setConstant(number_of(Mark::Missing));
  if (inputs.size() > 0) longer.inputs.row(before) = inputs.transpose();
  return longer;
}

/// The events of each sample.
void find_events(const OdeModel& model, const Dataset& view, FitRecords& records) {
  if (model.events().empty()) return;
  records.events.resize(static_cast<std::size_t>(records.samples()));
  for (std::size_t r = 0; r < view.trajectories.size(); ++r) {
    const Vector& time = view.trajectories[r].time;
    for (const Occurrence& one : occurrences_at(model.events(), time)) {
      const Index row = std::lower_bound(time.begin(), time.end(), one.time) - time.begin();
      records.events[static_cast<std::size_t>(records.first(static_cast<Index>(r)) + row)]
          .push_back(one.event);
    }
  }
}

}  // namespace

Dataset with_event_rows(Dataset data, const OdeModel& model) {
  if (model.events().empty()) return data;
  std::vector<Quantity> inputs = data.inputs;
  for (std::size_t i = 0; i < std::min(inputs.size(), model.inputs().size()); ++i)
    inputs[i].hold = model.inputs()[i].hold;
  for (Trajectory& record : data.trajectories) {
    RecordInput signal(record, inputs);
    Vector values(static_cast<Index>(inputs.size()));
    for (const Occurrence& one : occurrences_at(model.events(), Vector(record.time))) {
      const Index row =
          std::lower_bound(record.time.begin(), record.time.end(), one.time) -
          record.time.begin();
      if (row == 0 || row == record.samples() || record.time[row] == one.time) continue;
      signal(one.time, values.data());
      record = with_row(record, row, one.time, values);
    }
  }
  return data;
}

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

void add_deviations(const Dataset& view, const std::vector<KnownDeviation>& known,
                    FitRecords& records) {
  const auto place_of = [](const auto& list, const std::string& name) {
    return std::find_if(list.begin(), list.end(),
                        [&](const auto& one) { return one.name == name; }) -
           list.begin();
  };
  for (const auto& [name, column] : known) {
    const Index c = place_of(records.channels, name), input = place_of(view.inputs, column);
    if (c == static_cast<Index>(records.channels.size()) || input == view.input_count())
      throw DataError("deviation of " + name,
                      input == view.input_count() ? "there is no column '" + column + "'"
                                                  : "nothing of that name is measured",
                      "name a measured column and the column of its standard deviations");
    if (records.channels[static_cast<std::size_t>(c)].law)
      throw DataError("deviation of " + name, "the model has a law of its noise, too",
                      "keep one of them");
    if (records.deviations.size() == 0)
      records.deviations = Matrix::Zero(records.samples(), records.values.cols());
    Index n = 0;
    for (const Trajectory& record : view.trajectories)
      for (Index i = 0; i < record.samples(); ++i, ++n) {
        const double deviation = record.inputs(i, input);
        if (records.valid(n, c) > 0.0 && !(deviation > 0.0 && std::isfinite(deviation)))
          throw DataError(record.source,
                          column + " is " + format_number(deviation) + " at t = " +
                              format_number(record.time[i]) + ", where " + name + " has a value",
                          "give every value a standard deviation above 0");
        records.deviations(n, c) = deviation;
      }
  }
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
                law_of(symbolic, view.states[static_cast<std::size_t>(k)].name), records);
  }
  for (const auto& [output, column] : measured_outputs(symbolic, view))
    add_channel(view, column, output.formula, noise, output.noise, records);
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
  find_events(symbolic, view, records);
  return records;
}

FitRecords observed_records(const ParametrisedModel& model, const Dataset& view,
                            std::vector<FitChannel> channels) {
  FitRecords records;
  records.series = series_of(model, view);
  for (const Trajectory& run : view.trajectories) records.sources.push_back(run.source);
  const auto count = static_cast<Index>(channels.size());
  records.channels = std::move(channels);
  records.values = Matrix::Zero(view.samples(), count);
  records.valid = Matrix::Ones(view.samples(), count);
  records.scale = Vector::Zero(model.symbolic().dimension());
  records.starts = Matrix::Zero(records.records(), records.scale.size());
  records.guessed.assign(static_cast<std::size_t>(records.scale.size()), false);
  find_events(model.symbolic(), view, records);
  return records;
}

}  // namespace lacuna
