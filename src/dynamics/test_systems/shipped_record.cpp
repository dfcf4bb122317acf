// SPDX-License-Identifier: MIT
#include "dynamics/test_systems/shipped_record.hpp"

#include <cmath>

#include "dynamics/integration/runge_kutta.hpp"
#include "lacuna/dynamics/test_systems/test_systems.hpp"

namespace lacuna {
namespace {

// The record as it was made.
constexpr Index kSamples = 10000;
constexpr double kSamplesPerTau = 10.0;
constexpr Index kTransient = 2000;  // samples left out in front

void round_to_grid(Vector& x) {
  // By definition: samples have 24 bits behind the point.
  constexpr double kGrid = 0x1p24;
  x = (x * kGrid).array().round() / kGrid;
}

Trajectory orbit_of(const TestSystem& system) {
  CompiledModel model = system.model.compile();
  const auto rhs = [&model](double t, const double* x, double* dxdt) {
    model.evaluate(t, x, nullptr, nullptr, dxdt);
  };
  const auto stepper = Dopri8({.substeps = 4}).make_stepper(3);
  Trajectory orbit{"tl072", Vector(kSamples), Matrix(kSamples, 3), Matrix(kSamples, 0),
                   Matrix()};
  Vector x = system.start;
  for (Index i = -kTransient; i < kSamples; ++i) {
    round_to_grid(x);
    if (i >= 0) {
      orbit.time[i] = static_cast<double>(i) / kSamplesPerTau;
      orbit.states.row(i) = x.transpose();
    }
    double t = 0.0;
    stepper->advance(rhs, t, 1.0 / kSamplesPerTau, x.data());
  }
  return orbit;
}

}  // namespace

Dataset tl072_record() {
  constexpr std::uint64_t kSeed = 20230220;
  const TestSystem& system = test_system("tl072");
  Dataset record;
  record.time_unit = system.model.time_unit();
  record.states = system.model.states();
  record.trajectories.push_back(orbit_of(system));
  return quantise(add_noise(record, Vector::Constant(3, 1e-3), kSeed), 16, 10.0);
}

std::string tl072_record_comment() {
  return "Synthetic record of the Rossler circuit with TL072 amplifiers (test system "
         "'tl072').\n"
         "h = 0.1 tau, tau = 0.1 ms; 1 mV noise, seed 20230220; 16-bit converter over +-10 V.";
}

}  // namespace lacuna
