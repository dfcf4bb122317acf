// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lacuna/core/base/types.hpp"

namespace lacuna {

/// A step of least squares in the directions that are determined.
struct DeterminedStep {
  Vector change;      ///< p
  Matrix covariance;  ///< p x p; nothing along directions that are held
  Matrix held;        ///< p x h: directions that are held, of unit length in relative changes
};

/// Solves normal x change = right. Where some of the p unknowns have a size (not 0), directions
/// in them of which the equations determine less than their size by three standard deviations -
/// whatever the other unknowns do - are held: eigenvectors of the Schur complement, scaled by
/// the sizes, with eigenvalues below 1/9.
/// @param size p entries: of each unknown with its sign, 0 where it is free to be anything.
/// @param kept unknowns that do not move.
DeterminedStep determined_step(const Matrix& normal, const Vector& right, const Vector& size,
                               const std::vector<Index>& kept = {});

}  // namespace lacuna
