// SPDX-License-Identifier: MIT
#include "own_stages.hpp"

#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <cmath>

#include "arrays.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/effects/effects.hpp"

namespace lacuna::python {
namespace {

/// The least-squares problem as rows: |y - Theta h| is |target - columns h| for every h.
struct Rows {
  Matrix columns;  ///< (|A| + 1) x |A|
  Vector target;   ///< |A| + 1
};

Rows rows_of(const Subproblem& problem) {
  const Index n = problem.size();
  Rows rows{Matrix::Zero(n + 1, n), Vector(n + 1)};
  rows.columns.topRows(n) = problem.triangle() * problem.column_norms().asDiagonal();
  rows.target.head(n) = problem.projected_target();
  const Vector h = problem.solve();
  const double left = (rows.target.head(n) - rows.columns.topRows(n) * h).norm();
  rows.target[n] =
      std::sqrt(std::max(0.0, std::pow(problem.residual_norm(h), 2) - left * left));
  return rows;
}

/// What a function of Python gave for each of the terms.
Vector coefficients_of(const nb::object& given, Index count, std::string_view name) {
  const auto numbers = nb::cast<std::vector<double>>(given.attr("tolist")());
  if (static_cast<Index>(numbers.size()) != count)
    throw ArgumentError(std::string(name),
                        std::to_string(numbers.size()) + " coefficients for " +
                            std::to_string(count) + " terms",
                        "return one number for each column of theta, 0 where a term goes");
  Vector h(count);
  for (Index i = 0; i < count; ++i) {
    h[i] = numbers[static_cast<std::size_t>(i)];
    if (!std::isfinite(h[i]))
      throw ArgumentError(std::string(name), "a coefficient is not finite",
                          "return 0 for a term that the data do not determine");
  }
  return h;
}

/// The terms that have a coefficient, and that the others have none.
Regression regression_of(const Subproblem& problem, const Vector& h) {
  Regression result;
  std::vector<double> kept;
  for (Index i = 0; i < h.size(); ++i) {
    const Index term = problem.active()[static_cast<std::size_t>(i)];
    if (h[i] != 0.0) {
      result.active.push_back(term);
      kept.push_back(h[i]);
    } else {
      result.removed.push_back({term, "coefficient", 0.0, 0.0, 1});
    }
  }
  result.coefficients = Eigen::Map<const Vector>(kept.data(), static_cast<Index>(kept.size()));
  result.residual_norm = problem.residual_norm(h);
  return result;
}

nb::dict ranges_of(const Scope& scope) {
  nb::dict ranges;
  for (const VariableRange& variable : scope.variables)
    ranges[variable.name.c_str()] = nb::make_tuple(variable.low, variable.high);
  return ranges;
}

/// One starting point for each shape: the middle of its range, or the geometric one.
Vector middle_of(const std::vector<ShapeParameter>& shapes) {
  Vector start(static_cast<Index>(shapes.size()));
  for (std::size_t i = 0; i < shapes.size(); ++i)
    start[static_cast<Index>(i)] = shapes[i].logarithmic
                                       ? std::sqrt(shapes[i].low * shapes[i].high)
                                       : 0.5 * (shapes[i].low + shapes[i].high);
  return start;
}

/// A candidate from a form of Python: lacuna.Form.
Candidate candidate_of(const nb::handle& form, const Scope& scope) {
  Candidate candidate;
  const auto names = scope.model.variables().names();
  std::map<std::string, Expression> variables;
  for (const std::string& name : names) variables[name] = parse_expression(name);
  candidate.argument = parse_expression(nb::cast<std::string>(form.attr("argument")), names);
  candidate.form = formula(scope, nb::cast<std::string>(form.attr("formula")), variables);
  for (const auto& [name, range] : nb::cast<nb::dict>(form.attr("shapes"))) {
    const auto [low, high] = nb::cast<std::pair<double, double>>(range);
    candidate.shapes.push_back(
        {scope.free_name(nb::cast<std::string>(name)), "", low, high, low > 0.0});
  }
  for (const auto& start : nb::cast<std::vector<std::vector<double>>>(form.attr("starts")))
    candidate.starts.emplace_back(
        Eigen::Map<const Vector>(start.data(), static_cast<Index>(start.size())));
  if (candidate.starts.empty() && !candidate.shapes.empty())
    candidate.starts.push_back(middle_of(candidate.shapes));
  return candidate;
}

}  // namespace

std::vector<Term> WrittenBasis::do_terms(const Variables& variables) const {
  const nb::gil_scoped_acquire acquire;
  const nb::object texts = written()(variables.states, variables.inputs);
  std::vector<Term> terms;
  for (const nb::handle text : texts)
    terms.push_back(Term::parse(nb::cast<std::string>(text), variables));
  return terms;
}

Regression WrittenRegressor::do_fit(const LeastSquaresSystem&, const Subproblem& problem,
                                    Effort, const RunContext& context) const {
  context.check_stop();
  const Rows rows = rows_of(problem);
  const nb::gil_scoped_acquire acquire;
  const nb::object numpy = nb::module_::import_("numpy");
  const nb::object given = numpy.attr("asarray")(
      written()(array_of(rows.columns), array_of(rows.target)), "float64");
  return regression_of(problem,
                       coefficients_of(given.attr("ravel")(), problem.size(), info().name));
}

std::vector<Candidate> WrittenEffect::do_candidates(const Scope& scope, Index equation) const {
  const nb::gil_scoped_acquire acquire;
  const Variables variables = scope.model.variables();
  const nb::object type = nb::module_::import_("lacuna.own").attr("Scope");
  const nb::object forms =
      written()(type(variables.states[static_cast<std::size_t>(equation)], variables.states,
                     variables.inputs, ranges_of(scope), scope.step, scope.duration));
  std::vector<Candidate> candidates;
  for (const nb::handle form : forms) candidates.push_back(candidate_of(form, scope));
  return candidates;
}

}  // namespace lacuna::python
