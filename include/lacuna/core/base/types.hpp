// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
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

/// The numbers of a column, as functions of plain sequences take them.
inline std::span<const double> as_span(const Vector& values) {
  return {values.data(), static_cast<std::size_t>(values.size())};
}

}  // namespace lacuna
