// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/core/types.hpp"

namespace lacuna {

/// A step of least squares in the directions that are determined.
struct DeterminedStep {
  Vector change;      ///< p
  Matrix covariance;  ///< p x p; nothing along directions that are held
  Matrix held;        ///< p x h: directions that are held, of unit length in relative changes
};

/// Solves normal x change = right. Where some of the p unknowns have a size (not 0), directions
/// in them of which the equations tell less than `told` times that size - whatever the other
/// unknowns do - are held: eigenvectors of the Schur complement, scaled by the sizes, with
/// eigenvalues below 1 / told^2.
/// @param size p entries: of each unknown with its sign, 0 where it is free to be anything.
/// @param unseen orthonormal columns, of relative changes of the first unknowns: directions
///   that are held in any case; or 0 x 0.
DeterminedStep determined_step(const Matrix& normal, const Vector& right, const Vector& size,
                               double told, const Matrix& unseen = {});

}  // namespace lacuna
