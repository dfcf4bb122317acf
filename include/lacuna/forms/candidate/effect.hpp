// SPDX-License-Identifier: MIT
// Candidates, what they look at, how they are read, and the effects that propose them.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "lacuna/core/base/options.hpp"
#include "lacuna/core/base/types.hpp"
#include "lacuna/data/records/dataset.hpp"
#include "lacuna/model/equations/ode_model.hpp"
#include "lacuna/model/expressions/expression.hpp"

namespace lacuna {

/// A parameter inside a candidate's form that is not a plain factor in front of it.
struct ShapeParameter {
  std::string name;          ///< identifier used in the form; no variable of the model: "width"
  std::string unit;          ///< "rad/s"; empty when it is not known or a pure number
  double low = 0.0;          ///< smallest value that makes sense
  double high = 0.0;         ///< largest value that makes sense, >= low
  bool logarithmic = false;  ///< searched on a logarithmic scale (low > 0)
  /// Whether the form with the smallest value is as good as a plainer one in any record (a bend
  /// that is a jump): that end is no bound of what makes sense.
  bool plain_at_low = false;
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

/// A period in the value of a position in which the residual of the equation of its velocity
/// comes again: teeth, poles, a grating along the way.
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

/// What decides between the names of one form.
struct NamingOptions {
  double equal_slopes = 0.2;  ///< see describe()
  double standard_errors = 3.0;
  double standstill = 0.1;
  double rim = 0.6;

  void describe(OptionVisitor& v) {
    v.field({"equal_slopes", "",
             "Slopes that differ by no more than this fraction of the larger one are equal: "
             "the rest of a slope inside a dead zone or beyond a limit.",
             0.0, 1.0},
            equal_slopes);
    v.field(
        {"standard_errors", "",
         "Slopes that differ by no more than so many standard errors are equal.", 0.0, 10.0},
        standard_errors);
    v.field({"standstill", "",
             "A bend below this fraction of the largest speed is as good as a jump.", 0.0, 1.0},
            standstill);
    v.field({"rim", "",
             "Quantile of a variable from which on (and from 1 less it down) what acts on one "
             "side of an edge is a stop; between the two it is a bend.",
             0.5, 1.0},
            rim);
  }
};

/// A candidate with what the data show of it, and where it stands.
struct FittedForm {
  const Candidate& candidate;
  const Vector& shapes;      ///< one value per shape parameter
  double coefficient = 0.0;  ///< of the form
  double deviation = 0.0;    ///< its standard error
  const OdeModel& nominal;   ///< with its coefficients fitted together with the candidate
  const Scope& scope;
  const NamingOptions& options;
};

/// How a name comes to a form; the first goes before the others.
enum class Precedence {
  Contextual,  ///< the place says it: the cube of a position in the equation of its velocity
  Plain,       ///< the default word for the form
  Special,     ///< the same numbers in a reading as good as the plain one
};

/// What a row of the name table makes of a fitted form to which it applies.
struct Reading {
  std::string sentence;  ///< for people: "dry friction opposing w"
  Precedence precedence = Precedence::Plain;
  /// What the effect calls the shape parameters, in order; as the candidate does when empty.
  std::vector<std::string> parameters = {};
};

/// Plug point: a named family of effects that a nominal model may lack.
///
/// It gives two things: the forms that the search should try, nameless, for every state, input,
/// pair of them and term of the nominal model for which they make sense; and a row of the name
/// table, which says of a fitted form, whoever proposed it, whether it is this effect. The
/// registered name (`info().name`) is the word by which the answer calls the effect, from the
/// vocabulary of the diagnosis; `info().summary` is the sentence of `lacuna list`. An effect
/// sees no residual, only the scope, and knows of no other effect.
class Effect : public StageInterface {
 public:
  static constexpr std::string_view kKind = "effect";

  /// What usually causes it in a real system: "bearings, seals, brushes".
  std::string_view typical_cause() const { return do_typical_cause(); }

  /// The candidates for one equation, each with this effect among its families, the equation,
  /// starting points inside the ranges of its shape parameters (one empty point when it has
  /// none), distinct in their forms. The list may be empty; forms of whose shapes the records
  /// leave no range (an input of two levels has no limit to be found) are not in it. Shape
  /// parameters and memory states get names that no variable of the model has
  /// (Scope::free_name()).
  /// @throws ArgumentError when there is no such equation; ModelError when a form uses a name
  ///   that is neither a variable nor one of its parameters.
  std::vector<Candidate> candidates(const Scope& scope, Index equation) const;

  /// What a fitted form is by this effect's row of the name table; nothing where it is not this
  /// effect, or has numbers that this effect cannot have: dry friction opposes the motion.
  /// @throws ArgumentError when the number of shapes is not that of the candidate.
  std::optional<Reading> reading(const FittedForm& fitted) const;

 protected:
  /// By default what the effect itself proposes is this effect, whatever the numbers.
  virtual std::optional<Reading> do_reading(const FittedForm& fitted) const;

 private:
  virtual std::string_view do_typical_cause() const = 0;
  /// Candidates without family and equation filled in; `starts` may be left empty for a
  /// candidate without shape parameters.
  virtual std::vector<Candidate> do_candidates(const Scope& scope, Index equation) const = 0;
};

/// Options of an effect that has none: `EffectOptions<kName>` with
/// `inline constexpr StageInfo kName{"coulomb-friction", "...", "..."}`.
template <const StageInfo& Info>
struct EffectOptions {
  static constexpr const StageInfo& kInfo = Info;
  void describe(OptionVisitor&) {}
};

}  // namespace lacuna
