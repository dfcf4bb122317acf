// SPDX-License-Identifier: MIT
// Models: equations of terms, events, laws of noise.
#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "lacuna/core/base/types.hpp"
#include "lacuna/data/records/dataset.hpp"
#include "lacuna/model/equations/term.hpp"
#include "lacuna/model/expressions/expression.hpp"

namespace lacuna {

/// What becomes of one state at an event.
struct Reset {
  std::string state;
  Expression value = {};  ///< behind the event, of what is just before it

  bool operator==(const Reset&) const = default;
};

/// An instant at which states jump: at a time, at equal distances of time, or where a quantity
/// rises through 0. All resets of one event see the states before it.
struct Event {
  std::optional<double> time = {};       ///< of the first one; nothing: where `guard` rises
  std::optional<double> period = {};     ///< > 0, to the next one; nothing: there is one
  std::optional<double> last = {};       ///< none comes behind this time
  std::optional<Expression> guard = {};  ///< happens where it rises through 0
  std::vector<Reset> resets = {};

  bool operator==(const Event&) const = default;
};

/// One happening of a timed event.
struct Occurrence {
  double time = 0.0;
  std::size_t event = 0;  ///< its number
};

/// What timed events do in [begin, end], by time; those of one time in the order of the events.
/// @throws ModelError for more than a million of them.
std::vector<Occurrence> occurrences(const std::vector<Event>& events, double begin, double end);

/// The events with formulas in the place of names, as substitute().
std::vector<Event> substituted(std::vector<Event> events,
                               const std::map<std::string, Expression>& replacements);

/// What is in front of the resets: "at 4", "every 12 from 0 until 96", "when x > c".
std::string occasion_text(const Event& event);

/// A reset as it is written: "x += D", "v = -0.9*v".
std::string to_text(const Reset& reset);

/// How measured values are spread about the value y of the model. Numbers a and b are > 0.
enum class NoiseForm {
  Constant,      ///< normal, deviation a
  Proportional,  ///< normal, deviation b |y|
  Both,          ///< normal, deviation sqrt(a^2 + b^2 y^2)
  LogNormal,     ///< the logarithm is normal about log y, deviation b
  Poisson,       ///< as of counts: normal, variance a y
  Student        ///< y + a times Student's distribution: rare large errors
};

/// The law of the noise of an output.
struct NoiseLaw {
  NoiseForm form = NoiseForm::Constant;
  std::optional<double> constant = {};  ///< a where it is known; nothing: it is estimated
  std::optional<double> fraction = {};  ///< b where it is known; nothing: it is estimated
  double freedom = 4.0;                 ///< degrees of freedom of Student's distribution, > 2
  /// Limit of quantification, in the unit of the output: a value at it or below says that the
  /// measured one was not above it.
  std::optional<double> below = {};
  std::optional<double> above = {};  ///< the same at the other end: values are clipped there
  /// Values beyond the limits are never recorded, in the place of being known to lie there: the
  /// density of a value is that of the law over the probability of what is between the limits.
  bool truncated = false;

  bool operator==(const NoiseLaw&) const = default;
};

/// "constant", "proportional", "both", "lognormal", "poisson", "student".
std::string to_string(NoiseForm form);

/// The law of such a name; nothing for another word.
std::optional<NoiseForm> noise_form_named(const std::string& name);

/// Whether the law has a number a.
bool has_constant(NoiseForm form);

/// Whether the law has a number b.
bool has_fraction(NoiseForm form);

/// What is wrong with a law; empty where nothing is.
std::string law_problem(const NoiseLaw& law);

/// As it is written behind an output: "noise both 0.1 0.05 below 0.2".
std::string to_text(const NoiseLaw& law);

/// One summand of an equation: coefficient times term.
struct WeightedTerm {
  Term term;
  double coefficient = 0.0;  ///< state unit per time unit and unit of the term, unscaled
  std::optional<double> standard_error = {};
  std::optional<std::array<double, 2>> ci95 = {};  ///< 95 % confidence interval, low and high
  bool fixed = false;                              ///< known: not to be estimated
};

/// The right-hand side of one state: dx_k/dt = sum_i c_i tau_i, or x_k[n+1] of a map.
using Equation = std::vector<WeightedTerm>;

/// What the equations of a model give.
enum class Evolution {
  Flow,  ///< dx/dt = f(t, x, u)
  Map,   ///< x[n+1] = f(t[n], x[n], u[n]): the next sample, in state units
};

/// A channel that is measured as a formula: y = h(t, x, u).
struct Output {
  std::string name;  ///< of the column; an identifier
  std::string unit;
  Expression formula;
  std::optional<NoiseLaw> noise = {};  ///< nothing: normal, one deviation that is estimated
};

/// What is known of a state where records begin.
struct InitialValue {
  double value = 0.0;                    ///< to start from
  bool fixed = false;                    ///< known exactly
  std::optional<double> deviation = {};  ///< one standard deviation, > 0; nothing: not known
  /// The time at which it holds, the same for all states that have one; nothing: that of the
  /// first sample of each record.
  std::optional<double> time = {};
};

class CompiledModel;

/// A system of ordinary differential equations dx/dt = f(t, x, u), or a map
/// x[n+1] = f(t[n], x[n], u[n]), with what is known of its outputs and its start: a value.
class OdeModel {
 public:
  /// Terms get their canonical names in this model's variables.
  /// @throws ModelError when there is no state, when names repeat, are not identifiers or are
  ///   words of the formula language, when the number of equations is not the number of states,
  ///   when a term stands twice in an equation or uses an unknown name, or when a coefficient
  ///   is not finite.
  OdeModel(std::vector<Quantity> states, std::vector<Quantity> inputs,
           std::vector<Equation> equations, std::string time_unit = "s");

  const std::vector<Quantity>& states() const noexcept { return states_; }        ///< m
  const std::vector<Quantity>& inputs() const noexcept { return inputs_; }        ///< p
  const std::vector<Equation>& equations() const noexcept { return equations_; }  ///< m
  const std::string& time_unit() const noexcept { return time_unit_; }  ///< "s", "1" for none
  Index dimension() const noexcept { return static_cast<Index>(states_.size()); }  ///< m
  Evolution evolution() const noexcept { return evolution_; }            ///< flow or map
  bool is_map() const noexcept { return evolution_ == Evolution::Map; }  ///< or a flow

  /// Channels that are measured as formulas; a column with the name of a state measures it.
  const std::vector<Output>& outputs() const noexcept { return outputs_; }

  /// What is known of the start, one entry for each state.
  const std::vector<std::optional<InitialValue>>& initial() const noexcept { return initial_; }

  /// Instants at which states jump.
  const std::vector<Event>& events() const noexcept { return events_; }

  /// Names in slot order.
  Variables variables() const;

  /// Number of a state. @throws ModelError listing the states when there is none of that name.
  Index state_index(const std::string& name) const;

  /// Coefficient of a term (by canonical name) in an equation; 0 when it is not there.
  /// @throws ArgumentError when there is no such equation.
  double coefficient(Index equation, const std::string& term) const;

  /// The model with one more summand; a term that is there already gets the sum, and keeps no
  /// error and no interval, which the sum does not have.
  /// @throws ArgumentError when there is no such equation; ModelError as the constructor.
  OdeModel with_term(Index equation, WeightedTerm summand) const;

  /// The model with inputs that go on so between samples, in their order; nothing: not known.
  /// @throws ArgumentError when there are not as many as inputs.
  OdeModel with_holds(const std::vector<std::optional<Hold>>& holds) const;

  /// The model with these outputs.
  /// @throws ModelError for a name that is no identifier or is taken (a state may be called as
  ///   the output that is just it), for an unknown name in a formula and for a delay.
  OdeModel with_outputs(std::vector<Output> outputs) const;

  /// The model with this start. @throws ArgumentError when there are not as many entries as
  /// states; ModelError for a value that is not finite, a deviation that is not above 0, and
  /// times that are not one.
  OdeModel with_initial(std::vector<std::optional<InitialValue>> initial) const;

  /// The time at which the start holds; nothing: that of the first sample of each record.
  std::optional<double> initial_time() const;

  /// The model with these events; resets of an event get the order of the states.
  /// @throws ModelError for a map, for a model with delays, for an event without a reset or with
  ///   two of one state, for an unknown name, and for times that are none.
  OdeModel with_events(std::vector<Event> events) const;

  /// The model with other equations. @throws ModelError as the constructor.
  OdeModel with_equations(std::vector<Equation> equations) const;

  /// The model with the same right-hand sides as a flow or as a map.
  /// @throws ModelError for a map with a delay: an earlier sample is a state of its own.
  OdeModel with_evolution(Evolution evolution) const;

  /// A flat evaluator of f and of its Jacobian.
  CompiledModel compile() const;

 private:
  std::vector<Quantity> states_;
  std::vector<Quantity> inputs_;
  std::vector<Equation> equations_;
  std::string time_unit_;
  std::vector<Output> outputs_;
  std::vector<std::optional<InitialValue>> initial_;
  std::vector<Event> events_;
  Evolution evolution_ = Evolution::Flow;
};

/// Says that a task needs a flow. @param task as in "diagnose".
/// @throws ModelError when the model is a map.
void check_flow(const OdeModel& model, const std::string& task);

/// Says that a task knows no events. @param task as in "diagnose".
/// @throws ModelError when the model has some.
void check_no_events(const OdeModel& model, const std::string& task);

/// What an equation gives: "dx/dt" or "x[n+1]".
std::string left_hand_side(const std::string& state, Evolution evolution);

/// That of every state.
std::vector<std::string> left_hand_sides(const std::vector<std::string>& states,
                                         Evolution evolution);

/// Evaluates f(t, x, u) and its Jacobian without allocation (the Jacobian is compiled by its
/// first use). Cheap to copy; one per thread.
class CompiledModel {
 public:
  explicit CompiledModel(const OdeModel& model);  ///< as OdeModel::compile()

  Index dimension() const noexcept { return dimension_; }  ///< m
  Index inputs() const noexcept { return input_count_; }   ///< p

  /// Delayed variables whose values evaluate() needs, in order.
  const std::vector<DelayedVariable>& delays() const noexcept { return rate_.program.delays(); }

  /// Writes dx/dt, of a map the next state (m entries).
  /// @param x m states; @param u p inputs (may be null when p is 0);
  /// @param delayed values of delays() (may be null when there are none).
  void evaluate(double t, const double* x, const double* u, const double* delayed,
                double* dxdt);

  /// Writes df_k/dx_j (m x m). Arguments as in evaluate(). Delayed variables are held fixed.
  /// @throws ArgumentError when the matrix is not m x m.
  void jacobian(double t, const double* x, const double* u, const double* delayed,
                Eigen::Ref<Matrix> derivative);

 private:
  friend class SumBuilder;

  /// Sums of coefficient times value: entries [rows[r-1].end, rows[r].end) go to
  /// rows[r].target.
  struct Sums {
    struct Entry {
      double coefficient;
      std::size_t value;
    };
    struct Row {
      std::size_t target, end;
    };
    Program program;
    std::vector<Entry> entries;
    std::vector<Row> rows;
    std::vector<double> values;
  };

  static Sums compile_rate(const OdeModel& model);
  static Sums compile_jacobian(const OdeModel& model);
  void fill_slots(double t, const double* x, const double* u);
  void fill_delays(const Program& program, const double* delayed);
  template <class Put>
  void add_up(Sums& sums, Put put);

  Index dimension_ = 0;
  Index input_count_ = 0;
  Sums rate_;
  std::optional<Sums> jacobian_;
  std::shared_ptr<const OdeModel> model_;
  std::vector<double> slots_;
  Program::Workspace workspace_;
};

/// The state v of an identity dx/dt = v: the equation is another state alone, with the
/// coefficient 1; nothing where it is none. dx/dt = x is growth, not an identity.
std::optional<Index> identity_of(const OdeModel& model, Index equation);

/// The state that an output is, where its formula is a state alone.
std::optional<Index> state_of(const OdeModel& model, const Output& output);

/// Equations for people, one per line: "dx/dt = -y - z", "x[n+1] = 1 - x^2". Numbers are
/// unrounded unless a number of significant digits is given, so that what is printed is the
/// model.
std::string to_text(const OdeModel& model, std::optional<int> significant_digits = {});

/// A model from formulas that are written in C++, one right-hand side for each state:
/// @code
///   const auto th = Expression::variable("th"), w = Expression::variable("w");
///   const OdeModel pendulum =
///       written_model({{"th", "rad"}, {"w", "rad/s"}}, {w, -19.62 * sin(th) - 0.15 * w});
/// @endcode
/// Formulas become sums of coefficients times terms as those of a text (parse_ode()): products
/// are multiplied out over sums, so that 10 * (y - x) is 10 y - 10 x.
/// @param states m, with their units.
/// @param rates m formulas in states, inputs and t, in state units per time unit.
/// @param inputs p.
/// @throws ModelError naming the state: another number of formulas than of states, an unknown
///   name, a coefficient that is not finite; and as the constructor of OdeModel.
OdeModel written_model(const std::vector<Quantity>& states,
                       const std::vector<Expression>& rates,
                       const std::vector<Quantity>& inputs = {},
                       const std::string& time_unit = "s");

/// How a found model compares with the true one.
struct ModelAccuracy {
  bool exact_structure = false;  ///< the same terms in every equation
  double largest_error = 0.0;    ///< max |h_found - h_true| / max |h_true|
  /// ||Xi_found - Xi_true|| / ||Xi_true||, spectral norms of the matrices states x terms.
  double relative_error = 0.0;
};

/// Compares structure and coefficients, term by term; a term that one of them lacks has the
/// coefficient 0 there. Errors are not finite where all true coefficients are 0.
/// @param found m states, in the order of `truth`; terms by their names.
/// @throws ArgumentError when the models have other numbers of states.
ModelAccuracy compare_models(const OdeModel& found, const OdeModel& truth);

}  // namespace lacuna
