// SPDX-License-Identifier: MIT
#include "hidden/support/null_benches.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/random.hpp"
#include "data/derivatives/finite_differences.hpp"
#include "hidden/support/twins.hpp"
#include "lacuna/records/binding/model_view.hpp"

namespace lacuna::hidden {
namespace {

double spread_of(const Vector& values) {
  return std::sqrt((values.array() - values.mean()).square().mean());
}

/// Noise of 0.3 steps, then steps, then the digits of a text.
void put_on_steps(double step, double digit, Random& random, Trajectory& record) {
  for (Index i = 0; i < record.samples(); ++i) {
    const double value = record.states(i, 0) + 0.3 * step * random.normal();
    record.states(i, 0) = std::round(step * std::round(value / step) / digit) * digit;
  }
}

void put_on_coarse_steps(Random& random, Trajectory& record) {
  const double step = random.uniform(0.1, 0.4) * spread_of(record.states.col(0));
  put_on_steps(step, step, random, record);
}

/// A digit a seventh to a thirtieth of the step.
void put_on_rounded_steps(Random& random, Trajectory& record) {
  const double step = random.uniform(0.02, 0.1) * spread_of(record.states.col(0));
  put_on_steps(step, step / random.uniform(7.0, 30.0), random, record);
}

void add_noise_to_input(Random& random, Trajectory& record) {
  const double size = random.uniform(0.01, 0.02) * spread_of(record.inputs.col(0));
  for (Index i = 0; i < record.samples(); ++i) record.inputs(i, 0) += size * random.normal();
}

void add_spikes(Random& random, Trajectory& record) {
  const double spread = spread_of(record.states.col(0));
  const std::uint64_t count = 1 + random.below(4);
  for (std::uint64_t k = 0; k < count; ++k) {
    const auto place =
        static_cast<Index>(random.below(static_cast<std::uint64_t>(record.samples())));
    const double sign = random.below(2) == 0 ? 1.0 : -1.0;
    record.states(place, 0) += sign * spread * random.uniform(1.0, 8.0);
  }
}

/// Weights of a mean over a window, or of the least-squares parabola through it (Savitzky and
/// Golay 1964).
Vector weights_over(Index reach, bool parabola) {
  const Vector place = Vector::LinSpaced(2 * reach + 1, -double(reach), double(reach));
  if (!parabola) return Vector::Constant(place.size(), 1.0 / double(place.size()));
  Matrix powers(place.size(), 3);
  powers << Vector::Ones(place.size()), place, place.cwiseAbs2();
  const Matrix gram = powers.transpose() * powers;
  return powers * gram.ldlt().solve(Vector{{1.0, 0.0, 0.0}});
}

void smooth_states(Random& random, Trajectory& record) {
  const auto reach = static_cast<Index>(2 + random.below(6));
  const Vector weights = weights_over(reach, random.below(2) == 0);
  const Index left = record.samples() - 2 * reach;
  Matrix states = Matrix::Zero(left, record.states.cols());
  for (Index j = 0; j < weights.size(); ++j)
    states += weights[j] * record.states.middleRows(j, left);
  record.states = std::move(states);
  record.time = Vector(record.time.segment(reach, left));
  record.inputs = Matrix(record.inputs.middleRows(reach, left));
}

/// The first samples are means of those that there are.
void average_sensor(Random& random, Trajectory& record) {
  const auto window = static_cast<Index>(3 + random.below(10));
  const Vector sharp = record.states.col(0);
  for (Index i = 0; i < sharp.size(); ++i) {
    const Index count = std::min(window, i + 1);
    record.states(i, 0) = sharp.segment(i - count + 1, count).mean();
  }
}

/// The record as if only its first state had been measured.
Dataset first_state(const OdeModel& model, Dataset data) {
  data.states.resize(1);
  for (Trajectory& record : data.trajectories)
    record.states = Matrix(record.states.leftCols(1));
  return model_view(model, data, FiniteDifferences{});
}

/// @param random the same for the records of a case: a bench has one filter, one converter.
void disturb(BenchFault fault, Random& random, Trajectory& record) {
  switch (fault) {
    case BenchFault::CoarseLattice:
      return put_on_coarse_steps(random, record);
    case BenchFault::RoundedLattice:
      return put_on_rounded_steps(random, record);
    case BenchFault::NoisyInput:
      return add_noise_to_input(random, record);
    case BenchFault::Smoothed:
      return smooth_states(random, record);
    case BenchFault::MovingAverage:
      return average_sensor(random, record);
    case BenchFault::Spikes:
      return add_spikes(random, record);
    case BenchFault::HiddenStates:
    case BenchFault::SteadyInput:
      return;
  }
}

/// The input as it is at the end of its range.
void keep_input_steady(HiddenCase& hidden) {
  SignalSpec& drive = hidden.system.drives.front();
  drive.mean += drive.size;
  drive.size = 0.0;
}

}  // namespace

std::vector<BenchFault> all_bench_faults() {
  return {BenchFault::CoarseLattice, BenchFault::RoundedLattice, BenchFault::HiddenStates,
          BenchFault::NoisyInput,    BenchFault::Smoothed,       BenchFault::MovingAverage,
          BenchFault::SteadyInput,   BenchFault::Spikes};
}

std::string to_string(BenchFault fault) {
  switch (fault) {
    case BenchFault::CoarseLattice:
      return "coarse-lattice";
    case BenchFault::RoundedLattice:
      return "rounded-lattice";
    case BenchFault::HiddenStates:
      return "hidden-states";
    case BenchFault::NoisyInput:
      return "noisy-input";
    case BenchFault::Smoothed:
      return "smoothed";
    case BenchFault::MovingAverage:
      return "moving-average";
    case BenchFault::SteadyInput:
      return "steady-input";
    case BenchFault::Spikes:
      break;
  }
  return "spikes";
}

BenchCase null_bench(BenchFault fault, std::uint64_t seed) {
  const std::vector<Twin> devices = all_twins();
  BenchCase result{complete_twin(devices[seed % devices.size()], seed)};
  result.hidden.name += " " + to_string(fault);
  result.hidden.noise = NoiseKind::White;
  if (fault == BenchFault::SteadyInput) keep_input_steady(result.hidden);
  result.records = make_records(result.hidden, kBenchNoise, seed);
  result.clean = make_records(result.hidden, 0.0, seed);
  for (Dataset* data : {&result.records.find, &result.records.check}) {
    Random random(seed);
    disturb(fault, random, data->trajectories.front());
    if (fault == BenchFault::HiddenStates)
      *data = first_state(result.hidden.nominal, std::move(*data));
  }
  return result;
}

}  // namespace lacuna::hidden
