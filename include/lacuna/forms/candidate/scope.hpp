// SPDX-License-Identifier: MIT
// Numbers that are not finite make numbers that are not finite.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "lacuna/core/base/types.hpp"
#include "lacuna/data/records/dataset.hpp"
#include "lacuna/model/equations/ode_model.hpp"

namespace lacuna {

/// A line in the spectrum of the residual of a model in an equation.
struct SpectralLine {
  Index equation = 0;
  double frequency = 0.0;  ///< per time unit
  double phase = 0.0;      ///< of sin(2 pi frequency t + phase), rad
};

/// A line in the spectrum of the product of that residual and a term of the equation: where the
/// coefficient of the term may swing.
struct ModulationLine {
  SpectralLine line;
  Expression term;
};

/// A fact: what comes again less often within a range, or in time, is a curve.
inline constexpr double kFewestPeriods = 2.0;

/// A period in the value of a position in which the residual of the equation of its velocity comes
/// again: teeth, poles, a grating along the way.
struct Ripple {
  Index equation = 0;
  Index position = 0;   ///< number of the state
  double period = 0.0;  ///< unit of the position
};

/// How one variable (or a formula of variables) is spread over the records.
struct VariableRange {
  std::string name;
  std::string unit;
  bool is_input = false;
  double low = 0.0, high = 0.0;  ///< smallest and largest value
  double mean = 0.0;
  double deviation = 0.0;  ///< standard deviation
  Vector quantiles = {};   ///< 0 %, 0.5 %, ..., 100 %: 201 values
  double noise = 0.0;      ///< standard deviation of the measurement noise
  /// How long it remembers: the first lag at which its autocorrelation is below 1/2, in the
  /// longest record; at least one step. 0 where it is not known (range_of()).
  double timescale = 0.0;
  /// A mean period, as far as memory says: six of those of that record, or of one of its halves
  /// that moves and in which the motion comes back. 0 where it is not known.
  double period = 0.0;

  /// Largest absolute value.
  double magnitude() const { return std::max(std::abs(low), std::abs(high)); }

  /// Whether it takes both signs beyond its noise: a velocity, a voltage.
  bool changes_sign() const { return low < -4.0 * noise && high > 4.0 * noise; }

  /// Whether it is an amount that is never negative but for noise, which may take it below 0
  /// often where it is used up: a level, a concentration.
  bool is_amount() const { return low >= -5.0 * noise && high > 0.0 && high > -5.0 * low; }

  /// The value below which the fraction `level` (0..1) of the samples lies, interpolated.
  double quantile(double level) const;
};

/// What an effect may look at when it makes its candidates: the nominal model and how the
/// records are spread, never the residual itself.
struct Scope {
  OdeModel model;
  std::vector<VariableRange> variables;  ///< states, then inputs, in the model's order
  double step = 0.0;                     ///< time between samples
  double start = 0.0;                    ///< first time
  double duration = 0.0;                 ///< of the longest record
  std::vector<SpectralLine> lines;       ///< strongest first; starts for periodic effects
  std::vector<ModulationLine> modulations = {};  ///< strongest first; starts for coefficients
  std::vector<Ripple> ripples = {};              ///< at most one for each velocity
  /// rows x (m+p+1+d): some samples of the variables and t in slot order, then of the delayed
  /// variables that the model has, as delayed_slots() has them.
  Matrix samples = {};

  /// The range of a state. @throws ArgumentError when there is none.
  const VariableRange& state(Index number) const;

  /// How an expression is spread: a variable as it is described above, a formula of variables
  /// with its quantiles, mean and deviation only.
  /// @throws ModelError when it has other names, or delays that the model does not have.
  VariableRange range_of(const Expression& expression) const;

  /// The name itself, or with underscores behind it where the model has a variable of that
  /// name.
  std::string free_name(std::string name) const;

  /// Whether the equation is an identity, dx/dt = v with v another state (coefficient 1).
  bool is_identity(Index equation) const;

  /// The state whose rate of change is the given state by an identity (x for v when dx/dt = v).
  std::optional<Index> integral_of(Index state) const;
};

/// The scope of a model and its records.
/// @param noise standard deviation of the measurement noise, m entries.
/// @param lines see Scope::lines.
/// @throws ArgumentError when the records' states or inputs are not those of the model.
/// @throws ArgumentError when names do not fit, or noise is not one number per state; DataError
///   as check_dataset().
Scope make_scope(const OdeModel& model, const Dataset& data, const Vector& noise,
                 std::vector<SpectralLine> lines = {});

}  // namespace lacuna
