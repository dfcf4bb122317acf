// SPDX-License-Identifier: MIT
#include "run_figures.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/text.hpp"
#include "dynamics/attractor/power_spectrum.hpp"
#include "lacuna/core/statistics/interval.hpp"
#include "readable.hpp"
#include "trajectories/windows/window_gap.hpp"

namespace lacuna {
namespace {

constexpr Index kMostStates = 6;  // further ones are in the files
constexpr Index kWindows = 8;     // of an excerpt
constexpr Index kExcerpt = 1500;  // samples of an excerpt, at most

const GapRecord& longest(const std::vector<GapRecord>& runs) {
  return *std::max_element(runs.begin(), runs.end(), [](const auto& a, const auto& b) {
    return a.time.size() < b.time.size();
  });
}

Index shown_states(const RunView& view) {
  return std::min(kMostStates, static_cast<Index>(view.states.size()));
}

std::string time_label(const RunView& view) { return with_unit("time", view.time_unit); }

std::string state_label(const RunView& view, Index k) {
  const Quantity& state = view.states[static_cast<std::size_t>(k)];
  return with_unit(state.name, state.unit);
}

std::string file_name(const std::string& kind, const RunView& view, Index k) {
  return kind + "_" + view.states[static_cast<std::size_t>(k)].name;
}

/// Rows of it; their windows begin with the first.
GapRecord rows_of(const GapRecord& run, Index begin, Index count) {
  const auto part = [&](const Matrix& values) {
    return values.size() > 0 ? Matrix(values.middleRows(begin, count)) : Matrix();
  };
  return {run.source,         run.time.segment(begin, count),
          part(run.measured), part(run.before),
          part(run.after),    0,
          run.length};
}

/// The part that has windows: behind the last whole one there is no model to be shown.
GapRecord in_windows(const GapRecord& run) {
  const Index rows = run.time.size() - run.begin;
  const Index whole = run.length > 0 ? rows - rows % run.length : rows;
  if (whole == 0 || whole == run.time.size()) return run;
  return rows_of(run, run.begin, whole);
}

/// "the whole record", or how long the windows are in which the model was started anew.
std::string stretch_of(const GapRecord& run, const std::string& unit) {
  if (run.length <= 0 || run.length >= run.time.size()) return "over the whole record";
  return "in windows of " + format_number(run.time[run.length] - run.time[0], 3) + " " + unit;
}

/// Windows do not continue one another: a gap stands between them.
Series split_series(const std::string& label, const GapRecord& run, const Vector& values,
                    Curve curve) {
  Series series{label, run.time, values, curve};
  const Index n = values.size();
  std::vector<double> x, y;
  for (Index i = 0; i < n; ++i) {
    if (i > run.begin && run.length > 0 && (i - run.begin) % run.length == 0) {
      x.push_back(run.time[i]);
      y.push_back(std::numeric_limits<double>::quiet_NaN());
    }
    x.push_back(run.time[i]);
    y.push_back(values[i]);
  }
  series.x = Eigen::Map<const Vector>(x.data(), static_cast<Index>(x.size()));
  series.y = Eigen::Map<const Vector>(y.data(), static_cast<Index>(y.size()));
  return series;
}

GapRecord excerpt_of(const GapRecord& run) {
  const Index most = std::max(run.length, std::min(kExcerpt, kWindows * run.length));
  return in_windows(rows_of(run, run.begin, std::min(most, run.time.size() - run.begin)));
}

/// Whether any sample shows something of a state.
bool is_seen(const GapRecord& run, Index k) {
  return run.measured.col(k).array().isFinite().any();
}

double rms_off(const Matrix& measured, const Matrix& model, Index k) {
  double sum = 0.0, count = 0.0;
  for (Index i = 0; i < measured.rows(); ++i) {
    const double off = measured(i, k) - model(i, k);
    if (!std::isfinite(off)) continue;
    sum += off * off;
    count += 1.0;
  }
  return count > 0.0 ? std::sqrt(sum / count) : std::numeric_limits<double>::quiet_NaN();
}

/// Spectrum of what a model is off in state k; values outside of windows count as 0.
Series off_spectrum(const GapRecord& run, const Matrix& model, Index k, const Series& kind) {
  const Index n = run.time.size();
  const Matrix off = (run.measured.col(k) - model.col(k)).unaryExpr([](double v) {
    return std::isfinite(v) ? v : 0.0;
  });
  const Trajectory record{run.source, run.time, off, Matrix(n, 0), Matrix()};
  const PowerSpectrum spectrum = power_spectrum(record, std::clamp<Index>(n / 256, 1, 16));
  const Index count = spectrum.frequency.size() - 1;  // without the mean
  Series series = kind;
  series.x = spectrum.frequency.tail(count);
  series.y = spectrum.density.col(0).tail(count);
  return series;
}

bool has_spectrum(const GapRecord& run) {
  if (run.time.size() < 64) return false;
  const Trajectory record{run.source, run.time, run.measured, Matrix(), Matrix()};
  return uniform_step(record).has_value();
}

Orbit orbit_of(const std::string& label, const Matrix& states, Curve curve) {
  return {label, states.leftCols(3), curve};
}

Series plane_series(const std::string& label, const Matrix& states, Curve curve) {
  return {label, states.col(0), states.col(1), curve};
}

}  // namespace

Series ends_of(const std::string& label, const Vector& time, const Vector& low,
               const Vector& high, Curve curve) {
  const Index n = time.size();
  constexpr double kGap = std::numeric_limits<double>::quiet_NaN();
  Series series{label, Vector(2 * n + 1), Vector(2 * n + 1), curve};
  series.x << time, time[n - 1], time;
  series.y << low, kGap, high;
  return series;
}

Matrix stacked(const std::vector<Matrix>& parts) {
  Index rows = static_cast<Index>(parts.size()) - 1;
  for (const Matrix& part : parts) rows += part.rows();
  Matrix all = Matrix::Constant(rows, parts.front().cols(),
                                std::numeric_limits<double>::quiet_NaN());
  Index row = 0;
  for (const Matrix& part : parts) {
    all.middleRows(row, part.rows()) = part;
    row += part.rows() + 1;
  }
  return all;
}

std::string stretch_text(const RunView& view) {
  return stretch_of(longest(view.runs), view.time_unit);
}

std::vector<Picture> comparison_pictures(const RunView& view) {
  std::vector<Picture> pictures;
  if (view.runs.empty()) return pictures;
  const GapRecord run = excerpt_of(longest(view.runs));
  for (Index k = 0; k < shown_states(view); ++k) {
    LineFigure figure{
        file_name("comparison", view, k),
        state_label(view, k) +
            (is_seen(run, k) ? ": measured and modelled, " : ": not measured, modelled, ") +
            short_name(run.source),
        time_label(view),
        state_label(view, k),
        {}};
    if (run.before.size() > 0)
      figure.series.push_back(split_series(view.before, run, run.before.col(k), Curve::Before));
    figure.series.push_back(split_series(view.after, run, run.after.col(k), Curve::Model));
    // Points on top of the curves, which would hide them where the model is good.
    if (is_seen(run, k))
      figure.series.push_back(
          {"measured", run.time, run.measured.col(k), Curve::Measured, true});
    pictures.push_back(draw(figure));
  }
  return pictures;
}

std::vector<Picture> deviation_pictures(const RunView& view) {
  std::vector<Picture> pictures;
  if (view.runs.empty()) return pictures;
  const std::string stretch = stretch_text(view);
  const GapRecord run = in_windows(longest(view.runs));
  for (Index k = 0; k < shown_states(view); ++k) {
    if (!is_seen(run, k)) continue;
    LineFigure figure{file_name("deviation", view, k),
                      state_label(view, k) + ": measured minus model " + stretch,
                      time_label(view),
                      "difference in " + state_label(view, k),
                      {}};
    if (run.before.size() > 0)
      figure.series.push_back(split_series(
          view.before + ", rms " + format_number(rms_off(run.measured, run.before, k), 3), run,
          run.measured.col(k) - run.before.col(k), Curve::Before));
    figure.series.push_back(split_series(
        view.after + ", rms " + format_number(rms_off(run.measured, run.after, k), 3), run,
        run.measured.col(k) - run.after.col(k), Curve::Model));
    if (view.noise_along.size() > 0 && view.noise_along.col(k).array().isFinite().any()) {
      const Vector reach = kNormalQuantile975 * view.noise_along.col(k);
      figure.series.push_back(
          ends_of("95 % of the measurement noise", run.time, -reach, reach, Curve::Other));
    } else if (k < view.noise.size() && view.noise[k] > 0.0)
      figure.band = Band{"95 % of the measurement noise", -kNormalQuantile975 * view.noise[k],
                         kNormalQuantile975 * view.noise[k]};
    pictures.push_back(draw(figure));
  }
  return pictures;
}

std::vector<Picture> spectrum_pictures(const RunView& view) {
  std::vector<Picture> pictures;
  if (view.runs.empty() || !has_spectrum(longest(view.runs))) return pictures;
  const GapRecord& run = longest(view.runs);
  for (Index k = 0; k < shown_states(view); ++k) {
    if (!is_seen(run, k)) continue;
    LineFigure figure{file_name("spectrum", view, k),
                      state_label(view, k) + ": at which frequencies models are off",
                      "frequency [1/" + view.time_unit + "]",
                      "power spectral density",
                      {}};
    figure.logarithmic_y = true;
    if (run.before.size() > 0)
      figure.series.push_back(
          off_spectrum(run, run.before, k, {view.before, {}, {}, Curve::Before}));
    figure.series.push_back(
        off_spectrum(run, run.after, k, {view.after, {}, {}, Curve::Model}));
    pictures.push_back(draw(figure));
  }
  return pictures;
}

std::vector<Picture> orbit_pictures(const RunView& view) {
  if (view.runs.empty() || view.states.size() < 2) return {};
  const GapRecord& run = longest(view.runs);
  if (view.states.size() == 2) {
    LineFigure figure{"orbit", "Orbit", state_label(view, 0), state_label(view, 1), {}};
    figure.series.push_back(plane_series("measured", run.measured, Curve::Measured));
    figure.series.push_back(plane_series(view.after, run.after, Curve::Model));
    return {draw(figure)};
  }
  OrbitFigure figure{
      "orbit", "Orbit of the first three states: drag or press arrows to turn", {}, {}};
  for (Index k = 0; k < 3; ++k) figure.labels.push_back(state_label(view, k));
  figure.orbits.push_back(orbit_of("measured", run.measured, Curve::Measured));
  figure.orbits.push_back(orbit_of(view.after, run.after, Curve::Model));
  return {draw(figure)};
}

double relative_misfit(const std::vector<GapRecord>& runs, bool before) {
  std::vector<Matrix> measured;
  for (const GapRecord& run : runs) measured.push_back(run.measured);
  if (measured.empty()) return std::numeric_limits<double>::quiet_NaN();
  const Vector scale = column_deviations(measured);
  double sum = 0.0, count = 0.0;
  for (const GapRecord& run : runs)
    for (Index k = 0; k < scale.size(); ++k) {
      const double off = rms_off(run.measured, before ? run.before : run.after, k) / scale[k];
      if (!std::isfinite(off)) continue;
      sum += off * off * static_cast<double>(run.time.size());
      count += static_cast<double>(run.time.size());
    }
  return std::sqrt(sum / count);
}

}  // namespace lacuna
