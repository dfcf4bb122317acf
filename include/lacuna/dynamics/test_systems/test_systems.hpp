// SPDX-License-Identifier: MIT
// Known systems, and records made of them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "lacuna/data/records/dataset.hpp"
#include "lacuna/dynamics/integration/integrator.hpp"
#include "lacuna/model/equations/ode_model.hpp"

namespace lacuna {

/// A known system to try methods on.
struct TestSystem {
  std::string name;       ///< "rossler", "lorenz", ...
  std::string summary;    ///< one sentence
  std::string reference;  ///< where equations and parameters come from
  OdeModel model;
  Vector start;       ///< a state on or near the attractor
  double step = 0.0;  ///< a usual sampling step
};

/// All systems, in alphabetical order of their names.
const std::vector<TestSystem>& test_systems();

/// @throws ConfigError with the nearest name when there is no such system.
const TestSystem& test_system(const std::string& name);

/// A noise-free record of a model: n samples at t = 0, h, 2h, ... from x0, one trajectory, with
/// dx/dt of the model at the samples.
/// @throws ArgumentError when the orbit diverges (the message says where) and as simulate().
Dataset record_of(const OdeModel& model, const Integrator& integrator, const Vector& x0,
                  double h, Index n);

/// The record with white Gaussian noise of standard deviation sigma_i (unit of the state) added
/// to each state. Derivatives that came with the record are dropped: they are not measured.
/// @throws ArgumentError when sigma does not have one entry >= 0 per state.
/// @throws ArgumentError unless there is one finite sigma >= 0 per state; the same below.
Dataset add_noise(const Dataset& record, const Vector& sigma, std::uint64_t seed);

/// What noise does to derivatives that came with a record.
enum class NoisyRates {
  Dropped,  ///< they are not measured
  Kept,     ///< they get noise of their own, record by record
};

/// The same relative noise on all states: sigma_i = fraction times the standard deviation of
/// state i; with derivatives that are kept, of each record by itself.
/// @throws ArgumentError when the fraction is negative or not finite; DataError as
/// check_form(),
///   where derivatives are kept.
Dataset add_relative_noise(const Dataset& record, double fraction, std::uint64_t seed,
                           NoisyRates rates = NoisyRates::Dropped);

/// The states as an analogue-digital converter gives them: the nearest of 2^bits levels
/// k 2 range / 2^bits, k = -2^(bits-1) .. 2^(bits-1) - 1, clipped at the ends.
/// Derivatives that came with the record are dropped.
/// @throws ArgumentError when bits is not in 1..32 or range is not positive.
Dataset quantise(const Dataset& record, int bits, double range);

}  // namespace lacuna
