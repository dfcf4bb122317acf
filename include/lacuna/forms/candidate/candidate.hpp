// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "lacuna/core/base/types.hpp"
#include "lacuna/model/expressions/expression.hpp"

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
  Expression rate;   ///< in variables, shape parameters and memory states
  Expression start;  ///< in variables and shape parameters, at the record's first sample
  /// It is moved by white noise besides, as the records require: a free input. The coefficient
  /// in front of the form is 1 then and is not fitted.
  bool driven = false;
};

/// Where a candidate's form is added.
enum class Place {
  Rate,     ///< to the rate of change of a state: the system has this effect
  Channel,  ///< to the measured value of a state: the measurement has it
};

/// One concrete thing that may be missing: coefficient x form in one equation. It has no name:
/// what it is called depends on the numbers that it gets (see NameTable).
///
/// The form is an expression in states, inputs, `t`, the names of the shape parameters and of
/// the memory states: tanh(w/width), max(x-edge,0), delay(x,T)-x,
/// sin(2*pi*frequency*t+phase). The coefficient in front of it is free and is never written.
struct Candidate {
  Expression form = {};
  Expression argument = {};  ///< what the form is a function of: w, x1-x2, t
  /// The term in which the argument is one factor of several, where only that factor is meant:
  /// x*z for a delay of x that leaves z as it is.
  std::optional<Expression> within = {};
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
  /// Registered names of the effects that propose it, by which the search shares its efforts
  /// among kinds of forms; none for a term that nobody proposes.
  std::vector<std::string> families = {};

  bool is_driven() const;  ///< whether it has a memory state that is

  /// Whether the form or the rate of a memory state is a function of a variable.
  bool depends_on(const std::string& variable) const;

  /// What makes it less plain: its shape parameters, and its memory states twice.
  Index intricacy() const;
};

/// Whether every shape has a range at all. Records that hardly move along an argument (two
/// levels, one value), or whose values are beyond doubles, leave none: there is nothing to find
/// of the form.
bool has_ranges(const Candidate& candidate);

/// A formula of the candidate with numbers in place of its shape parameters.
/// @param formula the form, or a memory state's rate or start.
/// @throws ArgumentError when the number of values is not the number of shapes; ModelError for
///   a delay that is negative.
Expression bind_formula(const Candidate& candidate, const Expression& formula,
                        std::span<const double> values);

/// bind_formula() of the form itself, with one value per shape parameter.
Expression bind_form(const Candidate& candidate, std::span<const double> values);

/// The candidate with other names for those of its memory states whose names are taken already.
Candidate without_clash(Candidate candidate, const std::vector<std::string>& taken);

/// Whether two candidates are functions of one argument in one place.
bool in_one_place(const Candidate& a, const Candidate& b);

/// Whether two candidates are one but for the names of their shape parameters and memory
/// states, for ranges, starting points and bounds.
bool are_one_form(const Candidate& a, const Candidate& b);

/// The candidates with those that are one form made one: it has the union of their ranges and
/// bounds and all starting points, so that a form is searched and fitted once, whoever proposes
/// it. The order is that of the first of each.
std::vector<Candidate> merged(const std::vector<Candidate>& candidates);

}  // namespace lacuna
