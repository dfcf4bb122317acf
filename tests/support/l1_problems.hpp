// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/base/random.hpp"
#include "lacuna/regression/stages/solvers.hpp"
#include "support/random_matrix.hpp"

namespace lacuna::testing {

/// Columns with singular values from 1 down to 1/condition, then scaled to unit norm.
inline Matrix ill_conditioned(Random& random, Index k, double condition) {
  const Matrix q1 = random_matrix(random, k, k).householderQr().householderQ();
  const Matrix q2 = random_matrix(random, k, k).householderQr().householderQ();
  Vector singular(k);
  for (Index i = 0; i < k; ++i)
    singular[i] = std::pow(condition, -static_cast<double>(i) / static_cast<double>(k - 1));
  Matrix a = q1 * singular.asDiagonal() * q2;
  a.colwise().normalize();
  return a;
}

/// k = 2..20, conditions 1 to 1e3, penalties from 1e-6 of the one that leaves nothing to 0.9.
inline L1Problem random_l1_problem(std::uint64_t seed) {
  Random random(seed);
  const auto k = static_cast<Index>(2 + random.below(19));
  const Matrix a = ill_conditioned(random, k, std::pow(10.0, random.uniform(0.0, 3.0)));
  const Eigen::HouseholderQR<Matrix> qr(a);
  L1Problem problem;
  problem.triangle = qr.matrixQR().triangularView<Eigen::Upper>();
  Vector z(k);
  for (Index i = 0; i < k; ++i) z[i] = random.uniform() < 0.4 ? 10.0 * random.normal() : 0.0;
  problem.target = problem.triangle * z + 0.1 * random_matrix(random, k, 1);
  const double largest =
      2.0 * (problem.triangle.transpose() * problem.target).cwiseAbs().maxCoeff();
  problem.penalty.setConstant(k, largest * std::pow(10.0, random.uniform(-6.0, -0.05)));
  problem.start = problem.triangle.triangularView<Eigen::Upper>().solve(problem.target);
  return problem;
}

/// Largest difference relative to the largest entry of a.
inline double relative_difference(const Vector& a, const Vector& b) {
  return (a - b).cwiseAbs().maxCoeff() / std::max(a.cwiseAbs().maxCoeff(), 1e-300);
}

}  // namespace lacuna::testing
