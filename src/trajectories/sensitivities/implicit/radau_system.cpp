// SPDX-License-Identifier: MIT
#include "trajectories/sensitivities/implicit/radau_system.hpp"

#include <cmath>
#include <complex>

namespace lacuna {
namespace {

/// Eigenvalues of the inverse of A, one real and a pair of conjugates, with their right and left
/// eigenvectors, whose products are 1.
struct Modes {
  double real;
  std::complex<double> pair;
  Eigen::Vector3d real_right, real_left;
  Eigen::Vector3cd pair_right, pair_left;
};

/// What is orthogonal to two vectors, without conjugates.
template <class Scalar>
Eigen::Matrix<Scalar, 3, 1> orthogonal_to(const Eigen::Matrix<Scalar, 3, 1>& a,
                                          const Eigen::Matrix<Scalar, 3, 1>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// The eigenvectors of a simple eigenvalue: M - value has rank 2, so two of its rows (columns) give
/// the right (left) one.
template <class Scalar>
void write_eigenvectors(Scalar value, Eigen::Matrix<Scalar, 3, 1>& right,
                        Eigen::Matrix<Scalar, 3, 1>& left) {
  Eigen::Matrix<Scalar, 3, 3> shifted = Radau::inverse().cast<Scalar>();
  for (Index i = 0; i < 3; ++i) shifted(i, i) -= value;
  right = orthogonal_to<Scalar>(shifted.row(0).transpose(), shifted.row(1).transpose());
  left = orthogonal_to<Scalar>(shifted.col(0), shifted.col(1));
  Scalar product(0.0);
  for (Index i = 0; i < 3; ++i) product += left[i] * right[i];
  left /= product;
}

/// The eigenvalues are the zeros of z^3 - 9 z^2 + 36 z - 60 (Hairer and Wanner, IV.8; the
/// denominator of the stability function, Table IV.3.1): with z = 3 + u, u^3 + 9 u = 6.
Modes find_modes() {
  const double low = std::cbrt(3.0), high = std::cbrt(9.0);
  Modes modes;
  modes.real = 3.0 + high - low;
  modes.pair = {3.0 - 0.5 * (high - low), 0.5 * std::sqrt(3.0) * (high + low)};
  write_eigenvectors(modes.real, modes.real_right, modes.real_left);
  write_eigenvectors(modes.pair, modes.pair_right, modes.pair_left);
  return modes;
}

const Modes& modes() {
  static const Modes found = find_modes();
  return found;
}

/// Writes 1 - h A x J, whose blocks are the stages.
Matrix stage_system(double h, const std::array<Matrix, 3>& slope) {
  const Index m = slope[0].rows();
  Matrix system = Matrix::Identity(3 * m, 3 * m);
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      system.block(static_cast<Index>(i) * m, static_cast<Index>(j) * m, m, m) -=
          h * Radau::a()[i][j] * slope[j];
  return system;
}

}  // namespace

const std::array<double, 3>& Radau::nodes() {
  static const std::array<double, 3> nodes{(4.0 - kRoot) / 10.0, (4.0 + kRoot) / 10.0, 1.0};
  return nodes;
}

const std::array<std::array<double, 3>, 3>& Radau::a() {
  static const std::array<std::array<double, 3>, 3> a{
      {{(88.0 - 7.0 * kRoot) / 360.0, (296.0 - 169.0 * kRoot) / 1800.0,
        (-2.0 + 3.0 * kRoot) / 225.0},
       {(296.0 + 169.0 * kRoot) / 1800.0, (88.0 + 7.0 * kRoot) / 360.0,
        (-2.0 - 3.0 * kRoot) / 225.0},
       {(16.0 - kRoot) / 36.0, (16.0 + kRoot) / 36.0, 1.0 / 9.0}}};
  return a;
}

const Eigen::Matrix3d& Radau::inverse() {
  static const Eigen::Matrix3d inverse = [] {
    Eigen::Matrix3d matrix;
    for (Index i = 0; i < 3; ++i)
      for (Index j = 0; j < 3; ++j)
        matrix(i, j) = a()[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
    return Eigen::Matrix3d(matrix.inverse());
  }();
  return inverse;
}

Matrix radau_variation(double h, const RadauSlopes& slopes, const Matrix& deviations) {
  const Index m = deviations.rows();
  Matrix right = deviations.replicate(3, 1);
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      right.middleRows(static_cast<Index>(i) * m, m) +=
          h * Radau::a()[i][j] * slopes.forcing[j];
  return Matrix(stage_system(h, slopes.jacobian).partialPivLu().solve(right)).bottomRows(m);
}

void RadauSystem::factorise(double h, const Matrix& jacobian) {
  real_system_ = -jacobian;
  real_system_.diagonal().array() += modes().real / h;
  real_factors_.compute(real_system_);
  pair_system_ = -jacobian.cast<std::complex<double>>();
  pair_system_.diagonal().array() += modes().pair / h;
  pair_factors_.compute(pair_system_);
}

void RadauSystem::solve(Eigen::Ref<Matrix> stages) {
  const Modes& mode = modes();
  const Index columns = stages.cols() / Radau::kStages;
  const auto stage = [&](Index j) { return stages.middleCols(j * columns, columns); };
  real_.setZero(stages.rows(), columns);
  pair_.setZero(stages.rows(), columns);
  for (Index j = 0; j < Radau::kStages; ++j) {
    real_ += mode.real_left[j] * stage(j);
    pair_ += mode.pair_left[j] * stage(j);
  }
  real_ = real_factors_.solve(real_);
  pair_ = pair_factors_.solve(pair_);
  for (Index j = 0; j < Radau::kStages; ++j)
    stage(j) = mode.real_right[j] * real_ + 2.0 * (mode.pair_right[j] * pair_).real();
}

void RadauSystem::carry(double h, const RadauSlopes& slopes, Matrix& deviations) {
  if (!iterate(h, slopes, deviations)) deviations = radau_variation(h, slopes, deviations);
}

/// @return whether it converges; else deviations stay as they are.
bool RadauSystem::iterate(double h, const RadauSlopes& slopes, Matrix& deviations) {
  constexpr double kExact = 1e-11;  // a fact of doubles: of each column, rounding leaves less
  constexpr int kMost = 5;          // a fact of cost: then factors of the whole are no slower
  const Index columns = deviations.cols();
  const auto stage = [&](Matrix& all, std::size_t j) {
    return all.middleCols(static_cast<Index>(j) * columns, columns);
  };
  shifts_.setZero(deviations.rows(), Radau::kStages * columns);
  for (int i = 0; i < kMost; ++i) {
    through_inverse(shifts_, weighted_);
    defect_ = weighted_ / -h;
    for (std::size_t j = 0; j < 3; ++j) {
      stage(defect_, j) += slopes.forcing[j];
      stage(defect_, j).noalias() += slopes.jacobian[j] * (deviations + stage(shifts_, j));
    }
    solve(defect_);
    shifts_ += defect_;
    const auto change = stage(defect_, 2).colwise().norm();
    const auto now = (deviations + stage(shifts_, 2)).colwise().norm();
    if ((change.array() <= kExact * now.array()).all()) {
      deviations += stage(shifts_, 2);
      return true;
    }
  }
  return false;
}

void through_inverse(const Matrix& stages, Matrix& result) {
  const Index columns = stages.cols() / Radau::kStages;
  result.setZero(stages.rows(), stages.cols());
  for (Index i = 0; i < Radau::kStages; ++i)
    for (Index j = 0; j < Radau::kStages; ++j)
      result.middleCols(i * columns, columns) +=
          Radau::inverse()(i, j) * stages.middleCols(j * columns, columns);
}

}  // namespace lacuna
