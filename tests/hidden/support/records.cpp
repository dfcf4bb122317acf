// SPDX-License-Identifier: MIT
#include "hidden/support/records.hpp"

#include <algorithm>

#include "core/base/random.hpp"
#include "dynamics/integration/runge_kutta.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/dynamics/integration/simulate.hpp"

namespace lacuna::hidden {
namespace {

/// Independent random numbers for the parts of one record.
std::uint64_t derived(std::uint64_t seed, std::uint64_t part) { return 1000003 * seed + part; }

std::vector<Signal> drives(const Plant& plant, std::uint64_t seed) {
  std::vector<Signal> signals;
  const double end = plant.step * static_cast<double>(plant.samples + 1);
  for (const SignalSpec& spec : plant.drives)
    signals.emplace_back(spec, -plant.settle, end, derived(seed, 2 + signals.size()));
  return signals;
}

Vector drawn_start(const Plant& plant, std::uint64_t seed) {
  Random random(derived(seed, 1));
  Vector start = plant.start;
  for (Index k = 0; k < start.size(); ++k)
    start[k] += plant.spread[k] * random.uniform(-1.0, 1.0);
  return start;
}

/// Times at which some signal jumps.
Vector breaks_of(const std::vector<Signal>& signals) {
  std::vector<double> all;
  for (const Signal& signal : signals) {
    const std::vector<double> own = signal.breaks();
    all.insert(all.end(), own.begin(), own.end());
  }
  std::sort(all.begin(), all.end());
  return Eigen::Map<const Vector>(all.data(), static_cast<Index>(all.size()));
}

/// The orbit at -settle, 0 + shift, h + shift, ...
Solution orbit(const Plant& plant, const std::vector<Signal>& signals, double shift,
               std::uint64_t seed) {
  Vector times(plant.samples + 1);
  times << -plant.settle - plant.step, sample_times(shift, plant.step, plant.samples);
  const auto inputs = [&](double t, double* u) {
    for (const Signal& signal : signals) *u++ = signal(t);
  };
  const Dopri87 integrator{
      {.control = {
           .relative_tolerance = 1e-10, .absolute_tolerance = 1e-12, .max_step = plant.step}}};
  Solution solution = simulate(DrivenModel{plant.model, inputs, breaks_of(signals)}, integrator,
                               drawn_start(plant, seed), times);
  if (solution.status != IntegrationStatus::Completed)
    throw ArgumentError("hidden case", solution.message, "choose a bounded system");
  return solution;
}

Matrix sampled_inputs(const std::vector<Signal>& signals, const Vector& times, Index count) {
  Matrix inputs(times.size(), count);
  for (Index k = 0; k < count; ++k)
    for (Index i = 0; i < times.size(); ++i)
      inputs(i, k) = signals[static_cast<std::size_t>(k)](times[i]);
  return inputs;
}

}  // namespace

Dataset clean_record(const HiddenCase& hidden, std::uint64_t seed) {
  const Plant& plant = hidden.system;
  const std::vector<Signal> signals = drives(plant, seed);
  const Index states = hidden.nominal.dimension();
  const auto inputs = static_cast<Index>(hidden.nominal.inputs().size());
  const Vector times = sample_times(0.0, plant.step, plant.samples);
  const Solution solution = orbit(plant, signals, 0.0, seed);

  Dataset record{.time_unit = hidden.nominal.time_unit(),
                 .states = hidden.nominal.states(),
                 .inputs = hidden.nominal.inputs(),
                 .trajectories = {},
                 .rate_of = {},
                 .notes = {}};
  record.trajectories.push_back({hidden.name, times,
                                 solution.states.block(1, 0, plant.samples, states),
                                 sampled_inputs(signals, times, inputs), Matrix()});
  for (Index k = 0; k < hidden.skew.size(); ++k)
    if (hidden.skew[k] != 0.0)
      record.trajectories[0].states.col(k) =
          orbit(plant, signals, hidden.skew[k], seed).states.col(k).tail(plant.samples);
  return record;
}

Records make_records(const HiddenCase& hidden, double level, std::uint64_t seed) {
  const auto record = [&](std::uint64_t number) {
    return disturbed(clean_record(hidden, number), hidden.noise, level, derived(number, 17));
  };
  return {record(2 * seed), record(2 * seed + 1)};
}

Matrix central_rates(const Dataset& clean) {
  const Trajectory& run = clean.trajectories.at(0);
  const Index n = run.samples() - 6;
  const double h = run.time[1] - run.time[0];
  const auto lag = [&](Index k) { return run.states.middleRows(3 + k, n); };
  return (45.0 * (lag(1) - lag(-1)) - 9.0 * (lag(2) - lag(-2)) + (lag(3) - lag(-3))) /
         (60.0 * h);
}

Matrix leftover(const OdeModel& model, const Dataset& clean) {
  const Trajectory& run = clean.trajectories.at(0);
  Matrix rest = central_rates(clean);
  CompiledModel compiled = model.compile();
  Vector x, u, rate(model.dimension());
  for (Index i = 0; i < rest.rows(); ++i) {
    x = run.states.row(i + 3);
    u = run.inputs.row(i + 3);
    compiled.evaluate(run.time[i + 3], x.data(), u.data(), nullptr, rate.data());
    rest.row(i) -= rate.transpose();
  }
  return rest;
}

}  // namespace lacuna::hidden
