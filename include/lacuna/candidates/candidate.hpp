// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "lacuna/core/types.hpp"
#include "lacuna/model/expression.hpp"

namespace lacuna {

/// A parameter inside a candidate's form that is not a plain factor in front of it.
struct ShapeParameter {
  std::string name;          ///< identifier used in the form; no variable of the model: "width"
  std::string unit;          ///< "rad/s"; empty when it is not known or a pure number
  double low = 0.0;          ///< smallest value that makes sense
  double high = 0.0;         ///< largest value that makes sense, >= low
  bool logarithmic = false;  ///< searched on a logarithmic scale (low > 0)
};

/// A state of the effect's own that is not measured: d(name)/dt = rate, started at `start`.
/// It is computed along the record, with the measured states and inputs as its inputs; the form
/// may use it by its name. A lag, a play, a hysteresis loop are made of these.
struct MemoryState {
  std::string name;  ///< identifier, no variable of the model
  std::string rate;  ///< formula in variables, shape parameters and memory states
  std::string
      start;  ///< formula in variables and shape parameters, at the record's first sample
  /// It is moved by white noise besides, as the records ask for: a free input. The coefficient
  /// in front of the form is 1 then and is not fitted.
  bool driven = false;
};

/// Where a candidate's form is added.
enum class Place {
  Rate,     ///< to the rate of change of a state: the system has this effect
  Channel,  ///< to the measured value of a state: the measurement has it
};

/// One concrete thing that may be missing: coefficient x form in one equation.
///
/// The form is a formula of the model file's language in states, inputs, `t`, the names of the
/// shape parameters and of the memory states: "tanh(w/width)", "max(x-edge,0)", "delay(x,T)-x",
/// "sin(2*pi*frequency*t+phase)". The coefficient in front of it is free and is never written.
/// An effect may write `$width` for a shape parameter or memory state it calls `width`; it then
/// gets a name that no variable of the model has.
struct Candidate {
  std::string effect = {};  ///< registered name of the effect
  /// Name that leads where the data cannot tell the two apart; by default Effect::plainer().
  std::optional<std::string> plainer = {};
  std::string argument = {};     ///< what the form is a function of: "w", "x1-x2", "x*z", "t"
  std::string description = {};  ///< for people: "dry friction opposing w"
  std::string form = {};
  std::vector<ShapeParameter> shapes = {};
  std::vector<Vector> starts = {};  ///< starting points of the search, one entry per shape each
  std::vector<MemoryState> memory = {};
  Place place = Place::Rate;
  Index equation = 0;  ///< whose equation, or whose measured value
  /// Least and largest coefficient that make sense: no more than the whole of a term can lag.
  double least = -std::numeric_limits<double>::infinity();
  double most = std::numeric_limits<double>::infinity();
  /// It may stand in an equation more than once with other shapes: a second tone.
  bool repeats = false;

  bool is_driven() const;  ///< whether it has a memory state that is
};

/// A formula of the candidate with numbers in place of its shape parameters.
/// @param text the form, or a memory state's rate or start.
/// @throws ArgumentError when the number of values is not the number of shapes; ModelError when
///   the formula cannot be read.
Expression bind_formula(const Candidate& candidate, const std::string& text,
                        std::span<const double> values);

/// The candidate with other names for those of its memory states whose names are taken already.
Candidate without_clash(Candidate candidate, const std::vector<std::string>& taken);

/// bind_formula() of the form itself.
Expression bind_form(const Candidate& candidate, std::span<const double> values);

}  // namespace lacuna
