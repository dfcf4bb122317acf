// SPDX-License-Identifier: MIT
#include "dynamics/attractor/prediction_time.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "core/base/check.hpp"
#include "core/statistics/robust_statistics.hpp"
#include "data/records/state_statistics.hpp"
#include "lacuna/dynamics/integration/simulate.hpp"
#include "lacuna/records/binding/model_view.hpp"

namespace lacuna {
namespace {

/// Free runs of a model from samples of a trajectory.
class Forecast {
 public:
  Forecast(const OdeModel& model, const Integrator& integrator, const Trajectory& run)
      : model_(model), integrator_(integrator), run_(run) {
    if (run.inputs.cols() > 0) input_.emplace(run, model.inputs());
  }

  /// `count` samples from `first` on; fewer when the orbit diverges.
  Matrix states(Index first, Index count) {
    const Vector start = run_.states.row(first).transpose();
    const Vector times = run_.time.segment(first, count);
    if (input_)
      return simulate(DrivenModel{model_, *input_, input_->breaks()}, integrator_, start, times)
          .states;
    return simulate(model_, integrator_, start, times).states;
  }

 private:
  const OdeModel& model_;
  const Integrator& integrator_;
  const Trajectory& run_;
  std::optional<RecordInput> input_;
};

/// A state that does not move does not count.
Vector inverse(const Vector& spread) {
  return spread.unaryExpr([](double size) { return size > 0.0 ? 1.0 / size : 0.0; });
}

/// Samples a forecast stays within the threshold, from the first on.
Index good_samples(const Matrix& states, const Eigen::Ref<const Matrix>& truth,
                   const Vector& spread, double threshold) {
  const Vector weight = inverse(spread);
  const double bound = threshold * std::sqrt(static_cast<double>(spread.size()));
  for (Index i = 0; i < states.rows(); ++i) {
    const Vector off = (states.row(i) - truth.row(i)).transpose().cwiseProduct(weight);
    if (!(off.norm() <= bound)) return i;
  }
  return states.rows();
}

/// Runs of growing length, so that a short forecast costs little in a long record.
Index good_samples_from(Index first, Forecast& forecast, const Trajectory& run,
                        const Vector& spread, double threshold) {
  const Index rest = run.samples() - first;
  for (Index count = 128;; count *= 2) {
    const Index tried = std::min(count, rest);
    const Index good = good_samples(forecast.states(first, tried),
                                    run.states.middleRows(first, tried), spread, threshold);
    if (good < tried || tried == rest) return good;
  }
}

}  // namespace

PredictionTime valid_prediction_time(const OdeModel& model, const Dataset& record,
                                     const Integrator& integrator,
                                     const PredictionOptions& options) {
  if (!(options.threshold > 0.0) || options.starts < 1)
    throw ArgumentError("valid_prediction_time", "threshold and starts must be positive", "");
  check_dataset(record);
  const Dataset view = model_view(model, record);
  Vector spread(view.state_count());
  for (Index k = 0; k < spread.size(); ++k) spread[k] = std::sqrt(state_variance(view, k));
  std::vector<double> times;
  PredictionTime result;
  for (const Trajectory& run : view.trajectories) {
    Forecast forecast(model, integrator, run);
    for (Index s = 0; s < options.starts; ++s) {
      const Index first = s * run.samples() / options.starts;
      const Index good = good_samples_from(first, forecast, run, spread, options.threshold);
      const Index end = first + good;
      if (end == run.samples()) ++result.cut_off;
      times.push_back(run.time[std::min(end, run.samples() - 1)] - run.time[first]);
    }
  }
  check_argument(!times.empty(), "valid_prediction_time", "there is no record");
  result.times = Eigen::Map<const Vector>(times.data(), static_cast<Index>(times.size()));
  result.median = median(std::move(times));
  return result;
}

}  // namespace lacuna
