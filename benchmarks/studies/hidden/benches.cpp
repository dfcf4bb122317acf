// SPDX-License-Identifier: MIT
#include "benches.hpp"

#include <cmath>

#include "core/base/random.hpp"
#include "hidden/support/case_builder.hpp"

namespace lacuna::hidden {
namespace {

std::string bench_name(const std::string& name, std::uint64_t seed) {
  return name + "-" + std::to_string(seed);
}

SignalSpec converter(Index held, double step) {
  return {.shape = SignalSpec::Shape::Held,
          .mean = 1.0,
          .size = 2.0,
          .low = 0.05,
          .high = 2.0,
          .held = held,
          .step = step};
}

/// A motor's speed, 30 s.
Plant motor_speed(Random& random, const SignalSpec& drive) {
  const double pace = random.uniform(0.5, 3.0);
  return {model_of("s", {{"w", "rad/s"}}, {{"u", "V"}},
                   {{{"w", -pace}, {"u", pace * random.uniform(3.0, 8.0)}}}),
          Vector{{0.0}},
          Vector{{1.0}},
          0.05,
          600,
          10.0,
          {drive}};
}

HiddenCase late_motor(Random& random, std::uint64_t seed) {
  const Plant plant = motor_speed(random, converter(4, 0.05));
  CaseBuilder builder(bench_name("bench-late-motor", seed),
                      "A motor whose voltage acts part of a step late", plant);
  const double late = 0.05 * (random.uniform(0.2, 0.9) + std::floor(random.uniform(0.0, 3.0)));
  builder.hide({"w",
                {"delay", "channel-skew"},
                {},
                "delay(u," + std::to_string(late) + ")-u",
                plant.model.coefficient(0, "u")});
  return builder.misjudge("w", "w", random.uniform(0.8, 1.2)).build();
}

/// Two resistors and two capacitors behind a converter, 1.5 s.
HiddenCase late_filter(Random& random, std::uint64_t seed) {
  const double step = 0.001, pace = random.uniform(100.0, 300.0);
  const double square = pace * pace, damping = random.uniform(2.2, 3.0) * pace;
  SignalSpec levels = converter(16, step);
  levels.shape = SignalSpec::Shape::TwoLevel;
  const Plant plant{model_of("s", {{"v", "V"}, {"r", "V/s"}}, {{"u", "V"}},
                             {{{"r", 1.0}}, {{"u", square}, {"v", -square}, {"r", -damping}}}),
                    Vector{{0.0, 0.0}},
                    Vector{{0.1, 1.0}},
                    step,
                    1500,
                    0.1,
                    {levels}};
  CaseBuilder builder(bench_name("bench-late-filter", seed),
                      "A filter whose input acts part of a step late", plant);
  const double late = step * random.uniform(1.2, 2.8);
  builder.hide(
      {"r", {"delay", "channel-skew"}, {}, "delay(u," + std::to_string(late) + ")-u", square});
  return builder.build();
}

/// A pendulum with a motor, 40 s.
HiddenCase noisy_torque(Random& random, std::uint64_t seed) {
  const Plant plant{model_of("s", {{"th", "rad"}, {"w", "rad/s"}}, {{"u", "N m"}},
                             {{{"w", 1.0}},
                              {{"sin(th)", -random.uniform(10.0, 30.0)},
                               {"w", -random.uniform(0.2, 1.0)},
                               {"u", random.uniform(2.0, 8.0)}}}),
                    Vector{{0.0, 0.0}},
                    Vector{{0.3, 0.5}},
                    0.01,
                    4000,
                    5.0,
                    {{.size = 2.0, .low = 0.1, .high = 1.5}}};
  CaseBuilder builder(bench_name("bench-noisy-torque", seed),
                      "A pendulum whose torque is measured with noise", plant);
  return builder.misjudge("w", "u", random.uniform(0.8, 1.2)).build();
}

HiddenCase spiked_speed(Random& random, std::uint64_t seed) {
  CaseBuilder builder(bench_name("bench-spiked-speed", seed),
                      "A motor with one sample that is far off",
                      motor_speed(random, converter(10, 0.05)));
  return builder.misjudge("w", "u", random.uniform(0.8, 1.2)).build();
}

/// A slide on a guide that nobody described: v, with the place hidden; one stroke.
HiddenCase one_stroke(Random& random, std::uint64_t seed) {
  const Plant plant{
      model_of("s", {{"v", "m/s"}}, {{"u", "N"}}, {{{"u", random.uniform(0.05, 0.2)}}}),
      Vector{{0.0}},
      Vector{{0.0}},
      0.005,
      400,
      0.0,
      {{.mean = 20.0, .size = 2.0, .low = 0.2, .high = 1.0}}};
  CaseBuilder builder(bench_name("bench-one-stroke", seed),
                      "One stroke over a guide that drags along its length", plant);
  return builder.hidden_states({{"x", {{"v", 1.0}}}})
      .hide({"v", {}, {}, "x", -random.uniform(0.3, 1.0)})
      .inexpressible()
      .build();
}

HiddenCase steady_furnace(Random& random, std::uint64_t seed) {
  const double pace = random.uniform(0.003, 0.02);
  const Plant plant{
      model_of("s", {{"T", "degC"}}, {{"q", "%"}},
               {{{"1", 22.0 * pace}, {"T", -pace}, {"q", pace * random.uniform(0.5, 1.2)}}}),
      Vector{{22.0}},
      Vector{{1.0}},
      1.0,
      900,
      0.0,
      {{.shape = SignalSpec::Shape::TwoLevel,
        .mean = 50.0,
        .size = 0.0,
        .held = 900,
        .step = 1.0}}};
  CaseBuilder builder(bench_name("bench-steady-furnace", seed),
                      "A furnace that warms up behind a coarse converter", plant);
  return builder.misjudge("T", "T", random.uniform(0.7, 1.3)).build();
}

HiddenCase coarse_tank(Random& random, std::uint64_t seed) {
  const Plant plant{model_of("s", {{"h", "m"}}, {{"u", "V"}},
                             {{{"sqrt(h)", -random.uniform(0.02, 0.05)},
                               {"u", random.uniform(0.004, 0.01)}}}),
                    Vector{{0.5}},
                    Vector{{0.1}},
                    0.5,
                    1600,
                    200.0,
                    {{.shape = SignalSpec::Shape::TwoLevel,
                      .mean = 4.0,
                      .size = 1.5,
                      .held = 80,
                      .step = 0.5}}};
  CaseBuilder builder(bench_name("bench-coarse-tank", seed),
                      "A tank whose level is read on a coarse lattice", plant);
  return builder.misjudge("h", "sqrt(h)", random.uniform(0.7, 1.3)).build();
}

HiddenCase case_of(Bench kind, Random& random, std::uint64_t seed) {
  switch (kind) {
    case Bench::LateMotor:
      return late_motor(random, seed);
    case Bench::LateFilter:
      return late_filter(random, seed);
    case Bench::NoisyTorque:
      return noisy_torque(random, seed);
    case Bench::SpikedSpeed:
      return spiked_speed(random, seed);
    case Bench::OneStroke:
      return one_stroke(random, seed);
    case Bench::SteadyFurnace:
      return steady_furnace(random, seed);
    case Bench::CoarseTank:
      break;
  }
  return coarse_tank(random, seed);
}

double deviation_of(const Vector& values) {
  return std::sqrt((values.array() - values.mean()).square().mean());
}

void add_noise_to_input(double fraction, Random& random, Trajectory& record) {
  const double size = fraction * deviation_of(record.inputs.col(0));
  for (Index i = 0; i < record.samples(); ++i) record.inputs(i, 0) += size * random.normal();
}

void add_spike(Random& random, Trajectory& record) {
  const auto place =
      static_cast<Index>(random.uniform(0.2, 0.7) * static_cast<double>(record.samples()));
  record.states(place, 0) += random.uniform(2.0, 8.0) * deviation_of(record.states.col(0));
}

/// Noise of half a lattice step, then steps whose text has so many digits.
void put_on_lattice(double step, double digit, Random& random, Trajectory& record) {
  for (Index i = 0; i < record.samples(); ++i) {
    const double value = record.states(i, 0) + 0.3 * step * random.normal();
    record.states(i, 0) = std::round(step * std::round(value / step) / digit) * digit;
  }
}

void disturb(Bench kind, Random& random, Trajectory& record) {
  switch (kind) {
    case Bench::NoisyTorque:
      return add_noise_to_input(random.uniform(0.01, 0.02), random, record);
    case Bench::SpikedSpeed:
      return add_spike(random, record);
    case Bench::SteadyFurnace:
      return put_on_lattice(0.2417, 0.01, random, record);
    case Bench::CoarseTank:
      return put_on_lattice(random.uniform(0.005, 0.02), 1e-4, random, record);
    default:
      return;
  }
}

std::vector<std::string> forbidden_on(Bench kind) {
  if (kind == Bench::LateMotor || kind == Bench::LateFilter)
    return {"lag", "cubic-stiffness", "cubic-term", "higher-order-term", "extra-state"};
  if (kind == Bench::OneStroke) return {"time-trend", "parameter-drift", "periodic-forcing"};
  return {};
}

}  // namespace

std::vector<Bench> all_benches() {
  return {Bench::LateMotor, Bench::LateFilter,    Bench::NoisyTorque, Bench::SpikedSpeed,
          Bench::OneStroke, Bench::SteadyFurnace, Bench::CoarseTank};
}

BenchCase bench(Bench kind, std::uint64_t seed) {
  Random random(seed);
  BenchCase result{case_of(kind, random, seed)};
  const bool on_lattice = kind == Bench::SteadyFurnace || kind == Bench::CoarseTank;
  result.records = make_records(result.hidden, on_lattice ? 0.0 : kBenchNoise, seed);
  result.clean = make_records(result.hidden, 0.0, seed);
  disturb(kind, random, result.records.find.trajectories.front());
  disturb(kind, random, result.records.check.trajectories.front());
  result.forbidden = forbidden_on(kind);
  return result;
}

}  // namespace lacuna::hidden
