// SPDX-License-Identifier: MIT
#include "lacuna/model/equations/ode_model.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_set>
#include <utility>

#include "core/base/names.hpp"
#include "core/base/text.hpp"
#include "data/times/time_names.hpp"
#include "lacuna/core/base/error.hpp"
#include "model/equations/formula_channel.hpp"
#include "model/expressions/operations.hpp"
#include "output_fault.hpp"

namespace lacuna {
namespace {

using TakenNames = std::unordered_set<std::string>;

void check_name(const std::string& name, TakenNames& taken) {
  if (const auto fault = name_fault(name))
    throw ModelError("model", fault->problem, fault->remedy);
  if (!taken.insert(name).second)
    throw ModelError("model", "the name '" + name + "' is given twice",
                     "give every state and input a name of its own");
}

void check_unit(const std::string& unit, const std::string& where) {
  if (const auto fault = unit_fault(unit))
    throw ModelError(where, fault->problem, fault->remedy);
}

void check_quantities(const std::vector<Quantity>& quantities, TakenNames& taken) {
  for (const Quantity& quantity : quantities) {
    check_name(quantity.name, taken);
    check_unit(quantity.unit, "unit of " + quantity.name);
  }
}

void check_counts(std::size_t states, std::size_t equations) {
  if (states == 0) throw ModelError("model", "there are no states", "name at least one");
  if (states == equations) return;
  throw ModelError(
      "model",
      std::to_string(equations) + " equations for " + std::to_string(states) + " states",
      "give one equation per state, in the order of the states");
}

Equation checked_equation(const Equation& equation, const std::string& state,
                          const VariableIndex& variables) {
  const std::string where = "equation of " + state;
  std::unordered_set<std::string> taken;
  Equation checked;
  for (const WeightedTerm& summand : equation) {
    checked.push_back(summand);
    checked.back().term = Term(summand.term.expression(), variables);
    const std::string& name = checked.back().term.name();
    if (!std::isfinite(summand.coefficient))
      throw ModelError(
          where, "the coefficient of '" + name + "' is " + format_number(summand.coefficient),
          "coefficients are finite numbers");
    if (!taken.insert(name).second)
      throw ModelError(where, "the term '" + name + "' stands twice",
                       "add the coefficients up in one term");
  }
  return checked;
}

void check_initial(const InitialValue& initial, const std::string& state) {
  const double deviation = initial.deviation.value_or(1.0);
  if (!std::isfinite(initial.time.value_or(0.0)))
    throw ModelError("initial value of " + state, "its time is not finite", "give a number");
  if (!std::isfinite(initial.value) || !(deviation > 0.0) || !std::isfinite(deviation))
    throw ModelError("initial value of " + state,
                     "it is not finite or its deviation is not above 0",
                     "give a number and, where it is known, a deviation above 0");
}

/// A model starts at one time.
void check_one_time(const std::vector<std::optional<InitialValue>>& initial) {
  std::optional<double> time;
  for (const std::optional<InitialValue>& one : initial) {
    if (!one || !one->time) continue;
    if (time && *time != *one->time)
      throw ModelError("initial values",
                       "they hold at two times, " + format_number(*time) + " and " +
                           format_number(*one->time),
                       "give all of them at the same time");
    time = one->time;
  }
}

const Equation& equation_at(const OdeModel& model, Index equation) {
  if (equation < 0 || equation >= model.dimension())
    throw ArgumentError(
        "OdeModel", "there is no equation " + std::to_string(equation),
        "equations are numbered from 0 to " + std::to_string(model.dimension() - 1));
  return model.equations()[static_cast<std::size_t>(equation)];
}

}  // namespace

OdeModel::OdeModel(std::vector<Quantity> states, std::vector<Quantity> inputs,
                   std::vector<Equation> equations, std::string time_unit)
    : states_(std::move(states)),
      inputs_(std::move(inputs)),
      equations_(std::move(equations)),
      time_unit_(std::move(time_unit)) {
  check_counts(states_.size(), equations_.size());
  TakenNames taken;
  check_quantities(states_, taken);
  check_quantities(inputs_, taken);
  check_unit(time_unit_, "unit of time");
  time_unit_ = time_unit_symbol(time_unit_).value_or(time_unit_);
  const VariableIndex names(variables());
  for (std::size_t i = 0; i < states_.size(); ++i)
    equations_[i] = checked_equation(equations_[i], states_[i].name, names);
  initial_.resize(states_.size());
}

Variables OdeModel::variables() const { return {names_of(states_), names_of(inputs_)}; }

Index OdeModel::state_index(const std::string& name) const {
  const auto found = std::find_if(states_.begin(), states_.end(),
                                  [&](const Quantity& state) { return state.name == name; });
  if (found == states_.end())
    throw ModelError("model", "there is no state '" + name + "'",
                     "the states are " + join(names_of(states_), ", "));
  return found - states_.begin();
}

double OdeModel::coefficient(Index equation, const std::string& term) const {
  for (const WeightedTerm& summand : equation_at(*this, equation))
    if (summand.term.name() == term) return summand.coefficient;
  return 0.0;
}

OdeModel OdeModel::with_term(Index equation, WeightedTerm summand) const {
  equation_at(*this, equation);
  std::vector<Equation> extended = equations_;
  Equation& summands = extended[static_cast<std::size_t>(equation)];
  summand.term = Term(summand.term.expression(), variables());
  const auto same = std::find_if(summands.begin(), summands.end(),
                                 [&](const WeightedTerm& w) { return w.term == summand.term; });
  if (same == summands.end())
    summands.push_back(std::move(summand));
  else
    *same = {same->term, same->coefficient + summand.coefficient};
  return with_equations(std::move(extended));
}

OdeModel OdeModel::with_equations(std::vector<Equation> equations) const {
  OdeModel result(states_, inputs_, std::move(equations), time_unit_);
  result.outputs_ = outputs_;
  result.initial_ = initial_;
  result = result.with_evolution(evolution_);
  return events_.empty() ? result : result.with_events(events_);
}

OdeModel OdeModel::with_evolution(Evolution evolution) const {
  if (evolution == Evolution::Map)
    for (const Equation& equation : equations_)
      for (const WeightedTerm& summand : equation)
        if (contains(summand.term.expression(), Operation::Delay))
          throw ModelError("model",
                           "the map has the delayed term '" + summand.term.name() + "'",
                           "make the earlier sample a state: its next value is the present one "
                           "of the other");
  OdeModel result = *this;
  result.evolution_ = evolution;
  return events_.empty() ? result : result.with_events(events_);
}

std::optional<TextFault> output_fault(const Output& output, const VariableIndex& variables) {
  if (const auto fault = name_fault(output.name)) return fault;
  if (const auto fault = unit_fault(output.unit)) return fault;
  for (const std::string& name : output.formula.variables())
    if (!variables.find(name))
      return TextFault{"unknown name '" + name + "'", suggestion(name, variables.names())};
  if (contains(output.formula, Operation::Delay))
    return TextFault{"an output cannot be delayed",
                     "measure the states as they are, or model the sensor as a state"};
  const std::optional<Index> taken = variables.find(output.name);
  if (taken && *taken >= variables.states())
    return TextFault{"the name '" + output.name + "' is given twice, first to an input",
                     "rename the output"};
  const bool is_state =
      output.formula.operation() == Operation::Variable && output.formula.name() == output.name;
  if (taken && !is_state)
    return TextFault{"a state has the same name and is not it", "rename the output"};
  if (!output.noise) return std::nullopt;
  if (const std::string problem = law_problem(*output.noise); !problem.empty())
    return TextFault{problem, "mend its noise, e.g. noise both 0.1 0.05 below 0.2"};
  return std::nullopt;
}

OdeModel OdeModel::with_outputs(std::vector<Output> outputs) const {
  OdeModel result = *this;
  result.outputs_ = std::move(outputs);
  const VariableIndex names(variables());
  TakenNames taken;
  for (const Output& output : result.outputs_) {
    if (const auto fault = output_fault(output, names))
      throw ModelError("output " + output.name, fault->problem, fault->remedy);
    check_name(output.name, taken);
  }
  return result;
}

OdeModel OdeModel::with_initial(std::vector<std::optional<InitialValue>> initial) const {
  if (initial.size() != states_.size())
    throw ArgumentError("OdeModel",
                        std::to_string(initial.size()) + " initial values for " +
                            std::to_string(states_.size()) + " states",
                        "give one entry for each state");
  for (std::size_t k = 0; k < initial.size(); ++k)
    if (initial[k]) check_initial(*initial[k], states_[k].name);
  check_one_time(initial);
  OdeModel result = *this;
  result.initial_ = std::move(initial);
  return result;
}

std::optional<double> OdeModel::initial_time() const {
  for (const std::optional<InitialValue>& initial : initial_)
    if (initial && initial->time) return initial->time;
  return std::nullopt;
}

OdeModel OdeModel::with_holds(const std::vector<std::optional<Hold>>& holds) const {
  if (holds.size() != inputs_.size())
    throw ArgumentError("OdeModel",
                        std::to_string(holds.size()) + " holds for " +
                            std::to_string(inputs_.size()) + " inputs",
                        "give one for each input");
  OdeModel result = *this;
  for (std::size_t i = 0; i < holds.size(); ++i) result.inputs_[i].hold = holds[i];
  return result;
}

void check_flow(const OdeModel& model, const std::string& task) {
  if (!model.is_map()) return;
  throw ModelError(task, "the model is a map x[n+1] = f(x[n])",
                   "only `identify --discrete`, `simulate` and `model` work with maps");
}

std::string left_hand_side(const std::string& state, Evolution evolution) {
  return evolution == Evolution::Map ? state + "[n+1]" : "d" + state + "/dt";
}

std::vector<std::string> left_hand_sides(const std::vector<std::string>& states,
                                         Evolution evolution) {
  std::vector<std::string> sides;
  sides.reserve(states.size());
  for (const std::string& state : states) sides.push_back(left_hand_side(state, evolution));
  return sides;
}

std::optional<Index> identity_of(const OdeModel& model, Index equation) {
  const Equation& summands = equation_at(model, equation);
  if (model.is_map() || summands.size() != 1 || summands.front().coefficient != 1.0 ||
      is_formula_channel(model.states()[static_cast<std::size_t>(equation)]))
    return std::nullopt;
  const std::optional<Index> other = summands.front().term.variable();
  return other < model.dimension() && other != equation ? other : std::nullopt;
}

std::optional<Index> state_of(const OdeModel& model, const Output& output) {
  if (output.formula.operation() != Operation::Variable) return std::nullopt;
  for (Index k = 0; k < model.dimension(); ++k)
    if (model.states()[static_cast<std::size_t>(k)].name == output.formula.name()) return k;
  return std::nullopt;
}

CompiledModel OdeModel::compile() const { return CompiledModel(*this); }

}  // namespace lacuna
