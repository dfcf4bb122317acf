// SPDX-License-Identifier: MIT
#pragma once

#include <complex>
#include <vector>

#include "lacuna/core/base/types.hpp"

namespace lacuna {

/// The eigenvalues of a square matrix; none where an entry is not finite or the iteration does
/// not converge. @throws ArgumentError when the matrix is not square.
std::vector<std::complex<double>> eigenvalues(const Matrix& a);

}  // namespace lacuna
