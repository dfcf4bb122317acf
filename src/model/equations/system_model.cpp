// SPDX-License-Identifier: MIT
#include "lacuna/model/equations/system_model.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "core/base/names.hpp"
#include "core/base/text.hpp"
#include "lacuna/core/base/error.hpp"
#include "model/expressions/operations.hpp"
#include "linear_terms.hpp"
#include "summand_list.hpp"

namespace lacuna {
namespace {

using Names = std::set<std::string>;
using Numbers = std::map<std::string, Expression>;

/// A formula as number times rest.
struct Split {
  double number = 1.0;
  Expression rest = Expression::number(1.0);
};

/// Factors and divisors that are numbers, taken out of a product.
Split split_number(const Expression& e) {
  if (const auto value = constant_value(e)) return {*value};
  if (e.operation() == Operation::Negate) {
    const Split inner = split_number(e.operands()[0]);
    return {-inner.number, inner.rest};
  }
  if (e.operation() != Operation::Multiply && e.operation() != Operation::Divide)
    return {1.0, e};
  const Split a = split_number(e.operands()[0]), b = split_number(e.operands()[1]);
  if (e.operation() == Operation::Divide)
    return {a.number / b.number, is_number(b.rest, 1.0) ? a.rest : a.rest / b.rest};
  return {a.number * b.number, is_number(a.rest, 1.0)   ? b.rest
                               : is_number(b.rest, 1.0) ? a.rest
                                                        : a.rest * b.rest};
}

/// Calls `visit` with the factors and divisors of a product.
template <class Visit>
void each_factor(const Expression& e, const Visit& visit) {
  const bool is_product =
      e.operation() == Operation::Multiply || e.operation() == Operation::Divide;
  if (!is_product && e.operation() != Operation::Negate) return visit(e);
  for (const Expression& operand : e.operands()) each_factor(operand, visit);
}

/// Whether a term has a factor in which there are parameters and nothing else, one of them at
/// least among `some`.
bool is_sized(const Expression& term, const Names& parameters, const Names& some) {
  bool found = false;
  each_factor(term, [&](const Expression& factor) {
    const Names used = factor.variables();
    const auto is_parameter = [&](const std::string& name) {
      return parameters.contains(name);
    };
    found =
        found || (has_any(factor, some) && std::all_of(used.begin(), used.end(), is_parameter));
  });
  return found;
}

Names free_names(const std::vector<Parameter>& parameters) {
  Names names;
  for (const Parameter& parameter : parameters)
    if (parameter.free) names.insert(parameter.name);
  return names;
}

Numbers numbers_of(const std::vector<Parameter>& parameters, bool free_too) {
  Numbers numbers;
  for (const Parameter& parameter : parameters)
    if (free_too || !parameter.free)
      numbers.emplace(parameter.name, Expression::number(parameter.value));
  return numbers;
}

/// A summand with numbers for parameters. @param sized by free parameters.
WeightedTerm with_numbers(const WeightedTerm& summand, const Numbers& numbers, bool sized,
                          const VariableIndex& variables) {
  const Split split = split_number(substitute(summand.term.expression(), numbers));
  return {.term = Term(split.rest, variables),
          .coefficient = summand.coefficient * split.number,
          .fixed = summand.fixed && !sized};
}

std::vector<Output> substituted(std::vector<Output> outputs, const Numbers& numbers) {
  for (Output& output : outputs) output.formula = substitute(output.formula, numbers);
  return outputs;
}

/// What is known of a parameter before.
std::optional<Prior> prior_of(const Parameter& parameter) {
  if (parameter.deviation) return Prior{parameter.value, *parameter.deviation};
  if (parameter.factor) return Prior{parameter.value, std::log(*parameter.factor), true};
  return std::nullopt;
}

/// Whether a delay in the model depends on one of the names.
bool delays_depend_on(const Expression& e, const Names& names) {
  if (e.operation() == Operation::Delay && !e.operands().empty())
    return has_any(e.operands()[0], names);
  return std::any_of(e.operands().begin(), e.operands().end(),
                     [&](const Expression& part) { return delays_depend_on(part, names); });
}

/// An equation with numbers for fixed parameters.
struct NumberedEquation {
  Equation summands;
  std::vector<Index> places;  ///< of the summands that were there before
  std::vector<bool> free;     ///< which coefficients are to be estimated
};

NumberedEquation numbered(const SystemModel& system, Index k, const Numbers& numbers,
                          const VariableIndex& variables) {
  const bool exact = identity_of(system.symbolic(), k).has_value();
  NumberedEquation result;
  SummandList list;
  const auto equation = static_cast<std::size_t>(k);
  for (const WeightedTerm& summand : system.symbolic().equations()[equation]) {
    const Expression& term = summand.term.expression();
    WeightedTerm numeric = summand;
    numeric.term = Term(substitute(term, numbers), variables);
    const std::size_t place = list.add(std::move(numeric));
    result.places.push_back(static_cast<Index>(place));
    result.free.resize(std::max(result.free.size(), place + 1), false);
    if (!exact && !summand.fixed && !system.gives_size(term)) result.free[place] = true;
  }
  result.summands = list.take();
  return result;
}

/// The model without equations; its last inputs are the free parameters.
OdeModel frame_of_free(const SystemModel& system) {
  const OdeModel& model = system.symbolic();
  std::vector<Quantity> inputs = system.inputs();
  for (const Parameter& p : system.parameters())
    if (p.free) inputs.push_back({p.name, p.unit});
  return {model.states(), std::move(inputs), std::vector<Equation>(model.states().size()),
          model.time_unit()};
}

}  // namespace

namespace {

/// What is wrong with the spread of a parameter over records; empty where nothing is.
std::string spread_problem(const Parameter& parameter) {
  const ParameterSpread& spread = *parameter.varies;
  if (!spread.by_factor && !(spread.size > 0.0 && std::isfinite(spread.size)))
    return "the deviation by which it varies is not above 0";
  if (spread.by_factor && !(spread.size > 1.0 && std::isfinite(spread.size)))
    return "the factor by which it varies is not above 1";
  if (spread.by_factor && !(parameter.value > 0.0))
    return "its value is not above 0, but it varies by a factor";
  if (!parameter.free) return "what is fixed does not vary";
  if (parameter.per_record)
    return "it varies and is per_record: each record has its own value either from a "
           "distribution or without one";
  return "";
}

}  // namespace

std::string range_problem(const Parameter& parameter) {
  const std::string range = (parameter.min ? format_number(*parameter.min) : "") + ".." +
                            (parameter.max ? format_number(*parameter.max) : "");
  if (!std::isfinite(parameter.value)) return "it is not finite";
  if (parameter.min && parameter.max && *parameter.min > *parameter.max)
    return "its range " + range + " is upside down";
  if ((parameter.min && parameter.value < *parameter.min) ||
      (parameter.max && parameter.value > *parameter.max))
    return "its value " + format_number(parameter.value) + " is not in its range " + range;
  if (parameter.deviation && !(*parameter.deviation > 0.0 && std::isfinite(*parameter.deviation)))
    return "its deviation is not above 0";
  if (parameter.factor && !(*parameter.factor > 1.0 && std::isfinite(*parameter.factor)))
    return "its factor is not above 1";
  if (parameter.factor && !(parameter.value > 0.0))
    return "its value is not above 0, but known by a factor";
  if (parameter.factor && parameter.deviation) return "it has a deviation and a factor";
  if ((parameter.deviation || parameter.factor) && !parameter.free)
    return "what is fixed has no deviation";
  return parameter.varies ? spread_problem(parameter) : "";
}

SystemModel::SystemModel(OdeModel symbolic, std::vector<Parameter> parameters)
    : symbolic_(std::move(symbolic)), parameters_(std::move(parameters)) {
  const std::vector<Quantity>& all = symbolic_.inputs();
  const bool fits = all.size() >= parameters_.size() &&
                    std::equal(parameters_.rbegin(), parameters_.rend(), all.rbegin(),
                               [](const Parameter& parameter, const Quantity& input) {
                                 return parameter.name == input.name;
                               });
  if (!fits)
    throw ModelError("model", "its last inputs are not its parameters",
                     "make the parameters the last inputs, in the same order");
  for (const Parameter& parameter : parameters_) {
    names_.insert(parameter.name);
    if (const std::string problem = range_problem(parameter); !problem.empty())
      throw ModelError("parameter " + parameter.name, problem, "mend value or range");
    if (const auto fault = unit_fault(parameter.unit))
      throw ModelError("parameter " + parameter.name, fault->problem, fault->remedy);
  }
}

std::vector<Quantity> SystemModel::inputs() const {
  std::vector<Quantity> inputs = symbolic_.inputs();
  inputs.resize(inputs.size() - parameters_.size());
  return inputs;
}

bool SystemModel::gives_size(const Expression& term) const {
  return is_sized(term, names_, names_);
}

OdeModel SystemModel::model() const {
  if (parameters_.empty()) return symbolic_;
  OdeModel frame(symbolic_.states(), inputs(), std::vector<Equation>(symbolic_.states().size()),
                 symbolic_.time_unit());
  const VariableIndex variables(frame.variables()), names(symbolic_.variables());
  const Numbers numbers = numbers_of(parameters_, true);
  const Names free = free_names(parameters_);
  std::vector<Equation> equations;
  for (const Equation& equation : symbolic_.equations()) {
    SummandList plain;
    for (const WeightedTerm& summand : equation) {
      if (!has_any(summand.term.expression(), names_)) {
        plain.add(summand);
        continue;
      }
      for (const WeightedTerm& part : multiplied_out(summand, names)) {
        const Expression& term = part.term.expression();
        const bool by_free = is_sized(term, names_, free);
        WeightedTerm numeric = with_numbers(part, numbers, by_free, variables);
        // Parameters alone give the size of the term, and all of them are known.
        if (!by_free && gives_size(term)) numeric.fixed = true;
        if (numeric.coefficient != 0.0) plain.add(std::move(numeric));
      }
    }
    equations.push_back(plain.take());
  }
  return frame.with_equations(std::move(equations))
      .with_outputs(substituted(symbolic_.outputs(), numbers))
      .with_initial(symbolic_.initial())
      .with_evolution(symbolic_.evolution())
      .with_events(substituted(symbolic_.events(), numbers));
}

ParametrisedModel SystemModel::parametrised() const {
  const Names free = free_names(parameters_);
  const Numbers numbers = numbers_of(parameters_, false);
  std::vector<FreeShape> shapes;
  for (const Parameter& p : parameters_)
    if (p.free)
      shapes.push_back({.name = p.name,
                        .value = p.value,
                        .prior = prior_of(p),
                        .lower = p.min,
                        .upper = p.max});
  for (const Equation& equation : symbolic_.equations())
    for (const WeightedTerm& summand : equation)
      if (delays_depend_on(summand.term.expression(), free))
        throw ModelError("term " + summand.term.name(), "a delay cannot be estimated here",
                         "estimate it by `lacuna fit`, or make its parameter fixed");
  const OdeModel frame = frame_of_free(*this);
  const VariableIndex variables(frame.variables());
  std::vector<FreeCoefficient> coefficients;
  std::vector<Equation> equations;
  for (Index k = 0; k < symbolic_.dimension(); ++k) {
    NumberedEquation equation = numbered(*this, k, numbers, variables);
    for (std::size_t i = 0; i < equation.free.size(); ++i)
      if (equation.free[i]) coefficients.push_back({k, static_cast<Index>(i)});
    equations.push_back(std::move(equation.summands));
  }
  OdeModel model = frame.with_equations(std::move(equations))
                       .with_outputs(substituted(symbolic_.outputs(), numbers))
                       .with_initial(symbolic_.initial())
                       .with_events(substituted(symbolic_.events(), numbers));
  return {std::move(model), std::move(coefficients), std::move(shapes)};
}

std::vector<std::size_t> SystemModel::delay_parameters() const {
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < parameters_.size(); ++i) {
    const Names name{parameters_[i].name};
    const auto delays = [&](const WeightedTerm& summand) {
      return delays_depend_on(summand.term.expression(), name);
    };
    const auto has_delays = [&](const Equation& equation) {
      return std::any_of(equation.begin(), equation.end(), delays);
    };
    const std::vector<Equation>& equations = symbolic_.equations();
    if (parameters_[i].free && std::any_of(equations.begin(), equations.end(), has_delays))
      found.push_back(i);
  }
  return found;
}

std::vector<std::vector<Index>> SystemModel::places_in_parametrised() const {
  const Numbers numbers = numbers_of(parameters_, false);
  const VariableIndex variables(frame_of_free(*this).variables());
  std::vector<std::vector<Index>> places;
  for (Index k = 0; k < symbolic_.dimension(); ++k)
    places.push_back(numbered(*this, k, numbers, variables).places);
  return places;
}

}  // namespace lacuna
