// SPDX-License-Identifier: MIT
#include "lacuna/model/equations/system_model.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "lacuna/core/base/error.hpp"
#include "lacuna/core/base/text.hpp"
#include "model/expressions/operations.hpp"

namespace lacuna {
namespace {

using Names = std::set<std::string>;
using Numbers = std::map<std::string, Expression>;

bool has_any(const Expression& e, const Names& names) {
  const Names used = e.variables();
  return std::any_of(used.begin(), used.end(),
                     [&](const std::string& name) { return names.contains(name); });
}

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
    found = found ||
            (has_any(factor, some) &&
             std::includes(parameters.begin(), parameters.end(), used.begin(), used.end()));
  });
  return found;
}

Names names_of(const std::vector<Parameter>& parameters, bool only_free) {
  Names names;
  for (const Parameter& parameter : parameters)
    if (parameter.free || !only_free) names.insert(parameter.name);
  return names;
}

Numbers numbers_of(const std::vector<Parameter>& parameters, bool free_too) {
  Numbers numbers;
  for (const Parameter& parameter : parameters)
    if (free_too || !parameter.free)
      numbers.emplace(parameter.name, Expression::number(parameter.value));
  return numbers;
}

void add_to(Equation& equation, WeightedTerm summand) {
  const auto same = std::find_if(equation.begin(), equation.end(),
                                 [&](const WeightedTerm& w) { return w.term == summand.term; });
  if (same == equation.end())
    equation.push_back(std::move(summand));
  else
    *same = {.term = same->term,
             .coefficient = same->coefficient + summand.coefficient,
             .fixed = same->fixed && summand.fixed};
}

/// A summand with numbers for parameters. @param sized by free parameters.
WeightedTerm with_numbers(const WeightedTerm& summand, const Numbers& numbers, bool sized,
                          const Variables& variables) {
  const Split split = split_number(substitute(summand.term.expression(), numbers));
  return {.term = Term(split.rest, variables),
          .coefficient = summand.coefficient * split.number,
          .fixed = summand.fixed && !sized};
}

std::vector<Output> substituted(std::vector<Output> outputs, const Numbers& numbers) {
  for (Output& output : outputs) output.formula = substitute(output.formula, numbers);
  return outputs;
}

/// Whether a delay in the model depends on one of the names.
bool delays_depend_on(const Expression& e, const Names& names) {
  if (e.operation() == Operation::Delay && !e.operands().empty())
    return has_any(e.operands()[0], names);
  return std::any_of(e.operands().begin(), e.operands().end(),
                     [&](const Expression& part) { return delays_depend_on(part, names); });
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
  return "";
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
  for (const Parameter& parameter : parameters_)
    if (const std::string problem = range_problem(parameter); !problem.empty())
      throw ModelError("parameter " + parameter.name, problem, "mend value or range");
}

std::vector<Quantity> SystemModel::inputs() const {
  std::vector<Quantity> inputs = symbolic_.inputs();
  inputs.resize(inputs.size() - parameters_.size());
  return inputs;
}

bool SystemModel::gives_size(const Expression& term) const {
  const Names all = names_of(parameters_, false);
  return is_sized(term, all, all);
}

OdeModel SystemModel::model() const {
  if (parameters_.empty()) return symbolic_;
  OdeModel frame(symbolic_.states(), inputs(), std::vector<Equation>(symbolic_.states().size()),
                 symbolic_.time_unit());
  const Variables variables = frame.variables();
  const Numbers numbers = numbers_of(parameters_, true);
  const Names all = names_of(parameters_, false), free = names_of(parameters_, true);
  std::vector<Equation> equations;
  for (const Equation& equation : symbolic_.equations()) {
    Equation& plain = equations.emplace_back();
    for (const WeightedTerm& summand : equation) {
      const Expression& term = summand.term.expression();
      if (!has_any(term, all)) {
        plain.push_back(summand);
        continue;
      }
      WeightedTerm numeric =
          with_numbers(summand, numbers, is_sized(term, all, free), variables);
      // Parameters alone give the size of the term, and all of them are known.
      if (is_sized(term, all, all) && !is_sized(term, all, free)) numeric.fixed = true;
      if (numeric.coefficient != 0.0) add_to(plain, std::move(numeric));
    }
  }
  return frame.with_equations(std::move(equations))
      .with_outputs(substituted(symbolic_.outputs(), numbers))
      .with_initial(symbolic_.initial())
      .with_evolution(symbolic_.evolution());
}

ParametrisedModel SystemModel::parametrised() const {
  const Names all = names_of(parameters_, false), free = names_of(parameters_, true);
  const Numbers numbers = numbers_of(parameters_, false);
  std::vector<Quantity> inputs = this->inputs();
  std::vector<FreeShape> shapes;
  for (const Parameter& p : parameters_)
    if (p.free) {
      inputs.push_back({p.name, p.unit});
      shapes.push_back({.name = p.name, .value = p.value, .lower = p.min, .upper = p.max});
    }
  const OdeModel frame(symbolic_.states(), inputs,
                       std::vector<Equation>(symbolic_.states().size()), symbolic_.time_unit());
  std::vector<FreeCoefficient> coefficients;
  std::vector<Equation> equations;
  for (Index k = 0; k < symbolic_.dimension(); ++k) {
    Equation& equation = equations.emplace_back();
    const bool exact = identity_of(symbolic_, k).has_value();
    for (const WeightedTerm& summand : symbolic_.equations()[static_cast<std::size_t>(k)]) {
      const Expression& term = summand.term.expression();
      if (delays_depend_on(term, free))
        throw ModelError("term " + summand.term.name(), "a delay cannot be estimated here",
                         "make its parameter fixed and try several values");
      if (!exact && !summand.fixed && !is_sized(term, all, all))
        coefficients.push_back({k, static_cast<Index>(equation.size())});
      equation.push_back(summand);
      equation.back().term = Term(substitute(term, numbers), frame.variables());
    }
  }
  OdeModel model = frame.with_equations(std::move(equations))
                       .with_outputs(substituted(symbolic_.outputs(), numbers))
                       .with_initial(symbolic_.initial());
  return {std::move(model), std::move(coefficients), std::move(shapes)};
}

}  // namespace lacuna
