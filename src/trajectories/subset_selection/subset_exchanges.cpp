// SPDX-License-Identifier: MIT
#include "subset_exchanges.hpp"

#include <algorithm>
#include <cmath>

namespace lacuna {
namespace {

/// Fractions of an orthonormal basis of what members i and (when it is another one) j release.
Matrix released(const SubsetExchanges& all, Index i, Index j) {
  Matrix result(i == j ? 1 : 2, all.fractions.cols());
  result.row(0) = all.fractions.row(i);
  if (i == j) return result;
  const double common = all.directions.col(i).dot(all.directions.col(j));
  const double rest = std::sqrt(std::max(kNewFraction * kNewFraction, 1.0 - common * common));
  result.row(1) = (all.fractions.row(j) - common * all.fractions.row(i)) / rest;
  return result;
}

}  // namespace

SubsetExchanges exchanges_of(const SubsetProblem& problem, const std::vector<Index>& subset) {
  const Index q = problem.columns();
  const SubsetFit found = fit_subset(problem, subset);
  SubsetExchanges result{deflate(problem, subset), {}, {}, {}, 0.0};
  result.directions =
      problem.scaled(Eigen::all, subset) * (found.inverse * found.inverse.transpose());
  result.directions.colwise().normalize();
  result.fractions = result.directions.transpose() * problem.scaled;
  const auto target = result.deflated.columns.col(q);
  result.products = result.deflated.columns.leftCols(q).transpose() * target;
  result.residual = target.squaredNorm();
  return result;
}

std::optional<Index> replacement(const SubsetExchanges& all, Index i, Index j, double limit) {
  const Index q = all.products.size();
  const Matrix basis = released(all, i, j);
  double least = all.residual + basis.col(q).squaredNorm();
  const double before = least;
  std::optional<Index> best;
  for (Index c = 0; c < q; ++c) {
    if (!all.deflated.is_new(c)) continue;
    const double size = all.deflated.sizes[c] + basis.col(c).squaredNorm();
    const double product = all.products[c] + basis.col(c).dot(basis.col(q));
    const double left = before - product * product / size;
    if (!(left < std::min(least, limit))) continue;
    least = left;
    best = c;
  }
  return best;
}

}  // namespace lacuna
