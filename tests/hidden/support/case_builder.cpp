// SPDX-License-Identifier: MIT
#include "hidden/support/case_builder.hpp"

#include <algorithm>

namespace lacuna::hidden {
namespace {

/// The same equations over other variables.
OdeModel rebuilt(const OdeModel& model, const std::vector<Quantity>& states,
                 const std::vector<Quantity>& inputs, const std::vector<Terms>& more) {
  std::vector<Terms> equations;
  for (const Equation& equation : model.equations()) {
    Terms terms;
    for (const WeightedTerm& summand : equation)
      terms.emplace_back(summand.term.name(), summand.coefficient);
    equations.push_back(std::move(terms));
  }
  equations.insert(equations.end(), more.begin(), more.end());
  return model_of(model.time_unit(), states, inputs, equations);
}

using NamedEquations = std::vector<std::pair<std::string, Terms>>;

OdeModel with_states(const OdeModel& model, const NamedEquations& more) {
  std::vector<Quantity> states = model.states();
  std::vector<Terms> equations;
  for (const auto& [name, terms] : more) {
    states.push_back({name, ""});
    equations.push_back(terms);
  }
  return rebuilt(model, states, model.inputs(), equations);
}

OdeModel with_input(const OdeModel& model, const std::string& name) {
  std::vector<Quantity> inputs = model.inputs();
  inputs.push_back({name, ""});
  return rebuilt(model, model.states(), inputs, {});
}

OdeModel plus(const OdeModel& model, const std::string& equation, const std::string& term,
              double coefficient) {
  return model.with_term(
      model.state_index(equation),
      {.term = Term::parse(term, model.variables()), .coefficient = coefficient});
}

void append_zeros(Vector& vector, std::size_t count) {
  const Vector longer = (Vector(vector.size() + static_cast<Index>(count)) << vector,
                         Vector::Zero(static_cast<Index>(count)))
                            .finished();
  vector = longer;
}

}  // namespace

OdeModel model_of(const std::string& time_unit, std::vector<Quantity> states,
                  std::vector<Quantity> inputs, const std::vector<Terms>& equations) {
  Variables variables;
  for (const Quantity& state : states) variables.states.push_back(state.name);
  for (const Quantity& input : inputs) variables.inputs.push_back(input.name);
  std::vector<Equation> parsed;
  for (const Terms& terms : equations) {
    Equation equation;
    for (const auto& [term, coefficient] : terms)
      equation.push_back({.term = Term::parse(term, variables), .coefficient = coefficient});
    parsed.push_back(std::move(equation));
  }
  return OdeModel(std::move(states), std::move(inputs), std::move(parsed), time_unit);
}

OdeModel HiddenCase::without_effects() const {
  OdeModel model = nominal;
  for (const WrongCoefficient& w : wrong)
    model = plus(model, w.equation, w.term, w.truth - w.nominal);
  return model;
}

CaseBuilder::CaseBuilder(std::string name, std::string about, Plant plant, double strength)
    : case_{.name = std::move(name),
            .about = std::move(about),
            .kind = Kind::Nothing,
            .nominal = plant.model,
            .system = plant,
            .effects = {},
            .wrong = {},
            .augmented = {},
            .noise = NoiseKind::White,
            .skew = Vector::Zero(plant.model.dimension())},
      augmented_(plant.model),
      strength_(strength) {}

CaseBuilder& CaseBuilder::hidden_states(const NamedEquations& states) {
  case_.system.model = with_states(case_.system.model, states);
  augmented_ = with_states(augmented_, states);
  append_zeros(case_.system.start, states.size());
  append_zeros(case_.system.spread, states.size());
  return *this;
}

CaseBuilder& CaseBuilder::hidden_input(const std::string& name, const SignalSpec& drive) {
  case_.system.model = with_input(case_.system.model, name);
  case_.system.drives.push_back(drive);
  return *this;
}

CaseBuilder& CaseBuilder::hide(HiddenEffect effect, const std::string& simulated) {
  if (case_.kind == Kind::Nothing) case_.kind = Kind::Effects;
  effect.coefficient *= strength_;
  const std::string& term = simulated.empty() ? effect.term : simulated;
  case_.system.model = plus(case_.system.model, effect.equation, term, effect.coefficient);
  if (expressible())
    augmented_ = plus(augmented_, effect.equation, effect.term, effect.coefficient);
  case_.effects.push_back(std::move(effect));
  return *this;
}

CaseBuilder& CaseBuilder::skewed(const std::string& state, double later) {
  case_.kind = Kind::Effects;
  case_.skew[case_.nominal.state_index(state)] = strength_ * later;
  case_.effects.push_back({.equation = state,
                           .names = {"channel-skew"},
                           .plain = {},
                           .term = "",
                           .coefficient = strength_ * later});
  return *this;
}

CaseBuilder& CaseBuilder::misjudge(const std::string& equation, const std::string& term,
                                   double factor) {
  if (case_.kind == Kind::Nothing) case_.kind = Kind::Coefficients;
  const double truth = case_.nominal.coefficient(case_.nominal.state_index(equation), term);
  case_.nominal = plus(case_.nominal, equation, term, (factor - 1.0) * truth);
  case_.wrong.push_back({equation, term, factor * truth, truth});
  return *this;
}

CaseBuilder& CaseBuilder::start(Vector start, Vector spread) {
  case_.system.start = std::move(start);
  case_.system.spread = std::move(spread);
  return *this;
}

CaseBuilder& CaseBuilder::noise(NoiseKind kind) {
  case_.noise = kind;
  return *this;
}

CaseBuilder& CaseBuilder::inexpressible() {
  case_.kind = Kind::Inexpressible;
  return *this;
}

bool CaseBuilder::expressible() const {
  return case_.system.model.inputs().size() == case_.nominal.inputs().size();
}

HiddenCase CaseBuilder::build() const {
  HiddenCase result = case_;
  const bool sampled_in_time = (case_.skew.array() == 0.0).all();
  if (expressible() && sampled_in_time && case_.kind != Kind::Inexpressible)
    result.augmented = augmented_;
  return result;
}

}  // namespace lacuna::hidden
