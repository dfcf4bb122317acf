// SPDX-License-Identifier: MIT
#include <algorithm>
#include <numeric>

#include "regression/linear/row_fold.hpp"
#include "trajectories/subset_selection/negligible_columns.hpp"
#include "trajectories/subset_selection/subset_problem.hpp"

namespace lacuna {
namespace {

/// The fractions in one equation.
/// @param theta triangle of its terms, one column each.
Vector fractions_in(const Matrix& theta, const Vector& h) {
  Matrix with_rate(theta.rows(), theta.cols() + 1);
  with_rate << theta, theta * h;
  std::vector<Index> all(static_cast<std::size_t>(theta.cols()));
  std::iota(all.begin(), all.end(), Index{0});
  // The fit is exact: what it loses with a term is what the others cannot say of the rate.
  const Vector losses = losses_of(fit_subset(subset_problem(with_rate), all));
  return losses.cwiseSqrt() / std::max(with_rate.col(theta.cols()).norm(), 1e-300);
}

}  // namespace

RateEffects::RateEffects(WindowSearch& search, std::vector<Coefficient> columns)
    : columns_(std::move(columns)) {
  std::vector<Index> terms;
  for (const Coefficient& column : columns_) terms.push_back(column.term);
  std::sort(terms.begin(), terms.end());
  terms.erase(std::unique(terms.begin(), terms.end()), terms.end());
  for (const Coefficient& column : columns_)
    places_.push_back(std::lower_bound(terms.begin(), terms.end(), column.term) -
                      terms.begin());
  RowFold fold(static_cast<Index>(terms.size()));
  search.rates.choose(terms, search.fit.coefficients);
  for (const SampleWindow& window : search.path.windows) {
    search.rates.evaluate(search.path.records[window.record], window);
    fold.add(search.rates.theta());
  }
  triangle_ = fold.finish().value_or(Matrix());
}

Vector RateEffects::fractions(const std::vector<Index>& members, const Vector& h) const {
  Vector result = Vector::Zero(h.size());
  std::vector<Index> left(members.size());
  std::iota(left.begin(), left.end(), Index{0});
  while (!left.empty()) {
    const auto column = [&](Index i) {
      return static_cast<std::size_t>(members[static_cast<std::size_t>(i)]);
    };
    const Index equation = columns_[column(left.front())].equation;
    const auto others = std::stable_partition(left.begin(), left.end(), [&](Index i) {
      return columns_[column(i)].equation == equation;
    });
    const std::vector<Index> same(left.begin(), others);
    std::vector<Index> places;
    for (const Index i : same) places.push_back(places_[column(i)]);
    result(same) = fractions_in(triangle_(Eigen::all, places), h(same));
    left.erase(left.begin(), others);
  }
  return result;
}

}  // namespace lacuna
