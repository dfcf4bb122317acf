// SPDX-License-Identifier: MIT
#include "deflated_columns.hpp"

#include <cmath>

namespace lacuna {

void DeflatedColumns::take(Index j) {
  const Vector direction = columns.col(j) / std::sqrt(sizes[j]);
  const Eigen::RowVectorXd fractions = direction.transpose() * columns;
  columns.noalias() -= direction * fractions;
  sizes = columns.leftCols(sizes.size()).colwise().squaredNorm();
  sizes[j] = 0.0;
}

Vector DeflatedColumns::gains() const {
  const Index q = sizes.size();
  const Vector fractions = columns.leftCols(q).transpose() * columns.col(q);
  Vector result = Vector::Zero(q);
  for (Index j = 0; j < q; ++j)
    if (is_new(j)) result[j] = fractions[j] * fractions[j] / sizes[j];
  return result;
}

DeflatedColumns deflate(const SubsetProblem& problem, const std::vector<Index>& subset) {
  DeflatedColumns deflated{problem.scaled,
                           problem.scaled.leftCols(problem.columns()).colwise().squaredNorm()};
  for (const Index j : subset)
    if (deflated.is_new(j)) deflated.take(j);
  return deflated;
}

}  // namespace lacuna
