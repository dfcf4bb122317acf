// SPDX-License-Identifier: MIT
#include "trajectories/sensitivities/implicit/radau_system.hpp"

#include <gtest/gtest.h>

#include <unsupported/Eigen/KroneckerProduct>
#include <unsupported/Eigen/MatrixFunctions>

#include "support/random_matrix.hpp"

namespace lacuna {
namespace {

using testing::random_matrix;

// A_ij integrates the polynomials through the nodes: A c^k = c^(k+1) / (k+1) for k < 3.
TEST(RadauSystem, TheMethodIntegratesParabolasExactly) {
  const Eigen::Map<const Eigen::Vector3d> nodes(Radau::nodes().data());
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3d powers = nodes.array().pow(k);
    for (Index i = 0; i < 3; ++i) {
      const Eigen::Map<const Eigen::Vector3d> row(
          Radau::a()[static_cast<std::size_t>(i)].data());
      EXPECT_NEAR(row.dot(powers), std::pow(nodes[i], k + 1) / (k + 1), 1e-15);
    }
  }
}

TEST(RadauSystem, SolvesWhatTheWholeSystemOfStagesDoes) {
  constexpr double kStep = 0.3;
  for (const Index m : {1, 2, 5}) {
    const Matrix jacobian = random_matrix(m, m, 1), right = random_matrix(m, 6, 2);
    RadauSystem system;
    system.factorise(kStep, jacobian);
    Matrix stages = right;
    system.solve(stages);
    const Matrix whole =
        Eigen::kroneckerProduct(Matrix(Radau::inverse()) / kStep, Matrix::Identity(m, m)) -
        Eigen::kroneckerProduct(Matrix::Identity(3, 3), jacobian);
    for (Index column = 0; column < 2; ++column) {
      Vector all(3 * m), solved(3 * m);
      for (Index j = 0; j < 3; ++j) {
        all.segment(j * m, m) = right.col(2 * j + column);
        solved.segment(j * m, m) = stages.col(2 * j + column);
      }
      EXPECT_LT((whole * solved - all).norm(), 1e-11) << m;
    }
    const Vector known = right.col(0);
    const Vector real = system.solve_real(known);
    const double shift = ((known + jacobian * real).dot(real)) / real.squaredNorm() * kStep;
    EXPECT_NEAR(shift, 3.6378342527444957, 1e-9) << "Hairer and Wanner's value";
  }
}

TEST(RadauSystem, StagesGoThroughTheInverseOfTheMethod) {
  const Matrix stages = random_matrix(2, 6, 3);
  Matrix through;
  through_inverse(stages, through);
  for (Index i = 0; i < 3; ++i) {
    Matrix back = Matrix::Zero(2, 2);
    for (Index j = 0; j < 3; ++j)
      back += Radau::a()[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)] *
              through.middleCols(2 * j, 2);
    EXPECT_LT((back - stages.middleCols(2 * i, 2)).norm(), 1e-13);
  }
}

TEST(RadauSystem, DeviationsOfAStepAreThoseOfTheExponential) {
  constexpr double kStep = 0.05;
  const Matrix jacobian = random_matrix(3, 3, 4), begin = random_matrix(3, 2, 5);
  const Matrix zero = Matrix::Zero(3, 2);
  const Matrix end =
      radau_variation(kStep, {{jacobian, jacobian, jacobian}, {zero, zero, zero}}, begin);
  const Matrix exact = Matrix(kStep * jacobian).exp() * begin;
  EXPECT_LT((end - exact).norm(), 1e-7);
  EXPECT_GT((end - begin).norm(), 1e-2);
}

}  // namespace
}  // namespace lacuna
