// SPDX-License-Identifier: MIT
// Problems given as rows, and what the rows themselves say of them.
#pragma once

#include <Eigen/QR>
#include <string>
#include <vector>

#include "core/base/random.hpp"
#include "lacuna/regression/linear/least_squares_system.hpp"

namespace lacuna::testing {

/// Theta and y, and the system made of them.
struct RandomRows {
  Matrix theta;
  Vector y;

  LeastSquaresSystem system() const {
    std::vector<std::string> names;
    for (Index j = 0; j < theta.cols(); ++j) names.push_back("t" + std::to_string(j));
    return {make_row_source(theta, y), names, {"y"}};
  }

  /// |y - Theta_S h| of least squares, by a rank-revealing decomposition of the rows.
  double residual(const std::vector<Index>& terms) const {
    if (terms.empty()) return y.norm();
    const Matrix columns = theta(Eigen::all, terms);
    return (y - columns * columns.colPivHouseholderQr().solve(y)).norm();
  }
};

/// Normal columns that share a part of each other, `true_terms` of them in y, and noise.
inline RandomRows random_rows(Index rows, Index terms, Index true_terms, double noise,
                              Random& random) {
  RandomRows data{Matrix(rows, terms), Vector::Zero(rows)};
  for (double& entry : data.theta.reshaped()) entry = random.normal();
  const double alike = random.uniform();
  for (Index j = 1; j < terms; ++j) data.theta.col(j) += alike * data.theta.col(j - 1);
  for (Index i = 0; i < true_terms; ++i)
    data.y +=
        random.uniform(-2.0, 2.0) *
        data.theta.col(static_cast<Index>(random.below(static_cast<std::uint64_t>(terms))));
  for (double& entry : data.y) entry += noise * random.normal();
  return data;
}

}  // namespace lacuna::testing
