// SPDX-License-Identifier: MIT
#include "lacuna/trajectories/smoother/innovation_filter.hpp"

#include <cmath>

#include "kalman_step.hpp"
#include "lacuna/core/base/error.hpp"

namespace lacuna {
namespace {

void check(const LinearisedRecord& record, const Matrix& measured, const Matrix& omitted,
           const NoiseModel& noise) {
  if (measured.rows() != record.samples() || measured.cols() != record.states() ||
      (omitted.size() > 0 &&
       (omitted.rows() != measured.rows() || omitted.cols() != measured.cols())) ||
      noise.states() != record.states())
    throw ArgumentError("innovation filter", "record, noise and path do not fit together",
                        "give one column for each state");
}

/// What is to be filtered.
struct FilterTask {
  const LinearisedRecord& record;
  const Matrix& measured;
  const Matrix& omitted;
  const NoiseModel& noise;
  const ChannelMap& map;
};

/// Runs the recursion; `visit(i, channel, innovation, gain)` sees each measurement that is
/// taken in.
template <class S, class Visit>
LACUNA_INLINE void run(const S& shape, const FilterTask& task, Visit& visit) {
  const LinearisedRecord& record = task.record;
  KalmanStep<S> step(shape, record, task.noise, task.map);
  for (Index i = 0; i < record.samples(); ++i) {
    for (Index c = 0; c < task.map.channels(); ++c) {
      const Index state = task.map.state[static_cast<std::size_t>(c)];
      const Mark mark = mark_of(task.omitted, i, state);
      if (!says_something(mark)) continue;
      visit(i, c, step.update(c, task.measured(i, state) - record.path(i, state), mark),
            step.gain());
    }
    if (i + 1 < record.samples()) step.predict(i);
  }
}

template <class S, class Visit>
void run_generic(const S& shape, const FilterTask& task, Visit& visit) {
  run(shape, task, visit);
}

#ifdef LACUNA_KERNEL_DISPATCH
template <class S, class Visit>
[[gnu::target("avx2,fma")]] void run_avx2(const S& shape, const FilterTask& task,
                                          Visit& visit) {
  run(shape, task, visit);
}
#endif

template <class Visit>
void run(const FilterTask& task, Visit visit) {
  with_shape(task.map.size, task.record.states(), [&](const auto& shape) {
#ifdef LACUNA_KERNEL_DISPATCH
    if (has_avx2()) return run_avx2(shape, task, visit);
#endif
    run_generic(shape, task, visit);
  });
}

}  // namespace

InnovationFilter run_filter(const LinearisedRecord& record, const Matrix& measured,
                            const Matrix& omitted, const NoiseModel& noise) {
  check(record, measured, omitted, noise);
  const ChannelMap map(record, noise);
  const Index n = record.samples();
  InnovationFilter filter;
  filter.size = map.size;
  filter.channels = map.channels();
  filter.state_of_channel = map.state;
  filter.colour_of_channel = map.colour;
  filter.colour_decay = map.decay;
  filter.gain = Matrix::Zero(map.size * map.channels(), n);
  filter.inverse_deviation = Matrix::Zero(map.channels(), n);
  filter.innovations = Matrix::Zero(map.channels(), n);
  DevianceSum deviance;
  run({record, measured, omitted, noise, map},
      [&](Index i, Index c, const Innovation& innovation, const double* gain) {
        filter.gain.col(i).segment(c * map.size, map.size) =
            Eigen::Map<const Vector>(gain, map.size);
        filter.inverse_deviation(c, i) = 1.0 / std::sqrt(innovation.variance);
        filter.innovations(c, i) = innovation.value * filter.inverse_deviation(c, i);
        deviance.add(innovation);
        ++filter.used;
      });
  filter.deviance = deviance.value();
  return filter;
}

double filter_deviance(const LinearisedRecord& record, const Matrix& measured,
                       const Matrix& omitted, const NoiseModel& noise) {
  check(record, measured, omitted, noise);
  DevianceSum deviance;
  const ChannelMap map(record, noise);
  run({record, measured, omitted, noise, map},
      [&](Index, Index, const Innovation& innovation, const double*) {
        deviance.add(innovation);
      });
  return deviance.value();
}

}  // namespace lacuna
