// SPDX-License-Identifier: MIT
#include "determined_step.hpp"

#include <algorithm>

#include "core/numerics/least_squares.hpp"
#include "core/numerics/symmetric_eigen.hpp"

namespace lacuna {
namespace {

/// Unknowns that may move, with and without a size.
struct Parts {
  std::vector<Index> sized, free;
};

Parts parts_of(const Vector& size, const std::vector<Index>& kept) {
  Parts parts;
  for (Index j = 0; j < size.size(); ++j)
    if (std::find(kept.begin(), kept.end(), j) == kept.end())
      (size[j] != 0.0 ? parts.sized : parts.free).push_back(j);
  return parts;
}

/// The rest of the normal matrix of the sized unknowns when the others do what they like.
Matrix schur_complement(const Matrix& normal, const Parts& parts) {
  const Matrix own = normal(parts.sized, parts.sized);
  if (parts.free.empty()) return own;
  const Matrix shared = normal(parts.free, parts.sized);
  const Matrix other = normal(parts.free, parts.free);
  return own - shared.transpose() * solve_symmetric(other, shared);
}

}  // namespace

DeterminedStep determined_step(const Matrix& normal, const Vector& right, const Vector& size,
                               const std::vector<Index>& kept) {
  constexpr double kStandardErrors = 3.0;  // in the size of an unknown that is determined
  const Index p = right.size();
  const Parts parts = parts_of(size, kept);
  const auto sized = static_cast<Index>(parts.sized.size());
  const Vector sizes = size(parts.sized);
  // Relative changes, those of which the records determine least first.
  Matrix changes(sized, sized);
  Index held = 0;
  if (sized > 0) {
    const SymmetricEigen directions = symmetric_eigen(
        sizes.asDiagonal() * schur_complement(normal, parts) * sizes.asDiagonal());
    changes = directions.vectors;
    while (held < sized &&
           !(directions.values[held] >= 1.0 / (kStandardErrors * kStandardErrors)))
      ++held;
  }
  const Index moved = sized - held;
  Matrix basis = Matrix::Zero(p, moved + static_cast<Index>(parts.free.size()));
  for (Index j = 0; j < sized; ++j)
    basis.row(parts.sized[static_cast<std::size_t>(j)]).head(moved) =
        sizes[j] * changes.row(j).tail(moved);
  for (std::size_t j = 0; j < parts.free.size(); ++j)
    basis(parts.free[j], moved + static_cast<Index>(j)) = 1.0;
  Matrix reduced = basis.transpose() * normal * basis;
  const Vector scale = reduced.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  basis = (basis * scale.asDiagonal()).eval();
  reduced = (scale.asDiagonal() * reduced * scale.asDiagonal()).eval();
  DeterminedStep step;
  step.change = basis * solve_symmetric(reduced, basis.transpose() * right);
  step.covariance = basis * solve_symmetric(reduced, basis.transpose());
  step.held = Matrix::Zero(p, held);
  for (Index j = 0; j < sized; ++j)
    step.held.row(parts.sized[static_cast<std::size_t>(j)]) = changes.row(j).head(held);
  return step;
}

}  // namespace lacuna
