// SPDX-License-Identifier: MIT
#include "trajectories/subset_selection/subset_problem.hpp"

#include "core/base/check.hpp"
#include "core/numerics/qr.hpp"
#include "deflated_columns.hpp"

namespace lacuna {
namespace {

void check_subset(const SubsetProblem& problem, const std::vector<Index>& subset) {
  const Index columns = problem.columns();
  check_argument(problem.scaled.cols() == columns + 1, "subset problem",
                 "the triangle has not one column for each length and one for the target");
  for (const Index j : subset) check_number(j, columns, "subset problem", "column");
  check_argument(static_cast<Index>(subset.size()) <= problem.scaled.rows(), "subset problem",
                 "the subset has more columns than the triangle has rows");
}

}  // namespace

SubsetProblem subset_problem(const Matrix& triangle) {
  check_argument(triangle.cols() > 0 && triangle.rows() > 0, "subset_problem",
                 "the triangle is empty", "give the target as its last column");
  const Index q = triangle.cols() - 1;
  SubsetProblem problem{triangle, triangle.leftCols(q).colwise().norm()};
  for (Index j = 0; j < q; ++j)
    if (problem.norms[j] > 0.0) problem.scaled.col(j) /= problem.norms[j];
  return problem;
}

SubsetFit fit_subset(const SubsetProblem& problem, const std::vector<Index>& subset) {
  check_subset(problem, subset);
  const Matrix& scaled = problem.scaled;
  const auto k = static_cast<Index>(subset.size());
  Matrix part(scaled.rows(), k + 1);
  for (Index i = 0; i < k; ++i) part.col(i) = scaled.col(subset[static_cast<std::size_t>(i)]);
  part.col(k) = scaled.col(problem.columns());
  const Matrix r = Qr(part).triangle();
  SubsetFit fit;
  const auto triangle = r.topLeftCorner(k, k).triangularView<Eigen::Upper>();
  fit.inverse = triangle.solve(Matrix::Identity(k, k));
  fit.solution = fit.inverse * r.col(k).head(k);
  fit.residual = k < r.rows() ? r(k, k) * r(k, k) : 0.0;
  return fit;
}

Vector losses_of(const SubsetFit& fit) {
  return fit.solution.array().square() / fit.inverse.rowwise().squaredNorm().array();
}

Vector gains_of(const SubsetProblem& problem, const std::vector<Index>& subset) {
  check_subset(problem, subset);
  Vector result = deflate(problem, subset).gains();
  for (const Index j : subset) result[j] = 0.0;
  return result;
}

Vector solution_of(const SubsetProblem& problem, const std::vector<Index>& subset) {
  Vector h = fit_subset(problem, subset).solution;
  for (Index i = 0; i < h.size(); ++i)
    h[i] /= problem.norms[subset[static_cast<std::size_t>(i)]];
  return h;
}

Vector variances_of(const SubsetProblem& problem, const std::vector<Index>& subset) {
  Vector variances = fit_subset(problem, subset).inverse.rowwise().squaredNorm();
  for (Index i = 0; i < variances.size(); ++i) {
    const double norm = problem.norms[subset[static_cast<std::size_t>(i)]];
    variances[i] /= norm * norm;
  }
  return variances;
}

}  // namespace lacuna
