// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "lacuna/model/equations/system_model.hpp"
#include "linear_terms.hpp"
#include "summand_list.hpp"

namespace lacuna {
namespace {

using Coefficients = std::map<std::string, WeightedTerm>;

Coefficients by_term(const Equation& equation) {
  Coefficients result;
  for (const WeightedTerm& summand : equation) result.emplace(summand.term.name(), summand);
  return result;
}

double coefficient_of(const Coefficients& coefficients, const std::string& term) {
  const auto found = coefficients.find(term);
  return found == coefficients.end() ? 0.0 : found->second.coefficient;
}

/// One equation of a system, of its numbers and of the estimated model.
struct EstimatedEquation {
  const SystemModel& given;
  std::size_t equation;
  Coefficients nominal, estimated;

  /// What numbers make of a piece of the equation.
  Equation in_numbers(const WeightedTerm& piece) const {
    const OdeModel& symbolic = given.symbolic();
    std::vector<Equation> alone(symbolic.equations().size());
    alone[equation] = {piece};
    const OdeModel model(symbolic.states(), symbolic.inputs(), std::move(alone),
                         symbolic.time_unit());
    return SystemModel(model, given.parameters()).model().equations()[equation];
  }

  /// Estimated over given coefficient. What is 0 stays so: no ratio changes it.
  double ratio(const std::string& term) const {
    const double before = coefficient_of(nominal, term);
    const double after = coefficient_of(estimated, term);
    return before == after || before == 0.0 ? 1.0 : after / before;
  }

  /// The piece with the ratio of all its terms in front; nothing where they have several.
  std::optional<WeightedTerm> with_ratio(WeightedTerm piece) const {
    const Equation terms = in_numbers(piece);
    if (terms.empty()) return piece;
    const std::string first = terms.front().term.name();
    const double common = ratio(first);
    for (const WeightedTerm& term : terms)
      if (!nominal.contains(term.term.name()) || ratio(term.term.name()) != common)
        return std::nullopt;
    const auto found = estimated.find(first);
    if (found == estimated.end() || common == 1.0) {
      piece.coefficient *= common;
      return piece;
    }
    const WeightedTerm& estimate = found->second;
    const double unit = piece.coefficient / coefficient_of(nominal, first);
    WeightedTerm result{.term = piece.term, .coefficient = estimate.coefficient * unit};
    if (terms.size() > 1) return result;
    if (estimate.standard_error)
      result.standard_error = std::abs(unit) * *estimate.standard_error;
    if (estimate.ci95) {
      const auto [low, high] =
          std::minmax({unit * (*estimate.ci95)[0], unit * (*estimate.ci95)[1]});
      result.ci95 = {low, high};
    }
    return result;
  }

  /// All pieces with their ratios; nothing where one has several.
  std::optional<Equation> with_ratios(const Equation& pieces) const {
    Equation result;
    for (const WeightedTerm& piece : pieces) {
      std::optional<WeightedTerm> one = with_ratio(piece);
      if (!one) return std::nullopt;
      result.push_back(std::move(*one));
    }
    return result;
  }

  /// A summand of the system: as it was written, multiplied out, or else in numbers.
  Equation written(const WeightedTerm& summand, const VariableIndex& names) const {
    if (const auto whole = with_ratio(summand)) return {*whole};
    if (const auto parts = with_ratios(multiplied_out(summand, names))) return *parts;
    return with_ratios(in_numbers(summand)).value_or(Equation());
  }
};

/// An equation of the system with what was estimated, and terms that it did not have.
Equation equation_with_parameters(const EstimatedEquation& place, const Equation& estimated,
                                  const VariableIndex& given_names,
                                  const VariableIndex& names) {
  SummandList list;
  const auto add = [&](WeightedTerm summand) {
    summand.term = Term(summand.term.expression(), names);
    list.add(std::move(summand));
  };
  for (const WeightedTerm& summand : place.given.symbolic().equations()[place.equation])
    for (WeightedTerm& piece : place.written(summand, given_names)) add(std::move(piece));
  for (const WeightedTerm& summand : estimated)
    if (!place.nominal.contains(summand.term.name())) add(summand);
  Equation equation = list.take();
  std::erase_if(equation, [](const WeightedTerm& one) { return one.coefficient == 0.0; });
  return equation;
}

/// Whether two equations have the same coefficients to rounding.
bool has_same_coefficients(const Equation& a, const Equation& b) {
  constexpr double kRounding = 1e-9;  // a fact of doubles: of sums that cancel little is left
  const Coefficients left = by_term(a), right = by_term(b);
  const auto covers = [](const Coefficients& some, const Coefficients& others) {
    return std::all_of(some.begin(), some.end(), [&](const auto& one) {
      const double value = one.second.coefficient;
      return std::abs(value - coefficient_of(others, one.first)) <= kRounding * std::abs(value);
    });
  };
  return covers(left, right) && covers(right, left);
}

/// Formulas of measured channels that were not changed, with their parameters.
std::vector<Output> outputs_with_parameters(const SystemModel& given,
                                            std::vector<Output> outputs) {
  const std::vector<Output> numeric = given.model().outputs();
  for (Output& output : outputs)
    for (std::size_t i = 0; i < numeric.size(); ++i)
      if (numeric[i].name == output.name && numeric[i].formula == output.formula)
        output.formula = given.symbolic().outputs()[i].formula;
  return outputs;
}

/// Whether a state or an input is called as a parameter.
bool has_name_of_a_parameter(const OdeModel& model, const std::vector<Parameter>& parameters) {
  const std::vector<std::string> names = model.variables().names();
  return std::any_of(parameters.begin(), parameters.end(), [&](const Parameter& parameter) {
    return std::find(names.begin(), names.end(), parameter.name) != names.end();
  });
}

}  // namespace

SystemModel with_parameters_of(const SystemModel& given, const OdeModel& estimated) {
  const std::vector<Parameter>& parameters = given.parameters();
  if (parameters.empty() || has_name_of_a_parameter(estimated, parameters)) return estimated;
  std::vector<Quantity> inputs = estimated.inputs();
  const std::vector<Quantity>& all = given.symbolic().inputs();
  inputs.insert(inputs.end(), all.end() - static_cast<std::ptrdiff_t>(parameters.size()),
                all.end());
  const auto system = [&](std::vector<Equation> equations) {
    const OdeModel model(estimated.states(), inputs, std::move(equations),
                         estimated.time_unit());
    return SystemModel(model.with_outputs(outputs_with_parameters(given, estimated.outputs()))
                           .with_initial(estimated.initial())
                           .with_evolution(estimated.evolution())
                           .with_events(estimated.events()),
                       parameters);
  };
  const OdeModel nominal = given.model();
  const VariableIndex given_names(given.symbolic().variables());
  const VariableIndex names(Variables{names_of(estimated.states()), names_of(inputs)});
  std::vector<Equation> equations = estimated.equations();
  for (std::size_t k = 0; k < given.symbolic().states().size(); ++k)
    equations[k] = equation_with_parameters(
        {given, k, by_term(nominal.equations()[k]), by_term(estimated.equations()[k])},
        estimated.equations()[k], given_names, names);
  const OdeModel numbers = system(equations).model();
  for (std::size_t k = 0; k < equations.size(); ++k)
    if (!has_same_coefficients(numbers.equations()[k], estimated.equations()[k]))
      equations[k] = estimated.equations()[k];
  return system(std::move(equations));
}

}  // namespace lacuna
