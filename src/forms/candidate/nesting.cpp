// SPDX-License-Identifier: MIT
#include "forms/candidate/nesting.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/numerics/qr.hpp"
#include "shape_scale.hpp"
#include "shape_search.hpp"

namespace lacuna {
namespace {

/// Fraction of the square up to which a form is followed by another one.
constexpr double kFractionNotFollowed = 1e-3;

/// Values of formulas without delays at the samples of a scope.
Matrix at_samples(const std::vector<Expression>& formulas, const Scope& scope) {
  const Program program(formulas, scope.model.variables());
  Matrix values(scope.samples.rows(), static_cast<Index>(formulas.size()));
  Program::Workspace workspace;
  program.evaluate(scope.samples.leftCols(program.slots()), values, workspace);
  return values;
}

/// Orthonormal columns of the nominal terms of an equation that have no delays.
Matrix nominal_columns(const Scope& scope, Index equation) {
  std::vector<Expression> terms;
  for (const WeightedTerm& summand :
       scope.model.equations()[static_cast<std::size_t>(equation)])
    if (!contains(summand.term.expression(), Operation::Delay))
      terms.push_back(summand.term.expression());
  const Matrix columns = at_samples(terms, scope);
  if (columns.cols() == 0 || !columns.allFinite()) return Matrix(columns.rows(), 0);
  return PivotedQr(columns).basis();
}

bool is_of_the_present(const Candidate& candidate) {
  return candidate.memory.empty() && !contains(candidate.form, Operation::Delay);
}

/// Starting points and corners of the unit cube.
std::vector<Vector> beginnings(const Candidate& candidate, const ShapeScale& scale) {
  std::vector<Vector> result;
  for (const Vector& start : candidate.starts) result.push_back(scale.unit(start));
  const auto count = static_cast<Index>(candidate.shapes.size());
  for (int corner = 0; corner < 1 << count; ++corner) {
    Vector unit(count);
    for (Index i = 0; i < count; ++i) unit[i] = (corner >> i) & 1;
    result.push_back(unit);
  }
  return result;
}

/// Values of a candidate that the nominal terms do not have, of length 1; 0 where there are
/// none.
Vector own_values(const Candidate& candidate, std::span<const double> shapes,
                  const Matrix& nominal, const Scope& scope) {
  Vector values = at_samples({bind_form(candidate, shapes)}, scope).col(0);
  if (!values.allFinite()) return Vector::Zero(values.size());
  const double whole = values.norm();
  values -= nominal * (nominal.transpose() * values);
  // Below this fraction of its length a form is one of the nominal terms, up to rounding.
  if (!(values.norm() > 1e-8 * whole)) return Vector::Zero(values.size());
  return values.normalized();
}

}  // namespace

bool nests(const Candidate& general, const Candidate& special, const Vector& values,
           const Scope& scope) {
  if (!in_one_place(general, special) || general.shapes.size() <= special.shapes.size() ||
      !is_of_the_present(general) || !is_of_the_present(special))
    return false;
  const Matrix nominal = nominal_columns(scope, special.equation);
  const Vector wanted = own_values(special, as_span(values), nominal, scope);
  const ShapeScale scale(general.shapes);
  const auto left = [&](const Vector& unit) {
    const Vector own = own_values(general, as_span(scale.shapes(unit)), nominal, scope);
    return 1.0 - std::pow(own.dot(wanted), 2);
  };
  std::vector<Vector> begin = beginnings(general, scale);
  const auto best =
      std::min_element(begin.begin(), begin.end(),
                       [&](const auto& a, const auto& b) { return left(a) < left(b); });
  if (left(*best) <= kFractionNotFollowed) return true;
  // A fact of the search, for each shape.
  constexpr int kEvaluations = 40;
  const int budget = kEvaluations * static_cast<int>(general.shapes.size());
  return left(least_in_cube(left, *best,
                            {.unnoticed = kFractionNotFollowed, .evaluations = budget})) <=
         kFractionNotFollowed;
}

}  // namespace lacuna
