// SPDX-License-Identifier: MIT
#include "input_signals.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>

#include "lacuna/core/numerics/sampled_signal.hpp"

namespace lacuna {
namespace {

using Numbers = Eigen::Ref<const Vector>;

constexpr std::array<std::pair<InputFamily, const char*>, 6> kFamilies{
    {{InputFamily::Steps, "steps"},
     {InputFamily::Prbs, "prbs"},
     {InputFamily::Multisine, "multisine"},
     {InputFamily::Chirp, "chirp"},
     {InputFamily::Ramps, "ramps"},
     {InputFamily::Spline, "spline"}}};

/// The times at which a signal can change, and its whole length.
struct Slots {
  Index count = 1;
  double length = 1.0;
  double duration = 1.0;
};

Slots slots_of(const PlanInput& input, const Vector& time, double step) {
  const double length = input.hold.value_or(step), duration = time[time.size() - 1];
  // A slot that only rounding begins is none.
  const auto count = static_cast<Index>(std::ceil(duration / length * (1.0 - 1e-12)));
  return {std::max<Index>(count, 1), length, duration};
}

/// a to b, equal ratios for equal differences of the fraction.
double geometric(double a, double b, double fraction) { return a * std::pow(b / a, fraction); }

/// Levels of equal length, 0..1.
Vector steps(const Numbers& design, const Slots& slots) {
  Vector signal(slots.count);
  for (Index s = 0; s < slots.count; ++s)
    signal[s] = design[std::min(s * design.size() / slots.count, design.size() - 1)];
  return signal;
}

/// Through knots that are equally far apart.
Vector curve(const Numbers& design, const Slots& slots, Interpolation interpolation) {
  const Index pieces = design.size() - 1;
  SampledSignal knots(Vector::LinSpaced(pieces + 1, 0.0, static_cast<double>(pieces)), design,
                      interpolation);
  Vector signal(slots.count);
  const auto last = static_cast<double>(std::max<Index>(slots.count - 1, 1));
  for (Index s = 0; s < slots.count; ++s)
    signal[s] = knots(static_cast<double>(s) / last * static_cast<double>(pieces));
  return signal;
}

/// [low level, high level, length of a bit, where the register begins]; the register of 11 bits
/// with the taps 11 and 9 has the period 2047.
Vector prbs(const Numbers& design, const Slots& slots) {
  constexpr std::uint32_t kPeriod = 2047;
  const double longest = std::max(1.0, static_cast<double>(slots.count) / 4.0);
  const auto bit = static_cast<Index>(std::lround(geometric(1.0, longest, design[2])));
  std::uint32_t state = 1U + static_cast<std::uint32_t>(design[3] * (kPeriod - 1));
  Vector signal(slots.count);
  for (Index s = 0; s < slots.count; ++s) {
    if (s > 0 && s % bit == 0)
      state = ((state << 1U) | (((state >> 10U) ^ (state >> 8U)) & 1U)) & kPeriod;
    signal[s] = (state & 1U) != 0 ? design[1] : design[0];
  }
  return signal;
}

/// Highest frequency of a sine: so that a period has eight changes at least.
double highest_frequency(const Slots& slots) {
  constexpr double kChanges = 8.0;
  return std::max(1.0 / slots.duration, 1.0 / (kChanges * slots.length));
}

/// [centre, amplitude, then amplitude and phase of each sine]; frequencies are multiples of
/// 1 / duration, equally far apart in their logarithms.
Vector multisine(const Numbers& design, const Slots& slots) {
  const Index tones = (design.size() - 2) / 2;
  Vector signal = Vector::Zero(slots.count);
  const double highest = highest_frequency(slots) * slots.duration;
  double before = 0.0;
  for (Index k = 0; k < tones; ++k) {
    const double fraction = tones > 1 ? static_cast<double>(k) / double(tones - 1) : 0.0;
    const double cycles = std::max(before + 1.0, std::round(geometric(1.0, highest, fraction)));
    before = cycles;
    for (Index s = 0; s < slots.count; ++s)
      signal[s] += design[2 + 2 * k] *
                   std::sin(2.0 * std::numbers::pi *
                            (cycles * static_cast<double>(s) * slots.length / slots.duration +
                             design[3 + 2 * k]));
  }
  const double largest = signal.cwiseAbs().maxCoeff();
  if (largest > 0.0) signal *= 0.5 * design[1] / largest;
  return signal.array() + design[0];
}

/// [centre, amplitude, first frequency, last frequency, phase].
Vector chirp(const Numbers& design, const Slots& slots) {
  const double lowest = 1.0 / slots.duration, highest = highest_frequency(slots);
  const double first = geometric(lowest, highest, design[2]),
               last = geometric(lowest, highest, design[3]);
  Vector signal(slots.count);
  for (Index s = 0; s < slots.count; ++s) {
    const double t = static_cast<double>(s) * slots.length;
    const double cycles = first * t + 0.5 * (last - first) * t * t / slots.duration;
    signal[s] = design[0] + 0.5 * design[1] *
                                std::sin(2.0 * std::numbers::pi * (cycles + design[4]));
  }
  return signal;
}

Vector shape_of(InputFamily family, const Numbers& design, const Slots& slots) {
  switch (family) {
    case InputFamily::Steps:
      return steps(design, slots);
    case InputFamily::Prbs:
      return prbs(design, slots);
    case InputFamily::Multisine:
      return multisine(design, slots);
    case InputFamily::Chirp:
      return chirp(design, slots);
    case InputFamily::Ramps:
      return curve(design, slots, Interpolation::Linear);
    case InputFamily::Spline:
      break;
  }
  return curve(design, slots, Interpolation::Cubic);
}

/// Distinct times: the sampling grid, and between its points where samples are taken.
Vector merged_times(const Vector& grid, Vector extra) {
  std::vector<double> all(grid.begin(), grid.end());
  all.insert(all.end(), extra.begin(), extra.end());
  std::sort(all.begin(), all.end());
  // What is nearer than this is one time: steps of no length cannot be integrated.
  const double apart = 1e-9 * grid[grid.size() - 1];
  all.erase(std::unique(all.begin(), all.end(),
                        [&](double a, double b) { return b - a < apart; }),
            all.end());
  return Eigen::Map<const Vector>(all.data(), static_cast<Index>(all.size()));
}

/// Marks the samples nearest to times.
Matrix samples_at(const Vector& time, const Vector& wanted, Index channels) {
  Matrix measured = Matrix::Zero(time.size(), channels);
  for (const double t : wanted) {
    Index nearest = 0;
    (time.array() - t).abs().minCoeff(&nearest);
    measured.row(nearest).setOnes();
  }
  return measured;
}

}  // namespace

std::string to_string(InputFamily family) {
  for (const auto& [known, name] : kFamilies)
    if (known == family) return name;
  return "";
}

std::optional<InputFamily> input_family_named(const std::string& name) {
  for (const auto& [family, known] : kFamilies)
    if (name == known) return family;
  return std::nullopt;
}

std::vector<InputFamily> all_input_families() {
  std::vector<InputFamily> families;
  for (const auto& [family, name] : kFamilies) families.push_back(family);
  return families;
}

Index design_size(const PlanInput& input, InputFamily family) {
  switch (family) {
    case InputFamily::Steps:
      return input.pieces;
    case InputFamily::Prbs:
      return 4;
    case InputFamily::Multisine:
      return 2 + 2 * Index{input.pieces};
    case InputFamily::Chirp:
      return 5;
    case InputFamily::Ramps:
    case InputFamily::Spline:
      break;
  }
  return Index{input.pieces} + 1;
}

Vector input_signal(const PlanInput& input, InputFamily family, const Numbers& design,
                    const Vector& time, double step) {
  const Slots slots = slots_of(input, time, step);
  Vector held = shape_of(family, design, slots);
  for (double& value : held)
    value = input.low + (input.high - input.low) * std::clamp(value, 0.0, 1.0);
  if (input.rate) {
    const double most = *input.rate * slots.length;
    for (Index s = 1; s < slots.count; ++s)
      held[s] = std::clamp(held[s], held[s - 1] - most, held[s - 1] + most);
  }
  Vector signal(time.size());
  for (Index i = 0; i < time.size(); ++i) {
    const auto slot = static_cast<Index>(std::floor(time[i] / slots.length * (1.0 + 1e-12)));
    signal[i] = held[std::clamp<Index>(slot, 0, slots.count - 1)];
  }
  return signal;
}

std::vector<DesignSpace> design_spaces(const PlanProblem& problem) {
  std::size_t most = 1;
  std::vector<std::vector<InputFamily>> families;
  for (const PlanInput& input : problem.inputs) {
    families.push_back(input.families.empty() ? all_input_families() : input.families);
    most = std::max(most, families.back().size());
  }
  std::vector<DesignSpace> spaces(most);
  for (std::size_t k = 0; k < most; ++k)
    for (const auto& own : families) spaces[k].families.push_back(own[k % own.size()]);
  return spaces;
}

Index design_size(const PlanProblem& problem, const DesignSpace& space) {
  Index size = problem.measurements.value_or(0);
  for (std::size_t i = 0; i < problem.inputs.size(); ++i)
    size += design_size(problem.inputs[i], space.families[i]);
  for (const PlanStart& start : problem.starts) size += start.low < start.high ? 1 : 0;
  return size;
}

Experiment experiment_of(const PlanProblem& problem, const DesignSpace& space,
                         const Vector& design) {
  const auto count = static_cast<Index>(std::floor(problem.duration / problem.step + 1e-9)) + 1;
  Vector grid(count);
  for (Index i = 0; i < count; ++i) grid[i] = static_cast<double>(i) * problem.step;
  const auto channels = static_cast<Index>(problem.channels.size());
  Experiment experiment;
  const Vector wanted = design.tail(problem.measurements.value_or(0)) * grid[count - 1];
  experiment.time = merged_times(grid, wanted);
  experiment.measured = problem.measurements
                            ? samples_at(experiment.time, wanted, channels)
                            : Matrix::Ones(experiment.time.size(), channels);
  experiment.inputs.resize(experiment.time.size(), static_cast<Index>(problem.inputs.size()));
  Index next = 0;
  for (std::size_t i = 0; i < problem.inputs.size(); ++i) {
    const Index size = design_size(problem.inputs[i], space.families[i]);
    experiment.inputs.col(static_cast<Index>(i)) =
        input_signal(problem.inputs[i], space.families[i], design.segment(next, size),
                     experiment.time, problem.step);
    next += size;
  }
  experiment.starts = problem.starts;
  for (PlanStart& start : experiment.starts)
    if (start.low < start.high)
      start.low = start.high = start.low + (start.high - start.low) * design[next++];
  return experiment;
}

}  // namespace lacuna
