// SPDX-License-Identifier: MIT
#include "trajectories/sensitivities/radau.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>

namespace lacuna {
namespace {

constexpr double kRoot = 2.4494897427831780982;  // of 6

/// Facts of the method: a state counts as a thousandth of its largest value at least; Newton's
/// method leaves a thousandth of the error that is let pass.
constexpr double kOfLargest = 1e-3, kNewton = 1e-3;
constexpr int kMostIterations = 10, kMostSteps = 20000;

/// Adds the entries of a row to the places where they stand in a matrix.
void scatter(const Matrix& entries, Index row, const std::vector<MatrixPlace>& places,
             Eigen::Ref<Matrix> matrix) {
  for (std::size_t i = 0; i < places.size(); ++i)
    matrix(places[i].row, places[i].column) += entries(row, static_cast<Index>(i));
}

/// Writes 1 - h A x J, whose blocks are the stages.
template <class Slopes>
void stage_system(double h, Index m, const Slopes& slope, Matrix& system) {
  system.setIdentity(3 * m, 3 * m);
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      system.block(static_cast<Index>(i) * m, static_cast<Index>(j) * m, m, m) -=
          h * Radau::a()[i][j] * slope(j);
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

Matrix radau_variation(double h, const RadauSlopes& slopes, const Matrix& deviations) {
  const Index m = deviations.rows();
  Matrix right = deviations.replicate(3, 1);
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      right.middleRows(static_cast<Index>(i) * m, m) +=
          h * Radau::a()[i][j] * slopes.forcing[j];
  Matrix system;
  stage_system(h, m, [&](std::size_t j) -> const Matrix& { return slopes.jacobian[j]; },
               system);
  return Matrix(system.partialPivLu().solve(right)).bottomRows(m);
}

void RadauFlow::begin(double tolerance) {
  tolerance_ = tolerance;
  step_ = 0.0;
  seen_.resize(0);
}

bool RadauFlow::advance(Rates& rates, DriveSlots drive, double t0, double t1, Vector& x,
                        Matrix* sensitivity) {
  const double length = t1 - t0;
  double done = 0.0;
  for (int count = 0; done < length; ++count) {
    const double left = length - done;
    const double took =
        count == kMostSteps ? 0.0 : step(rates, drive, t0 + done, left, x, sensitivity);
    if (!(took > 0.0)) return false;
    done = took == left ? length : done + took;
  }
  return true;
}

double RadauFlow::step(Rates& rates, DriveSlots drive, double t, double longest, Vector& x,
                       Matrix* sensitivity) {
  if (!(step_ > 0.0)) step_ = longest;
  if (seen_.size() == 0) guess_sizes(rates, drive, t, longest, x);
  for (int count = 0; count < kMostSteps; ++count) {
    if (t + step_ == t || !x.allFinite() || allowed_-- <= 0) return 0.0;
    const bool last = 1.01 * step_ >= longest;
    const double h = last ? longest : step_;
    const double off = solve_stages(rates, drive, t, h, x)
                           ? error(rates, h, x)
                           : std::numeric_limits<double>::infinity();
    const double factor = 0.9 * std::pow(std::max(off, 1e-10), -0.25);
    if (!(off <= 1.0)) {
      step_ = h * (std::isfinite(off) ? std::clamp(factor, 0.1, 0.9) : 0.25);
      continue;
    }
    if (sensitivity) vary(rates, h, *sensitivity);
    x += shift_.col(2);
    seen_ = seen_.cwiseMax(x.cwiseAbs());
    const double next = h * std::clamp(factor, 0.2, 5.0);
    step_ = last ? std::max(step_, next) : next;
    return h;
  }
  return 0.0;
}

/// Sizes of the states before any step: their own, and for those that begin at 0 a thousandth of
/// what one long step makes of them. Without, a state that rises by a higher power of the time
/// than the method is exact for would have no step whose error is a small fraction of it.
void RadauFlow::guess_sizes(Rates& rates, DriveSlots drive, double t, double h,
                            const Vector& x) {
  seen_ = x.cwiseAbs();
  if ((x.array() != 0.0).all() || !x.allFinite() || !solve_stages(rates, drive, t, h, x)) return;
  for (Index i = 0; i < x.size(); ++i)
    if (x[i] == 0.0 && std::isfinite(shift_(i, 2)))
      seen_[i] = kOfLargest * std::abs(shift_(i, 2));
}

/// Newton's method for the states of the stages; false where it does not converge.
bool RadauFlow::solve_stages(Rates& rates, DriveSlots drive, double t, double h,
                             const Vector& x) {
  const Index m = x.size();
  slots_.resize(4, rates.slots());
  slot_.resize(static_cast<std::size_t>(rates.slots()));
  for (Index row = 0; row < 4; ++row) {
    drive(row == 0 ? t : t + Radau::nodes()[static_cast<std::size_t>(row - 1)] * h,
          slot_.data());
    slots_.row(row) = Eigen::Map<const Vector>(slot_.data(), rates.slots()).transpose();
  }
  shift_.setZero(m, 3);
  double last = std::numeric_limits<double>::infinity();
  for (int i = 0; i < kMostIterations; ++i) {
    evaluate(rates, x);
    correct(h);
    shift_.reshaped() += change_;
    set_scale(h, x);
    double off = 0.0;
    for (Index j = 0; j < 3; ++j) off = std::max(off, size(change_.segment(j * m, m)));
    if (!std::isfinite(off) || off > 2.0 * last) return false;
    if (off < kNewton) return true;
    last = off;
  }
  return false;
}

void RadauFlow::evaluate(Rates& rates, const Vector& x) {
  const Index m = x.size();
  slots_.row(0).head(m) = x.transpose();
  for (Index j = 0; j < 3; ++j) slots_.row(j + 1).head(m) = (x + shift_.col(j)).transpose();
  rate_.resize(4, m);
  jacobian_.resize(4, static_cast<Index>(rates.jacobian_places().size()));
  columns_.resize(4, static_cast<Index>(rates.column_places().size()));
  rates.rate(slots_, rate_);
  rates.derivatives(slots_, jacobian_, columns_);
  for (std::size_t j = 0; j < 4; ++j) {
    slope_[j].setZero(m, m);
    scatter(jacobian_, static_cast<Index>(j), rates.jacobian_places(), slope_[j]);
  }
}

/// Sets the step of Newton's method, its m x 3 values one after another.
void RadauFlow::correct(double h) {
  const Index m = shift_.rows();
  left_ = -shift_.reshaped();
  for (Index i = 0; i < 3; ++i)
    for (Index j = 0; j < 3; ++j)
      left_.segment(i * m, m) +=
          h * Radau::a()[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)] *
          rate_.row(j + 1).transpose();
  stage_system(h, m, [&](std::size_t j) -> const Matrix& { return slope_[j + 1]; }, system_);
  factors_.compute(system_);
  change_ = factors_.solve(left_);
}

/// The estimated error of the step, in units of what is let pass.
double RadauFlow::error(Rates& rates, double h, const Vector& x) {
  constexpr double kReal = 3.6378342527444957;  // the real eigenvalue of the inverse of A
  const Index m = x.size();
  const Vector known = (shift_.col(0) * (-13.0 - 7.0 * kRoot) +
                        shift_.col(1) * (-13.0 + 7.0 * kRoot) - shift_.col(2)) /
                       (3.0 * h);
  system_ = kReal / h * Matrix::Identity(m, m) - slope_[0];
  factors_.compute(system_);
  Vector off = factors_.solve(rate_.row(0).transpose() + known);
  if (const double first = size(off); first <= 1.0) return first;
  slots_.row(0).head(m) = (x + off).transpose();
  rates.rate(slots_, rate_);
  off = factors_.solve(rate_.row(0).transpose() + known);
  return size(off);
}

/// Sets what changes of the states are let pass: a fraction of the state, and the rounding of
/// its rate.
void RadauFlow::set_scale(double h, const Vector& x) {
  constexpr double kRounding = 1e-15, kLeast = std::numeric_limits<double>::min();
  const Index m = x.size();
  scale_.resize(m);
  for (Index i = 0; i < m; ++i) {
    double rounding = 0.0;
    for (Index j = 0; j < m; ++j) rounding += std::abs(slope_[0](i, j)) * std::abs(x[j]);
    const double state = std::max({std::abs(x[i]), std::abs(x[i] + shift_(i, 2)),
                                   kOfLargest * seen_[i]});
    scale_[i] = std::max({tolerance_ * state, kRounding * h * rounding, kLeast,
                          accuracy_.size() > 0 ? accuracy_[i] : 0.0});
  }
}

/// Root mean square of a change, in units of what is let pass.
double RadauFlow::size(const Eigen::Ref<const Vector>& change) const {
  return std::sqrt((change.array() / scale_.array()).square().mean());
}

void RadauFlow::vary(Rates& rates, double h, Matrix& sensitivity) const {
  const Index m = sensitivity.rows(), parameters = sensitivity.cols() - m;
  RadauSlopes slopes;
  for (std::size_t j = 0; j < 3; ++j) {
    slopes.jacobian[j] = slope_[j + 1];
    slopes.forcing[j] = Matrix::Zero(m, m + parameters);
    if (parameters > 0)
      scatter(columns_, static_cast<Index>(j) + 1, rates.column_places(),
              slopes.forcing[j].rightCols(parameters));
  }
  sensitivity = radau_variation(h, slopes, sensitivity);
}

bool is_beyond_explicit_steps(const Eigen::Ref<const Matrix>& jacobian, double step) {
  constexpr double kStable = 2.785;  // a fact of the method
  const double bound = kStable / step;
  if (!(jacobian.cwiseAbs().rowwise().sum().maxCoeff() > bound) || !jacobian.allFinite())
    return false;  // no eigenvalue is larger than the largest sum of a row
  const Eigen::EigenSolver<Matrix> solver(jacobian, false);
  if (solver.info() != Eigen::Success) return false;
  const auto& values = solver.eigenvalues();
  return std::any_of(values.begin(), values.end(), [&](const std::complex<double>& value) {
    return value.real() < 0.0 && std::abs(value) > bound;
  });
}

}  // namespace lacuna
