// SPDX-License-Identifier: MIT
#include "fit_quality.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/statistics/significance.hpp"

namespace lacuna {
namespace {

/// Residuals beyond so many standard deviations of chance have something in common.
constexpr double kStructure = 4.0;

/// Sums over the samples of one channel that count.
struct Sums {
  double count = 0.0, squares = 0.0, values = 0.0, value_squares = 0.0;

  double rms() const { return std::sqrt(squares / count); }
  double spread_squares() const {
    return value_squares - values * values / std::max(1.0, count);
  }
};

Sums sums_of(const FitEngine& engine, const FitPath& path, Index channel, Index record,
             Index skip) {
  Sums sums;
  for (Index n = engine.records.first(record) + skip; n < engine.records.end(record); ++n) {
    if (!is_value(engine, n, channel)) continue;
    const double residual = path.residuals(n, channel),
                 value = engine.records.values(n, channel);
    ++sums.count;
    sums.squares += residual * residual;
    sums.values += value;
    sums.value_squares += value * value;
  }
  return sums;
}

void add(Sums& all, const Sums& more) {
  all.count += more.count;
  all.squares += more.squares;
  all.values += more.values;
  all.value_squares += more.value_squares;
}

/// Root mean square errors of prediction, NaN where there is none, and how many there are.
struct PredictionErrors {
  Vector rms, compared;  ///< c
};

PredictionErrors predictions_of(FitEngine& engine, const FitPoint& point, const FitPath& path,
                                Index ahead) {
  constexpr double kFraction = 0.1;
  const RoughSteps rough(engine);
  FitPath filtered;
  const Gains gains =
      filter_gains(engine, point, disturbances_of(engine, path, kFraction), filtered);
  Vector compared;
  const Matrix errors = prediction_errors(engine, point, gains, ahead, compared);
  return {errors.colwise().norm().transpose().array() / compared.array().sqrt(), compared};
}

/// The first samples of each record.
Dataset heads_of(Dataset data, Index samples) {
  for (Trajectory& record : data.trajectories)
    record = rows_of(record, 0, std::min(samples, record.samples()));
  return data;
}

/// Initial states of held-out records, and parameters that each record has for itself: those that
/// meet the first samples best. Initial states that these do not determine are as in the records
/// of the fit.
/// @param unknowns with what is known of these numbers.
FitPoint begun(const ParametrisedModel& model, const Matrix& parameters, const Dataset& data,
               const Matrix& usual, Index window, FitUnknowns unknowns,
               const RunContext& context) {
  FitEngine engine = fit_engine(model, fit_records(model, heads_of(data, window)));
  unknowns.global.clear();
  FitPoint point{parameters, engine.records.starts};
  for (Index k = 0; k < engine.states(); ++k) {
    auto& initial = unknowns.initial[static_cast<std::size_t>(k)];
    if (initial) continue;
    if (engine.records.guessed[static_cast<std::size_t>(k)]) {
      point.starts.col(k).setConstant(usual(k, 0));
      if (usual(k, 1) > 0.0) initial = InitialValue{usual(k, 0), false, 3.0 * usual(k, 1)};
    }
  }
  choose_method(engine, point);
  return minimise_in_time(engine, unknowns, point, {}, 60, with_last_second(context)).point;
}

/// Free runs of held-out records with given numbers.
struct HeldOut {
  std::vector<FitQuality> quality;
  double size = 0.0, noise = 0.0;
};

HeldOut held_out_with(const ParametrisedModel& model, const Vector& values, const Dataset& data,
                      const Matrix& usual, const FitOptions& options, FitUnknowns unknowns,
                      const RunContext& context) {
  for (const Index p : unknowns.varying)
    unknowns.priors[static_cast<std::size_t>(p)]->value = values[p];
  FitEngine engine = fit_engine(model, fit_records(model, data));
  set_substeps(engine, 4);
  const Matrix parameters = values.transpose().replicate(engine.records.records(), 1);
  const FitPoint point =
      begun(model, parameters, data, usual, options.window, std::move(unknowns), context);
  choose_method(engine, point);
  const FitPath path = follow(engine, point, {});
  HeldOut found{quality_of(engine, point, path, options.prediction, options.window)};
  double squares = 0.0, noise = 0.0, count = 0.0;
  for (std::size_t c = 0; c < found.quality.size(); ++c) {
    if (found.quality[c].samples == 0) continue;
    ++count;
    const double spread = std::max(engine.records.channels[c].spread, 1e-300);
    squares += std::pow(found.quality[c].rmse / spread, 2);
    noise += std::pow(found.quality[c].noise / spread, 2);
  }
  found.size = std::sqrt(squares / count);
  found.noise = std::sqrt(noise / count);
  return found;
}

}  // namespace

double correlation_sigma(const FitEngine& engine, const Matrix& residuals, Index channel) {
  constexpr Index kMostLags = 20;
  double count = 0.0;
  for (Index n = 0; n < residuals.rows(); ++n) count += is_value(engine, n, channel) ? 1.0 : 0.0;
  const double power = residuals.col(channel).squaredNorm();
  const auto lags = std::min(kMostLags, static_cast<Index>(count) / 5);
  if (lags < 1 || !(power > 0.0) || !std::isfinite(power)) return 0.0;
  double sum = 0.0;
  for (Index lag = 1; lag <= lags; ++lag) {
    double product = 0.0;
    for (Index r = 0; r < engine.records.records(); ++r) {
      const Index first = engine.records.first(r);
      const Index n = engine.records.end(r) - first - lag;
      if (n > 0)
        product += residuals.col(channel).segment(first, n).dot(
            residuals.col(channel).segment(first + lag, n));
    }
    const double correlation = product / power;
    sum += correlation * correlation / std::max(1.0, count - static_cast<double>(lag));
  }
  const double statistic = count * (count + 2.0) * sum;
  return sigma_of_log_probability(log_chi_squared_tail(statistic, static_cast<double>(lags)));
}

bool are_white(const FitEngine& engine, const Matrix& residuals) {
  for (Index c = 0; c < residuals.cols(); ++c)
    if (correlation_sigma(engine, residuals, c) >= kStructure) return false;
  return true;
}

std::vector<FitQuality> quality_of(FitEngine& engine, const FitPoint& point,
                                   const FitPath& path, Index ahead, Index skip) {
  const PredictionErrors prediction = predictions_of(engine, point, path, ahead);
  const Matrix residuals = whitened(engine, path);
  std::vector<FitQuality> found;
  for (Index c = 0; c < engine.count(); ++c) {
    const FitChannel& channel = engine.records.channels[static_cast<std::size_t>(c)];
    FitQuality quality{.channel = channel.name,
                       .unit = channel.unit,
                       .predicted = static_cast<Index>(prediction.compared[c]),
                       .noise = channel.noise,
                       .prediction = prediction.rms[c],
                       .structure = correlation_sigma(engine, residuals, c)};
    Sums all;
    for (Index r = 0; r < engine.records.records(); ++r) {
      const Sums sums = sums_of(engine, path, c, r, skip);
      quality.rmse_per_record.push_back(sums.rms());
      add(all, sums);
    }
    quality.samples = static_cast<Index>(all.count);
    quality.rmse = all.rms();
    const double spread = all.spread_squares();
    quality.fit_percent = spread > 0.0 ? 100.0 * (1.0 - std::sqrt(all.squares / spread))
                                       : std::numeric_limits<double>::quiet_NaN();
    quality.white = quality.structure < kStructure;
    quality.residuals = quality.white ? Adequate::Yes : Adequate::No;
    found.push_back(std::move(quality));
  }
  return found;
}

std::optional<FitGap> gap_of(const ParametrisedModel& model, const FitPoint& fitted,
                             const Dataset& held_out, const Matrix& usual,
                             const FitOptions& options, const FitUnknowns& unknowns,
                             const RunContext& context) {
  HeldOut after = held_out_with(model, fitted.parameters.colwise().mean().transpose(), held_out,
                                usual, options, unknowns, context);
  if (std::all_of(after.quality.begin(), after.quality.end(),
                  [](const FitQuality& quality) { return quality.samples == 0; }))
    return std::nullopt;
  FitGap gap{.before =
                 held_out_with(model, model.values(), held_out, usual, options, unknowns, context)
                     .size,
             .after = after.size,
             .noise_floor = after.noise,
             .records = {},
             .channels = std::move(after.quality)};
  for (const Trajectory& record : held_out.trajectories) gap.records.push_back(record.source);
  return gap;
}

}  // namespace lacuna
