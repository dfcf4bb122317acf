// SPDX-License-Identifier: MIT
#include "determined_step.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <vector>

namespace lacuna {
namespace {

/// Unknowns with and without a size.
struct Parts {
  std::vector<Index> sized, free;
};

Parts parts_of(const Vector& size) {
  Parts parts;
  for (Index j = 0; j < size.size(); ++j)
    (size[j] != 0.0 ? parts.sized : parts.free).push_back(j);
  return parts;
}

/// What is left of the normal matrix of the sized unknowns when the others do what they like.
Matrix schur_complement(const Matrix& normal, const Parts& parts) {
  const Matrix own = normal(parts.sized, parts.sized);
  if (parts.free.empty()) return own;
  const Matrix shared = normal(parts.free, parts.sized);
  const Matrix other = normal(parts.free, parts.free);
  return own - shared.transpose() * Eigen::LDLT<Matrix>(other).solve(shared);
}

/// Orthonormal columns that span what is orthogonal to `columns`.
Matrix complement(const Matrix& columns, Index rows) {
  if (columns.cols() == 0) return Matrix::Identity(rows, rows);
  const Matrix q = Eigen::HouseholderQR<Matrix>(columns).householderQ();
  return q.rightCols(rows - columns.cols());
}

/// The part of `unseen` that is about sized unknowns; all of it is, but for those of size 0.
Matrix unseen_of(const Matrix& unseen, const Parts& parts) {
  const auto rows = static_cast<Index>(parts.sized.size());
  Matrix own = Matrix::Zero(rows, unseen.cols());
  for (Index j = 0; j < rows; ++j)
    if (const Index row = parts.sized[static_cast<std::size_t>(j)]; row < unseen.rows())
      own.row(j) = unseen.row(row);
  return own;
}

}  // namespace

DeterminedStep determined_step(const Matrix& normal, const Vector& right, const Vector& size,
                               double told, const Matrix& unseen) {
  const Index p = right.size();
  const Parts parts = parts_of(size);
  const auto sized = static_cast<Index>(parts.sized.size());
  const Vector sizes = size(parts.sized);
  const Matrix held_anyway = unseen_of(unseen, parts);
  // Relative changes that are not held anyway, those of which the records tell least first.
  Matrix open = complement(held_anyway, sized);
  Index held = 0;
  if (open.cols() > 0) {
    const Matrix seen = sizes.asDiagonal() * open;
    const Eigen::SelfAdjointEigenSolver<Matrix> directions(
        seen.transpose() * schur_complement(normal, parts) * seen);
    open = (open * directions.eigenvectors()).eval();
    while (held < open.cols() && !(directions.eigenvalues()[held] >= 1.0 / (told * told)))
      ++held;
  }
  const Index moved = open.cols() - held;
  Matrix basis = Matrix::Zero(p, moved + static_cast<Index>(parts.free.size()));
  for (Index j = 0; j < sized; ++j)
    basis.row(parts.sized[static_cast<std::size_t>(j)]).head(moved) =
        sizes[j] * open.row(j).tail(moved);
  for (std::size_t j = 0; j < parts.free.size(); ++j)
    basis(parts.free[j], moved + static_cast<Index>(j)) = 1.0;
  Matrix reduced = basis.transpose() * normal * basis;
  const Vector scale = reduced.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  basis = (basis * scale.asDiagonal()).eval();
  reduced = (scale.asDiagonal() * reduced * scale.asDiagonal()).eval();
  const Eigen::LDLT<Matrix> factor(reduced);
  DeterminedStep step;
  step.change = basis * factor.solve(basis.transpose() * right);
  step.covariance = basis * factor.solve(basis.transpose());
  step.held = Matrix::Zero(p, held_anyway.cols() + held);
  for (Index j = 0; j < sized; ++j)
    step.held.row(parts.sized[static_cast<std::size_t>(j)]) << held_anyway.row(j),
        open.row(j).head(held);
  return step;
}

}  // namespace lacuna
