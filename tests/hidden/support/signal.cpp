// SPDX-License-Identifier: MIT
#include "hidden/support/signal.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lacuna::hidden {

Signal::Signal(const SignalSpec& spec, double begin, double end, std::uint64_t seed)
    : base_(spec.mean) {
  Random random(seed);
  if (spec.shape == SignalSpec::Shape::Multisine)
    draw_sines(spec, random);
  else
    draw_edges(spec, begin, end, random);
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

double Signal::operator()(double t) const {
  double value = base_;
  for (const Sine& sine : sines_)
    value += sine.amplitude * std::sin(sine.omega * t + sine.phase);
  const auto after = std::upper_bound(edges_.begin(), edges_.end(), t,
                                      [](double s, const Edge& edge) { return s < edge.time; });
  if (after == edges_.begin()) return value;
  const Edge& edge = *std::prev(after);
  // Perlin's polynomial: the first two derivatives vanish at both ends.
  const double u = std::min(1.0, (t - edge.time) / rise_);
  return edge.level + edge.height * u * u * u * (10.0 + u * (6.0 * u - 15.0));
}

}  // namespace lacuna::hidden
