// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/base/random.hpp"
#include "lacuna/regression/linear/least_squares_system.hpp"

namespace lacuna::testing {

/// Random columns, three of ten with a coefficient (1: 2, 4: -1, 7: 0.5), normal noise, and
/// gross errors of one sign in a fraction of the rows.
inline LeastSquaresSystem sparse_problem(Index rows, double noise, double outliers,
                                         std::uint64_t seed = 5) {
  Random random(seed);
  Matrix theta(rows, 10);
  Matrix y(rows, 1);
  for (Index i = 0; i < rows; ++i) {
    for (Index j = 0; j < 10; ++j) theta(i, j) = random.normal();
    y(i, 0) = 2.0 * theta(i, 1) - theta(i, 4) + 0.5 * theta(i, 7) + noise * random.normal();
    if (random.uniform() < outliers) y(i, 0) += 20.0 + 30.0 * theta(i, 0) * theta(i, 0);
  }
  std::vector<std::string> names;
  for (int j = 0; j < 10; ++j) names.push_back("t" + std::to_string(j));
  return {make_row_source(std::move(theta), std::move(y)), names, {"y"}};
}

/// The same coefficients and as many columns; columns and noise are series in which each value
/// remembers a fraction of the one before.
inline LeastSquaresSystem sparse_series(Index rows, double noise, double memory,
                                        std::uint64_t seed) {
  Random random(seed);
  Matrix all(rows, 11);
  for (auto column : all.colwise()) {
    double value = 0.0;
    for (double& entry : column) entry = value = memory * value + random.normal();
  }
  const Vector y = 2.0 * all.col(1) - all.col(4) + 0.5 * all.col(7) + 0.1 * noise * all.col(10);
  std::vector<std::string> names;
  for (int j = 0; j < 10; ++j) names.push_back("t" + std::to_string(j));
  return {make_row_source(all.leftCols(10), y), names, {"y"}};
}

/// The coefficients of sparse_problem.
inline Vector sparse_truth() {
  Vector h = Vector::Zero(10);
  h[1] = 2.0;
  h[4] = -1.0;
  h[7] = 0.5;
  return h;
}

}  // namespace lacuna::testing
