// SPDX-License-Identifier: MIT
// The linear systems of implicit steps.
#pragma once

#include <Eigen/LU>
#include <array>

#include "lacuna/core/base/types.hpp"

namespace lacuna {

/// Nodes and coefficients of the method Radau IIA of order 5: three stages, L-stable, the last
/// one is the new state (Hairer and Wanner, Solving Ordinary Differential Equations II, IV.5).
struct Radau {
  static constexpr Index kStages = 3;
  static constexpr double kRoot = 2.4494897427831780982;  // of 6
  static const std::array<double, 3>& nodes();
  static const std::array<std::array<double, 3>, 3>& a();
  static const Eigen::Matrix3d& inverse();  ///< of A
};

/// Rates linearised at the stages of a step: d' = J d + G for columns of deviations d.
struct RadauSlopes {
  std::array<Matrix, 3> jacobian;  ///< m x m
  std::array<Matrix, 3> forcing;   ///< m x columns
};

/// Deviations at the end of a step of length h from those at its begin (m x columns): the
/// variational equations by the same method, which are the exact derivatives of its steps.
Matrix radau_variation(double h, const RadauSlopes& slopes, const Matrix& deviations);

/// The equations of the stages of a step for d' = J d with one J: those of its 3 m unknowns fall
/// into one real and one complex system of m, by the eigenvectors of the inverse of A (IV.8
/// there). Their factors take an eighth of the time of those of the whole.
class RadauSystem {
 public:
  /// @param jacobian J, m x m.
  void factorise(double h, const Matrix& jacobian);

  /// Solves Z A^-T / h - J Z = R for the stages, the columns of m x 3 matrices.
  /// @param stages R, m x 3 c: c columns of the first stage, then of the second and the third.
  ///   Receives Z, alike.
  void solve(Eigen::Ref<Matrix> stages);

  /// radau_variation(), by iterations with the factors where slopes hardly change within the
  /// step. @param deviations at its begin; receives those at its end.
  void carry(double h, const RadauSlopes& slopes, Matrix& deviations);

  /// Solves (g / h - J) y = r, g the real eigenvalue of the inverse of A.
  auto solve_real(const Vector& right) const { return real_factors_.solve(right); }

 private:
  bool iterate(double h, const RadauSlopes& slopes, Matrix& deviations);

  Matrix real_system_, real_;
  Eigen::MatrixXcd pair_system_, pair_;
  Eigen::PartialPivLU<Matrix> real_factors_;
  Eigen::PartialPivLU<Eigen::MatrixXcd> pair_factors_;
  Matrix shifts_, defect_, weighted_;  // of stages, in carry()
};

/// Writes `stages` A^-T for m x 3 c stages, blocks of c columns as above.
void through_inverse(const Matrix& stages, Matrix& result);

}  // namespace lacuna
