// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "lacuna/core/base/error.hpp"
#include "lacuna/model/equations/system_model.hpp"
#include "summand_list.hpp"

namespace lacuna {
namespace {

[[noreturn]] void reject(const std::string& problem, const std::string& remedy) {
  throw ArgumentError("ParametrisedModel", problem, remedy);
}

void check_prior(const std::optional<Prior>& prior, const std::string& name) {
  if (prior && !(std::isfinite(prior->value) && prior->tolerance > 0.0))
    reject("the prior of '" + name + "' is not a number with a positive tolerance",
           "give value and tolerance");
}

void check_coefficients(const OdeModel& model, const std::vector<FreeCoefficient>& free) {
  std::set<std::pair<Index, Index>> seen;
  for (const FreeCoefficient& c : free) {
    const bool exists =
        c.equation >= 0 && c.equation < model.dimension() && c.summand >= 0 &&
        c.summand <
            static_cast<Index>(model.equations()[static_cast<std::size_t>(c.equation)].size());
    const std::string name =
        "summand " + std::to_string(c.summand) + " of equation " + std::to_string(c.equation);
    if (!exists) reject(name + " does not exist", "count both from 0");
    if (!seen.insert({c.equation, c.summand}).second)
      reject(name + " is free twice", "name each coefficient once");
    check_prior(c.prior, name);
  }
}

void check_shapes(const OdeModel& model, const std::vector<FreeShape>& shapes) {
  const std::size_t inputs = model.inputs().size();
  if (shapes.size() > inputs)
    throw ModelError("ParametrisedModel", "the model has fewer inputs than shape parameters",
                     "add an input for each shape parameter");
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    const FreeShape& shape = shapes[i];
    if (model.inputs()[inputs - shapes.size() + i].name != shape.name)
      throw ModelError("ParametrisedModel",
                       "shape parameter '" + shape.name + "' is not among the last inputs",
                       "make the shape parameters the last inputs, in the same order");
    check_prior(shape.prior, shape.name);
    if (!std::isfinite(shape.value) ||
        (shape.lower && shape.upper && *shape.lower > *shape.upper))
      reject("value or bounds of '" + shape.name + "' are unusable",
             "give a number and lower <= upper");
  }
}

/// The values of the shape parameters.
std::map<std::string, Expression> numbers_of(const std::vector<FreeShape>& shapes) {
  std::map<std::string, Expression> numbers;
  for (const FreeShape& shape : shapes)
    numbers.emplace(shape.name, Expression::number(shape.value));
  return numbers;
}

/// Terms that are one with these numbers become one.
Equation substituted(const Equation& equation, const std::map<std::string, Expression>& numbers,
                     const VariableIndex& variables) {
  SummandList result;
  for (const WeightedTerm& summand : equation)
    result.add({.term = Term(substitute(summand.term.expression(), numbers), variables),
                .coefficient = summand.coefficient,
                .fixed = summand.fixed});
  return result.take();
}

}  // namespace

ParametrisedModel::ParametrisedModel(OdeModel symbolic,
                                     std::vector<FreeCoefficient> coefficients,
                                     std::vector<FreeShape> shapes)
    : symbolic_(std::move(symbolic)),
      coefficients_(std::move(coefficients)),
      shapes_(std::move(shapes)) {
  check_coefficients(symbolic_, coefficients_);
  check_shapes(symbolic_, shapes_);
}

Index ParametrisedModel::size() const noexcept {
  return static_cast<Index>(coefficients_.size() + shapes_.size());
}

Index ParametrisedModel::record_inputs() const noexcept {
  return static_cast<Index>(symbolic_.inputs().size() - shapes_.size());
}

Vector ParametrisedModel::values() const {
  Vector values(size());
  Index i = 0;
  for (const FreeCoefficient& c : coefficients_)
    values[i++] = symbolic_
                      .equations()[static_cast<std::size_t>(c.equation)]
                                  [static_cast<std::size_t>(c.summand)]
                      .coefficient;
  for (const FreeShape& shape : shapes_) values[i++] = shape.value;
  return values;
}

std::vector<std::string> ParametrisedModel::names() const {
  std::vector<std::string> names;
  for (const FreeCoefficient& c : coefficients_) {
    const auto equation = static_cast<std::size_t>(c.equation);
    names.push_back(
        symbolic_.states()[equation].name + ": " +
        symbolic_.equations()[equation][static_cast<std::size_t>(c.summand)].term.name());
  }
  for (const FreeShape& shape : shapes_) names.push_back(shape.name);
  return names;
}

std::vector<std::optional<Prior>> ParametrisedModel::priors() const {
  std::vector<std::optional<Prior>> priors;
  for (const FreeCoefficient& c : coefficients_) priors.push_back(c.prior);
  for (const FreeShape& shape : shapes_) priors.push_back(shape.prior);
  return priors;
}

Vector ParametrisedModel::admissible(Vector values) const {
  Index i = static_cast<Index>(coefficients_.size());
  for (const FreeShape& shape : shapes_) {
    if (shape.lower) values[i] = std::max(values[i], *shape.lower);
    if (shape.upper) values[i] = std::min(values[i], *shape.upper);
    ++i;
  }
  return values;
}

ParametrisedModel ParametrisedModel::with_values(const Vector& values) const {
  if (values.size() != size())
    reject("there are " + std::to_string(values.size()) + " values for " +
               std::to_string(size()) + " parameters",
           "give one value per parameter");
  std::vector<Equation> equations = symbolic_.equations();
  std::vector<FreeShape> shapes = shapes_;
  Index i = 0;
  for (const FreeCoefficient& c : coefficients_) {
    WeightedTerm& summand =
        equations[static_cast<std::size_t>(c.equation)][static_cast<std::size_t>(c.summand)];
    summand = {.term = summand.term, .coefficient = values[i++], .fixed = summand.fixed};
  }
  for (FreeShape& shape : shapes) shape.value = values[i++];
  return {symbolic_.with_equations(std::move(equations)), coefficients_, std::move(shapes)};
}

OdeModel ParametrisedModel::model() const {
  if (shapes_.empty()) return symbolic_;
  std::vector<Quantity> inputs = symbolic_.inputs();
  inputs.resize(static_cast<std::size_t>(record_inputs()));
  const VariableIndex variables({names_of(symbolic_.states()), names_of(inputs)});
  const std::map<std::string, Expression> numbers = numbers_of(shapes_);
  std::vector<Equation> equations;
  for (const Equation& equation : symbolic_.equations())
    equations.push_back(substituted(equation, numbers, variables));
  std::vector<Output> outputs = symbolic_.outputs();
  for (Output& output : outputs) output.formula = substitute(output.formula, numbers);
  return OdeModel(symbolic_.states(), std::move(inputs), std::move(equations),
                  symbolic_.time_unit())
      .with_outputs(std::move(outputs))
      .with_initial(symbolic_.initial())
      .with_events(substituted(symbolic_.events(), numbers));
}

ParametrisedModel with_free_coefficients(OdeModel model, const std::vector<bool>& exact,
                                         std::vector<FreeShape> shapes) {
  std::vector<FreeCoefficient> free;
  for (std::size_t k = 0; k < model.equations().size(); ++k) {
    if (k < exact.size() && exact[k]) continue;
    for (std::size_t i = 0; i < model.equations()[k].size(); ++i)
      if (!model.equations()[k][i].fixed)
        free.push_back({static_cast<Index>(k), static_cast<Index>(i)});
  }
  return {std::move(model), std::move(free), std::move(shapes)};
}

}  // namespace lacuna
