// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <vector>

namespace lacuna {

/// Row, column and term numbers; signed, as everywhere in Eigen.
using Index = Eigen::Index;

/// A column of doubles.
using Vector = Eigen::VectorXd;

/// A dense column-major matrix of doubles.
using Matrix = Eigen::MatrixXd;

/// A set of term numbers (columns of Theta), strictly increasing.
using TermSet = std::vector<Index>;

}  // namespace lacuna
