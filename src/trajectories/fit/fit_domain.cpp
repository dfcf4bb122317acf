// SPDX-License-Identifier: MIT
#include "fit_domain.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <string>

#include "model/expressions/domain.hpp"
#include "model/expressions/operations.hpp"

namespace lacuna {
namespace {

std::vector<Expression> margins_of(const ParametrisedModel& model,
                                   const std::vector<Expression>& formulas) {
  std::vector<Expression> all;
  const auto add = [&](const Expression& formula) {
    for (const Expression& margin : domain_margins(formula))
      if (!contains(margin, Operation::Delay)) all.push_back(margin);
  };
  for (const Equation& equation : model.symbolic().equations())
    for (const WeightedTerm& summand : equation) add(summand.term.expression());
  for (const Expression& formula : formulas) add(formula);
  return all;
}

/// Narrows the range of a state by a margin that is a line in it alone. An end that moves with
/// parameters is none.
void narrow(const ParametrisedModel& model, const Expression& margin, Index state,
            StateRanges& ranges) {
  const std::string& name = model.symbolic().states()[static_cast<std::size_t>(state)].name;
  std::map<std::string, Expression> parameters;
  for (const FreeShape& shape : model.shapes()) parameters.emplace(shape.name, shape.value);
  const Expression line = substitute(margin, parameters);
  const auto offset = constant_value(substitute(line, {{name, Expression::number(0.0)}}));
  const auto slope = constant_value(differentiate(line, name));
  if (!offset || !slope || *slope == 0.0 || (*offset != 0.0 && !(line == margin))) return;
  const double end = -*offset / *slope;
  double& lower = ranges.lower[state];
  double& upper = ranges.upper[state];
  if (*slope > 0.0)
    lower = std::max(lower, end);
  else
    upper = std::min(upper, end);
}

}  // namespace

StateRanges state_ranges(const ParametrisedModel& model) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const Index m = model.symbolic().dimension();
  StateRanges ranges{Vector::Constant(m, -kInfinity), Vector::Constant(m, kInfinity)};
  for (const Expression& margin : margins_of(model, {}))
    for (Index k = 0; k < m; ++k) narrow(model, margin, k, ranges);
  return ranges;
}

FitDomain::FitDomain(const ParametrisedModel& model, const std::vector<Expression>& formulas)
    : margins_(margins_of(model, formulas), model.symbolic().variables()),
      values_(margins_.outputs()),
      largest_(Vector::Zero(margins_.outputs())) {}

bool FitDomain::holds(const double* slots, double passed) {
  margins_.evaluate(slots, values_.data(), workspace_);
  largest_ = largest_.cwiseMax(values_);
  return !(values_.array() < -passed * largest_.array()).any();
}

}  // namespace lacuna
