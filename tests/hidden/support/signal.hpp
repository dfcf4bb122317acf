// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "lacuna/core/random.hpp"

namespace lacuna::hidden {

/// What drives a plant.
struct SignalSpec {
  enum class Shape {
    Multisine,  ///< equal sines of random phase, one in each of `lines` bands of [low, high]
    Steps,      ///< levels held for 1/high .. 1/low, with smooth edges
  };
  Shape shape = Shape::Multisine;
  double mean = 0.0;
  double size = 1.0;  ///< standard deviation about the mean
  double low = 0.1;   ///< cycles per time unit
  double high = 1.0;
  int lines = 12;
};

/// A smooth random function of time: the same specification and seed give the same one.
class Signal {
 public:
  /// @param begin, end the times it is asked for; outside them a step signal holds its level.
  Signal(const SignalSpec& spec, double begin, double end, std::uint64_t seed);

  double operator()(double t) const;

 private:
  struct Sine {
    double amplitude, omega, phase;
  };
  /// The level changes by `height` from `time` on, within `rise`.
  struct Edge {
    double time, level, height;
  };

  void draw_sines(const SignalSpec& spec, Random& random);
  void draw_edges(const SignalSpec& spec, double begin, double end, Random& random);

  double base_ = 0.0;
  double rise_ = 1.0;
  std::vector<Sine> sines_;
  std::vector<Edge> edges_;
};

}  // namespace lacuna::hidden
