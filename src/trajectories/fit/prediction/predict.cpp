// SPDX-License-Identifier: MIT
#include <algorithm>
#include <utility>

#include "data/records/check_record.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/data/records/marks.hpp"
#include "lacuna/records/binding/model_view.hpp"
#include "run_bands.hpp"
#include "trajectories/fit/delay_fit.hpp"

namespace lacuna {
namespace {

/// The initial values of a record and the variances of those that are not exact.
struct Beginning {
  Vector start, variance;  ///< m
};

Beginning beginning_of(const OdeModel& model, const Trajectory& record) {
  const Index m = model.dimension();
  Beginning begin{Vector::Zero(m), Vector::Zero(m)};
  for (Index k = 0; k < m; ++k) {
    const auto& given = model.initial()[static_cast<std::size_t>(k)];
    if (mark_of(record.marks, 0, k) == Mark::Value) {
      begin.start[k] = record.states(0, k);
    } else if (given) {
      begin.start[k] = given->value;
      if (!given->fixed && given->deviation)
        begin.variance[k] = *given->deviation * *given->deviation;
    } else {
      const std::string& name = model.states()[static_cast<std::size_t>(k)].name;
      throw DataError(record.source, "nothing says where " + name + " begins",
                      "give " + name + " a value in the first row, or the model an `initial`");
    }
  }
  return begin;
}

void check_shared(const Fit& fit) {
  for (const Parameter& parameter : fit.model.parameters())
    if (parameter.free && (parameter.per_record || parameter.varies))
      throw ModelError("parameter '" + parameter.name + "'",
                       "it differs from record to record, and a new record has another one",
                       "fix it, or let the records share it, for a prediction");
}

}  // namespace

std::vector<FitBands> predict(const Fit& fit, const Dataset& conditions) {
  check_shared(fit);
  const OdeModel& symbolic = fit.model.symbolic();
  check_flow(symbolic, "predict");
  check_is_view(fit.model.model(), conditions);
  check_columns(conditions, "predict");
  const Dataset data =
      with_event_rows(begun_at(conditions, symbolic.initial_time()), symbolic);
  const ParametrisedModel model = with_delays_held(fit.model).parametrised();
  const auto records = static_cast<Index>(data.trajectories.size());
  const Index m = symbolic.dimension(), p = model.size();
  FitPoint point{model.values().transpose().replicate(records, 1), Matrix(records, m)};
  std::vector<RecordSpread> spreads;
  for (Index r = 0; r < records; ++r) {
    const Beginning begin =
        beginning_of(symbolic, data.trajectories[static_cast<std::size_t>(r)]);
    point.starts.row(r) = begin.start.transpose();
    RecordSpread spread{Matrix::Zero(m + p, m + p),
                        Matrix::Zero(m + p, fit.spread.open.cols())};
    spread.covariance.topLeftCorner(m, m) = begin.variance.asDiagonal();
    spread.covariance.bottomRightCorner(p, p) = fit.spread.covariance;
    spread.open.bottomRows(p) = fit.spread.open;
    spreads.push_back(std::move(spread));
  }
  const std::vector<FitChannel> quantities = quantities_of(symbolic);
  return bands_of(model, observed_records(model, data, quantities), point, spreads,
                  noise_of(fit, quantities), fit.degrees_of_freedom);
}

}  // namespace lacuna
