// SPDX-License-Identifier: MIT
#include "run_bands.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "lacuna/core/base/error.hpp"
#include "lacuna/core/statistics/interval.hpp"
#include "trajectories/fit/fit_search.hpp"
#include "value_limits.hpp"

namespace lacuna {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// Steps so fine that no quantity is off by more than this part of its spread: a decision, no
/// picture and no band shows less.
constexpr double kFine = 1e-5;

/// Takes integration steps for the runs that are wanted; the spread of a quantity is that of its
/// runs.
FitPath fine_path(FitEngine& engine, const FitPoint& point) {
  choose_method(engine, point);
  const FitPath first = follow(engine, point, {});
  for (Index c = 0; c < engine.count(); ++c) {
    const Vector values = first.residuals.col(c);
    const double spread = (values.array() - values.mean()).matrix().norm();
    const double size = spread > 0.0 ? spread : values.norm();
    engine.sigma[c] = size > 0.0 && std::isfinite(size) ? kFine * size : 1.0;
  }
  choose_substeps(engine, point, {}, 1.0);
  FitPath path = follow(engine, point, {});
  if (!path.residuals.allFinite())
    throw DataError("prediction", "a run of the fitted model is not finite",
                    "give initial values and inputs that the model can follow");
  return path;
}

/// Standard error along a row of derivatives; NaN where it depends on what nothing is known of.
double error_along(const Vector& row, const RecordSpread& spread) {
  constexpr double kMoves = 1e-6;  // of the row: rounding of a direction that is open
  for (const auto& direction : spread.open.colwise())
    if (std::abs(row.dot(direction)) > kMoves * row.cwiseProduct(direction).norm()) return kNone;
  return std::sqrt(std::max(0.0, row.dot(spread.covariance * row)));
}

void set_limits(Index i, Index c, const std::optional<NoiseLaw>& law, double reach,
                FitBands& bands) {
  const double y = bands.value(i, c), error = bands.error(i, c);
  const bool by_factor = law && law->form == NoiseForm::LogNormal;
  const auto run = run_limits(y, error, reach, by_factor);
  bands.low(i, c) = run[0];
  bands.high(i, c) = run[1];
  const std::array<double, 2> none = {kNone, kNone};
  const auto value = law && std::isfinite(error) ? value_limits(*law, y, error, reach) : none;
  bands.least(i, c) = value[0];
  bands.most(i, c) = value[1];
}

FitBands empty_bands(const FitEngine& engine, Index record) {
  const Index first = engine.records.first(record), n = engine.records.end(record) - first;
  const Matrix none = Matrix::Constant(n, engine.count(), kNone);
  FitBands bands{engine.records.sources[static_cast<std::size_t>(record)],
                 engine.records.series.time.segment(first, n),
                 {},
                 none,
                 none,
                 none,
                 none,
                 none,
                 none};
  for (const FitChannel& channel : engine.records.channels)
    bands.quantities.push_back({channel.name, channel.unit});
  return bands;
}

}  // namespace

std::vector<FitChannel> quantities_of(const OdeModel& model) {
  std::vector<FitChannel> all;
  for (const Quantity& state : model.states())
    all.push_back({state.name, state.unit, Expression::variable(state.name)});
  for (const Output& output : model.outputs())
    if (std::none_of(all.begin(), all.end(),
                     [&](const FitChannel& one) { return one.name == output.name; }))
      all.push_back({output.name, output.unit, output.formula});
  return all;
}

QuantityNoise noise_of(const Fit& fit, const std::vector<FitChannel>& quantities) {
  double values = 0.0;
  for (const FitQuality& channel : fit.quality)
    values += static_cast<double>(channel.samples + channel.censored);
  const double wider = std::sqrt(values / std::max(1.0, fit.degrees_of_freedom));
  QuantityNoise all;
  for (const FitChannel& quantity : quantities) {
    const auto& formula = quantity.formula;
    const auto found =
        std::find_if(fit.quality.begin(), fit.quality.end(), [&](const FitQuality& channel) {
          return channel.channel == quantity.name ||
                 (formula.operation() == Operation::Variable && channel.channel == formula.name());
        });
    all.emplace_back();
    if (found == fit.quality.end()) continue;
    if (found->law)
      all.back() = found->law;
    else if (found->sizes > 0 && found->rmse > 0.0)
      all.back() = NoiseLaw{.constant = wider * found->rmse};
  }
  return all;
}

std::vector<FitBands> bands_of(const ParametrisedModel& model, FitRecords records,
                               const FitPoint& point, const std::vector<RecordSpread>& spreads,
                               const QuantityNoise& noise, double freedom) {
  FitEngine engine = fit_engine(model, std::move(records));
  const FitPath path = fine_path(engine, point);
  const double reach = student_quantile_95(std::max(1.0, freedom));
  std::vector<FitBands> all;
  for (Index r = 0; r < engine.records.records(); ++r) {
    FitBands bands = empty_bands(engine, r);
    const Index first = engine.records.first(r);
    const auto visit = [&](Index n, const Matrix& rows, const Vector&) {
      for (Index c = 0; c < engine.count(); ++c) {
        const Vector row = engine.sigma[c] * rows.row(c).transpose();
        bands.value(n - first, c) = -path.residuals(n, c);
        bands.error(n - first, c) = error_along(row, spreads[static_cast<std::size_t>(r)]);
        set_limits(n - first, c, noise[static_cast<std::size_t>(c)], reach, bands);
      }
    };
    sensitivities(engine, point, path, {}, r, visit);
    all.push_back(std::move(bands));
  }
  return all;
}

std::vector<FitBands> fitted_bands(FitEngine& engine, const FitUnknowns& unknowns,
                                   const FitMinimum& minimum, const FitErrors& errors,
                                   const Dataset& data, const Fit& fit) {
  const FitLinear linear = linearise(engine, unknowns, minimum.point, minimum.path, {});
  std::vector<RecordSpread> spreads;
  for (Index r = 0; r < engine.records.records(); ++r)
    spreads.push_back(spread_of_record(engine, unknowns, linear, errors, minimum.point, r));
  const std::vector<FitChannel> quantities = quantities_of(engine.model.symbolic());
  return bands_of(engine.model, observed_records(engine.model, data, quantities), minimum.point,
                  spreads, noise_of(fit, quantities), fit.degrees_of_freedom);
}

}  // namespace lacuna
