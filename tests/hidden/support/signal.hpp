// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "core/base/random.hpp"
#include "lacuna/core/base/types.hpp"

namespace lacuna::hidden {

/// What drives a plant.
struct SignalSpec {
  enum class Shape {
    Multisine,  ///< equal sines of random phase, one in each of `lines` bands of [low, high]
    Steps,      ///< levels held for 1/high .. 1/low, with smooth edges
    Held,       ///< the multisine through a converter with a new value every `held` samples
    TwoLevel,   ///< mean +- size, drawn anew every `held` samples, sharp
    Switched,   ///< mean +- size in turns, each for 1/high .. 1/low, sharp, at any instant
  };
  Shape shape = Shape::Multisine;
  double mean = 0.0;
  double size = 1.0;  ///< standard deviation about the mean
  double low = 0.1;   ///< cycles per time unit
  double high = 1.0;
  int lines = 12;
  Index held = 1;     ///< samples
  double step = 0.0;  ///< of the samples of which `held` speaks
};

/// A random function of time: the same specification and seed give the same one.
class Signal {
 public:
  /// @param begin, end the times it is asked for; outside them a step signal holds its level.
  Signal(const SignalSpec& spec, double begin, double end, std::uint64_t seed);

  /// At a sharp edge the level behind it.
  double operator()(double t) const;

  /// Times of sharp edges.
  std::vector<double> breaks() const;

 private:
  struct Sine {
    double amplitude, omega, phase;
  };
  /// The level changes by `height` from `time` on, within `rise`.
  struct Edge {
    double time, level, height;
  };

  static double sum_of(const std::vector<Sine>& sines, double t);
  void draw_sines(const SignalSpec& spec, Random& random);
  void draw_edges(const SignalSpec& spec, double begin, double end, Random& random);
  void draw_samples(const SignalSpec& spec, double begin, double end, Random& random);
  void draw_switches(const SignalSpec& spec, double begin, double end, Random& random);
  void go_to(double time, double level);

  double base_ = 0.0;
  double rise_ = 1.0;  ///< 0: sharp
  std::vector<Sine> sines_;
  std::vector<Edge> edges_;
};

}  // namespace lacuna::hidden
