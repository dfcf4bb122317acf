// SPDX-License-Identifier: MIT
#include "hidden/support/sensor_benches.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "hidden/support/twins.hpp"

namespace lacuna::hidden {
namespace {

/// What is done to a record.
using Change = std::function<void(Trajectory& record)>;

constexpr Index kPosition = 0, kSpeed = 1, kOnly = 0;

/// A bench: its device, what happens before noise is added and after that.
struct Setup {
  SensorBench bench;
  Twin device = Twin::LaggedThrust;
  bool coefficients_off = true;
  Change before = [](Trajectory&) {};
  Change after = [](Trajectory&) {};
  std::vector<std::string> names = {};  ///< of the input that acts late
};

/// First order, time constant in samples: the exact response to lines between samples.
Vector first_order(const Vector& x, double samples) {
  const double decay = std::exp(-1.0 / samples), mean = samples * (1.0 - decay);
  Vector y = x;
  for (Index i = 1; i < x.size(); ++i)
    y[i] = decay * y[i - 1] + (1.0 - mean) * x[i] + (mean - decay) * x[i - 1];
  return y;
}

/// Behind a filter of first order.
Change filtered(Index channel, double samples) {
  return [=](Trajectory& record) {
    record.states.col(channel) = first_order(record.states.col(channel), samples);
  };
}

/// Behind two of them in series.
Change filtered_twice(Index channel, double samples) {
  return [=](Trajectory& record) {
    for (int turn = 0; turn < 2; ++turn) filtered(channel, samples)(record);
  };
}

Change averaged_over(Index channel, Index window) {
  return [=](Trajectory& record) {
    record.states.col(channel) = mean_of_last(record.states.col(channel), window);
  };
}

/// A speed made of the difference to the position so many samples before.
Change speed_of_differences(Index samples) {
  return [=](Trajectory& record) {
    const Vector x = record.states.col(kPosition);
    for (Index i = 1; i < x.size(); ++i) {
      const Index from = std::max<Index>(i - samples, 0);
      record.states(i, kSpeed) = (x[i] - x[from]) / (record.time[i] - record.time[from]);
    }
  };
}

/// The device followed the first input as it was so many samples before.
Change input_late(Index samples) {
  return [=](Trajectory& record) {
    const Index left = record.samples() - samples;
    const Vector ahead = record.inputs.col(0).tail(left);
    record.time = Vector(record.time.head(left));
    record.states = Matrix(record.states.topRows(left));
    record.inputs = Matrix(record.inputs.topRows(left));
    record.inputs.col(0) = ahead;
  };
}

/// The device followed the first input behind an actuator of first order.
Change input_behind_actuator(double samples) {
  return [=](Trajectory& record) {
    const Vector u = record.inputs.col(0);
    const Index last = u.size() - 1;
    for (Index i = 0; i <= last; ++i) {
      const Index a = std::max<Index>(i - 1, 0), b = std::min(i + 1, last);
      record.inputs(i, 0) = u[i] + samples * (u[b] - u[a]) / static_cast<double>(b - a);
    }
  };
}

Change both(const Change& one, const Change& other) {
  return [=](Trajectory& record) {
    one(record);
    other(record);
  };
}

const Change kNothing = [](Trajectory&) {};
constexpr Twin kThrust = Twin::LaggedThrust, kSlide = Twin::LatticeFriction,
               kStore = Twin::SecondStore;

/// Filters before the noise of a converter.
std::vector<Setup> analogue_sensors() {
  const auto all = [](double samples) {
    return both(filtered(kPosition, samples), filtered(kSpeed, samples));
  };
  return {
      {{"thrust-right-speed-filter-null"}, kThrust, false, filtered(kSpeed, 5.0)},
      {{"slide-speed-filter-null"}, kSlide, true, filtered(kSpeed, 5.0)},
      {{"slide-position-second-order-null"}, kSlide, true, filtered_twice(kPosition, 3.0)},
      {{"slide-right-speed-second-order-null"}, kSlide, false, filtered_twice(kSpeed, 3.0)},
      {{"thrust-both-alike-null", false, false}, kThrust, true, all(4.0)},
      {{"slide-right-both-alike-null", false, false}, kSlide, false, all(4.0)},
      {{"thrust-both-unlike-null"},
       kThrust,
       true,
       both(filtered(kPosition, 3.0), filtered(kSpeed, 8.0))},
      {{"store-filter-null", false, false}, kStore, true, filtered(kOnly, 5.0)},
      {{"store-right-filter-null", false, false}, kStore, false, filtered(kOnly, 5.0)},
  };
}

/// What a computer makes of samples with noise.
std::vector<Setup> digital_sensors() {
  const Change means = both(averaged_over(kPosition, 10), averaged_over(kSpeed, 4));
  return {
      {{"thrust-position-digital-null"}, kThrust, true, kNothing, filtered(kPosition, 4.0)},
      {{"slide-position-digital-null"}, kSlide, true, kNothing, filtered(kPosition, 4.0)},
      {{"thrust-speed-digital-null"}, kThrust, true, kNothing, filtered(kSpeed, 6.0)},
      {{"slide-speed-digital-null"}, kSlide, true, kNothing, filtered(kSpeed, 6.0)},
      {{"thrust-differences-null"}, kThrust, true, kNothing, speed_of_differences(6)},
      {{"slide-differences-null"}, kSlide, true, kNothing, speed_of_differences(6)},
      {{"slide-right-differences-null"}, kSlide, false, kNothing, speed_of_differences(6)},
      {{"slide-differences-of-means-null"},
       kSlide,
       true,
       kNothing,
       both(averaged_over(kPosition, 4), speed_of_differences(3))},
      {{"thrust-means-null"}, kThrust, true, kNothing, means},
      {{"slide-means-null"}, kSlide, true, kNothing, means},
      {{"thrust-right-means-null"}, kThrust, false, kNothing, means},
      {{"store-mean-null", false, false}, kStore, true, kNothing, averaged_over(kOnly, 8)},
  };
}

/// Inputs that act late indeed.
std::vector<Setup> late_inputs() {
  const std::vector<std::string> delay{"delay"}, lag{"lag", "extra-state"};
  return {
      {{"thrust-late", true}, kThrust, true, input_late(6), kNothing, delay},
      {{"slide-late", true}, kSlide, true, input_late(6), kNothing, delay},
      {{"slide-right-late", true}, kSlide, false, input_late(3), kNothing, delay},
      {{"store-late", true}, kStore, true, input_late(6), kNothing, delay},
      {{"thrust-actuator", true}, kThrust, true, input_behind_actuator(8.0), kNothing, lag},
      {{"slide-right-actuator", true}, kSlide, false, input_behind_actuator(8.0), kNothing, lag},
      {{"thrust-late-speed-filter", true},
       kThrust,
       true,
       both(input_late(8), filtered(kSpeed, 5.0)),
       kNothing,
       delay},
      {{"slide-late-position-mean", true},
       kSlide,
       true,
       input_late(10),
       averaged_over(kPosition, 6),
       delay},
  };
}

std::vector<Setup> all_setups() {
  std::vector<Setup> all = analogue_sensors();
  for (const auto& more : {digital_sensors(), late_inputs()})
    all.insert(all.end(), more.begin(), more.end());
  return all;
}

HiddenCase case_of(const Setup& setup, std::uint64_t seed) {
  HiddenCase hidden = complete_twin(setup.device, seed);
  hidden.noise = NoiseKind::White;
  if (!setup.coefficients_off) {
    hidden.nominal = hidden.without_effects();
    hidden.wrong.clear();
    hidden.kind = Kind::Nothing;
  }
  if (setup.bench.acts_late) {
    hidden.kind = Kind::Effects;
    const std::string equation = setup.device == kStore ? "T" : setup.device == kSlide ? "v" : "w";
    hidden.effects = {{equation, setup.names, {}, "u", 0.0}};
    hidden.augmented.reset();
  }
  hidden.name = "sensor-bench-" + setup.bench.name;
  return hidden;
}

}  // namespace

Vector mean_of_last(const Vector& x, Index window) {
  Vector y(x.size());
  for (Index i = 0; i < x.size(); ++i) {
    const Index count = std::min(window, i + 1);
    y[i] = x.segment(i - count + 1, count).mean();
  }
  return y;
}

std::vector<SensorBench> all_sensor_benches() {
  std::vector<SensorBench> benches;
  for (const Setup& setup : all_setups()) {
    benches.push_back(setup.bench);
    benches.back().seed = 9300 + benches.size();
  }
  return benches;
}

const std::vector<std::string>& names_of_sensors() {
  static const std::vector<std::string> all{"sensor-lag", "sensor-gain", "sensor-offset",
                                            "sensor-drift", "channel-skew"};
  return all;
}

BenchCase made_bench(const SensorBench& bench) {
  const std::vector<Setup> setups = all_setups();
  const auto found = std::find_if(setups.begin(), setups.end(), [&](const Setup& setup) {
    return setup.bench.name == bench.name;
  });
  const std::uint64_t seed = bench.seed;
  BenchCase result{case_of(*found, seed)};
  const auto record = [&](std::uint64_t number, double level) {
    Dataset data = clean_record(result.hidden, number);
    found->before(data.trajectories.front());
    data = disturbed(data, result.hidden.noise, level,
                     1000003 * number + 17);
    found->after(data.trajectories.front());
    return data;
  };
  result.records = {record(2 * seed, kBenchNoise), record(2 * seed + 1, kBenchNoise)};
  result.clean = {record(2 * seed, 0.0), record(2 * seed + 1, 0.0)};
  return result;
}

}  // namespace lacuna::hidden
