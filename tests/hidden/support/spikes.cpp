// SPDX-License-Identifier: MIT
#include "hidden/support/spikes.hpp"

#include <cmath>
#include <cstdint>

#include "hidden/support/records.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/dynamics/test_systems/test_systems.hpp"
#include "lacuna/model/files/model_file.hpp"

namespace lacuna::hidden {
namespace {

Plant plant_of(const std::string& name) {
  const SignalSpec drive{SignalSpec::Shape::Multisine, 0.0, 1.0, 0.05, 0.6, 8};
  if (name == "lag")
    return {parse_ode("input u\ndw/dt = -w + u\n", name),
            Vector::Zero(1),
            Vector::Zero(1),
            0.05,
            400,
            5.0,
            {drive}};
  if (name == "mass")
    return {parse_ode("input u\ndx/dt = v\ndv/dt = -4*x - 0.4*v + u\n", name),
            Vector::Zero(2),
            Vector::Zero(2),
            0.05,
            400,
            5.0,
            {drive}};
  if (name == "tank")
    return {parse_ode("input u\ndh/dt = -0.5*sqrt(h) + 0.3*u\n", name),
            Vector::Constant(1, 4.0),
            Vector::Zero(1),
            0.1,
            400,
            5.0,
            {{SignalSpec::Shape::Multisine, 3.0, 0.8, 0.02, 0.2, 8}}};
  if (name == "wave")
    return {parse_ode("dx/dt = y\ndy/dt = -x + y - x^2*y\n", name),
            Vector::Ones(2),
            Vector::Zero(2),
            0.08,
            400,
            20.0,
            {}};
  throw ArgumentError("spikes", "there is no model '" + name + "'", "take one of the list");
}

}  // namespace

std::vector<SpikeCase> spike_cases() {
  return {
      {"lag, first sample", "lag", 0, {0}, 2.0},
      {"lag, second sample", "lag", 0, {1}, 2.0},
      {"lag, middle", "lag", 0, {150}, 2.0},
      {"lag, middle, small", "lag", 0, {151}, 0.04},
      {"lag, middle, barely seen", "lag", 0, {97}, 0.025},
      {"lag, middle, huge", "lag", 0, {120}, 300.0},
      {"lag, last but one used", "lag", 0, {298}, 2.0},
      {"lag, last used", "lag", 0, {299}, 2.0},
      {"lag, last used, huge", "lag", 0, {299}, -100.0},
      {"lag, last used, small", "lag", 0, {299}, 0.05},
      {"lag, first checked", "lag", 0, {300}, 2.0},
      {"lag, last checked", "lag", 0, {399}, -2.0},
      {"lag, two together", "lag", 0, {200, 201}, 1.5},
      {"lag, three together", "lag", 0, {100, 101, 102}, 1.0},
      {"lag, two together, other signs", "lag", 0, {200, 201}, 1.5, 0.005, true},
      {"lag, two at the end", "lag", 0, {298, 299}, 1.0},
      {"lag, no noise", "lag", 0, {150}, 1.0, 0.0},
      {"lag, no noise, last used", "lag", 0, {299}, 1.0, 0.0},
      {"lag, much noise", "lag", 0, {60}, 1.5, 0.05},
      {"lag, used and checked", "lag", 0, {30, 330}, 3.0},
      {"mass, position", "mass", 0, {77}, 2.0},
      {"mass, speed", "mass", 1, {222}, -2.0},
      {"mass, position, last used", "mass", 0, {299}, 1.0},
      {"mass, speed, last used", "mass", 1, {299}, 1.0},
      {"mass, speed, first sample", "mass", 1, {0}, 5.0},
      {"mass, position, two together", "mass", 0, {140, 141}, 1.0},
      {"mass, speed, no noise", "mass", 1, {140}, 1.0, 0.0},
      {"tank, middle", "tank", 0, {180}, -0.5},
      {"tank, last used", "tank", 0, {299}, 3.0},
      {"tank, three together", "tank", 0, {150, 151, 152}, 1.0},
      {"wave, at a turn", "wave", 0, {110}, 1.0},
      {"wave, speed, last used", "wave", 1, {299}, -1.0},
      {"wave, speed, small", "wave", 1, {44}, 0.06},
      {"wave, two together", "wave", 0, {250, 251}, 0.7},
  };
}

OdeModel spike_model(const std::string& name) { return plant_of(name).model; }

Dataset spike_record(const SpikeCase& one, std::uint64_t seed) {
  const Plant plant = plant_of(one.model);
  Dataset record = clean_record(
      {one.name, "", Kind::Nothing, plant.model, plant, {}, {}, {}, NoiseKind::White, {}},
      seed);
  const auto clean = record.trajectories.front().states.col(one.state);
  const double deviation = std::sqrt((clean.array() - clean.mean()).square().mean());
  if (one.noise > 0.0) record = add_relative_noise(record, one.noise, seed);
  double size = one.size * deviation;
  for (const Index i : one.at) {
    record.trajectories.front().states(i, one.state) += size;
    if (one.alternates) size = -size;
  }
  return record;
}

}  // namespace lacuna::hidden
