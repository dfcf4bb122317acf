// SPDX-License-Identifier: MIT
#include "hidden/support/signal.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace lacuna::hidden {

Signal::Signal(const SignalSpec& spec, double begin, double end, std::uint64_t seed)
    : base_(spec.mean) {
  Random random(seed);
  switch (spec.shape) {
    case SignalSpec::Shape::Multisine:
      draw_sines(spec, random);
      break;
    case SignalSpec::Shape::Steps:
      draw_edges(spec, begin, end, random);
      break;
    case SignalSpec::Shape::Held:
    case SignalSpec::Shape::TwoLevel:
      draw_samples(spec, begin, end, random);
      break;
    case SignalSpec::Shape::Switched:
      draw_switches(spec, begin, end, random);
      break;
  }
}

double Signal::sum_of(const std::vector<Sine>& sines, double t) {
  double sum = 0.0;
  for (const Sine& sine : sines) sum += sine.amplitude * std::sin(sine.omega * t + sine.phase);
  return sum;
}

void Signal::draw_sines(const SignalSpec& spec, Random& random) {
  const double amplitude = spec.size * std::sqrt(2.0 / spec.lines);
  const double band = (spec.high - spec.low) / spec.lines;
  for (int i = 0; i < spec.lines; ++i) {
    const double frequency = spec.low + band * (i + random.uniform());
    const double phase = random.uniform(0.0, 2.0 * std::numbers::pi);
    sines_.push_back({amplitude, 2.0 * std::numbers::pi * frequency, phase});
  }
}

void Signal::draw_edges(const SignalSpec& spec, double begin, double end, Random& random) {
  const double shortest = 1.0 / spec.high, longest = 1.0 / spec.low;
  const double reach = spec.size * std::sqrt(3.0);  // of a uniform distribution
  rise_ = 0.25 * shortest;
  double level = spec.mean + random.uniform(-reach, reach);
  base_ = level;
  for (double t = begin + random.uniform(shortest, longest); t < end;
       t += random.uniform(shortest, longest)) {
    const double next = spec.mean + random.uniform(-reach, reach);
    edges_.push_back({t, level, next - level});
    level = next;
  }
}

void Signal::go_to(double time, double level) {
  const double before = edges_.empty() ? base_ : edges_.back().level + edges_.back().height;
  if (level != before) edges_.push_back({time, before, level - before});
}

/// Edges stand at whole numbers of steps, as the samples do, to the last bit.
void Signal::draw_samples(const SignalSpec& spec, double begin, double end, Random& random) {
  const bool held = spec.shape == SignalSpec::Shape::Held;
  if (held) draw_sines(spec, random);
  const std::vector<Sine> sines = std::exchange(sines_, {});
  const auto level_at = [&](double t) {
    if (held) return spec.mean + sum_of(sines, t);
    return spec.mean + (random.uniform() < 0.5 ? -spec.size : spec.size);
  };
  rise_ = 0.0;
  base_ = level_at(begin);
  const double length = spec.step * static_cast<double>(spec.held);
  for (auto k = static_cast<Index>(std::ceil(begin / length));; ++k) {
    const double time = static_cast<double>(k * spec.held) * spec.step;
    if (!(time < end)) break;
    go_to(time, level_at(time));
  }
}

void Signal::draw_switches(const SignalSpec& spec, double begin, double end, Random& random) {
  const double shortest = 1.0 / spec.high, longest = 1.0 / spec.low;
  rise_ = 0.0;
  double sign = random.uniform() < 0.5 ? -1.0 : 1.0;
  base_ = spec.mean + sign * spec.size;
  for (double t = begin + random.uniform(shortest, longest); t < end;
       t += random.uniform(shortest, longest))
    go_to(t, spec.mean + (sign = -sign) * spec.size);
}

std::vector<double> Signal::breaks() const {
  std::vector<double> times;
  if (rise_ > 0.0) return times;
  for (const Edge& edge : edges_) times.push_back(edge.time);
  return times;
}

double Signal::operator()(double t) const {
  const double value = base_ + sum_of(sines_, t);
  const auto after = std::upper_bound(edges_.begin(), edges_.end(), t,
                                      [](double s, const Edge& edge) { return s < edge.time; });
  if (after == edges_.begin()) return value;
  const Edge& edge = *std::prev(after);
  // Perlin's polynomial: the first two derivatives vanish at both ends.
  const double u = rise_ > 0.0 ? std::min(1.0, (t - edge.time) / rise_) : 1.0;
  return edge.level + edge.height * u * u * u * (10.0 + u * (6.0 * u - 15.0));
}

}  // namespace lacuna::hidden
