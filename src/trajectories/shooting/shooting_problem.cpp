// SPDX-License-Identifier: MIT
#include "shooting_problem.hpp"

#include <cmath>
#include <limits>
#include <utility>

#include "core/numerics/qr.hpp"
namespace lacuna {
namespace {

/// Pivots below this fraction of the norm of their column are rounding.
constexpr double kRounding = 1e-12;

void add_row(RowFold& fold, Index column, double value, double target) {
  double* row = fold.next_row();
  for (Index j = 0; j < fold.columns(); ++j) row[j * fold.stride()] = 0.0;
  row[column * fold.stride()] = value;
  row[(fold.columns() - 1) * fold.stride()] = target;
}

}  // namespace

Matrix covariance_of(const Eigen::Ref<const Matrix>& triangle) {
  const Index n = triangle.cols();
  Vector norms = triangle.colwise().norm();
  const double infinity = std::numeric_limits<double>::infinity();
  for (Index j = 0; j < n; ++j)
    if (std::abs(triangle(j, j)) <= kRounding * norms[j] || norms[j] == 0.0)
      return Matrix::Constant(n, n, infinity);
  const Matrix scaled = triangle * norms.cwiseInverse().asDiagonal();
  const Matrix inverse = scaled.triangularView<Eigen::Upper>().solve(Matrix::Identity(n, n));
  const Matrix correlation = inverse * inverse.transpose();
  return norms.cwiseInverse().asDiagonal() * correlation * norms.cwiseInverse().asDiagonal();
}

ShootingProblem::ShootingProblem(const ParametrisedModel& model, const Dataset& data,
                                 std::optional<double> huber, int threads)
    : model_(model),
      record_(shooting_record(model, data)),
      rates_(model_),
      huber_(huber),
      priors_(model.priors()),
      threads_(threads) {
  set_scheme({&runge_kutta_4(), 1});
  sigma_ = Vector::Ones(static_cast<Index>(record_.measured.size()));
}

std::shared_ptr<const StageSignals> ShootingProblem::signals_of(const StepScheme& scheme) {
  for (const auto& known : known_signals_)
    if (known->scheme == scheme) return known;
  known_signals_.push_back(
      std::make_shared<const StageSignals>(stage_signals(record_, rates_, scheme)));
  return known_signals_.back();
}

void ShootingProblem::set_scheme(const StepScheme& scheme) {
  windows_ = std::make_unique<WindowGroups>(rates_, signals_of(scheme), threads_);
}

double ShootingProblem::loss(double residual) const {
  const double size = std::abs(residual);
  if (!huber_ || size <= *huber_) return residual * residual;
  return 2.0 * *huber_ * size - *huber_ * *huber_;
}

void ShootingProblem::evaluate(const WindowPlan& plan, ShootingPoint& point) {
  make_room(signals(), rates_.dimension(), record_.samples(), point.orbits);
  windows_->simulate(plan, point.parameters, point.starts, point.orbits);
  point.finite = point.orbits.diverged.empty();
  const Matrix r = residuals(plan, point);
  double cost = 0.0;
  for (Index i = 0; i < r.size(); ++i) cost += loss(r.data()[i]);
  for (std::size_t i = 0; i < priors_.size(); ++i)
    if (priors_[i])
      cost += std::pow(
          (point.parameters[static_cast<Index>(i)] - priors_[i]->value) / priors_[i]->tolerance,
          2);
  point.cost = cost;
  point.finite = point.finite && std::isfinite(cost);
}

Matrix ShootingProblem::residuals(const WindowPlan& plan, const ShootingPoint& point) const {
  Matrix r = Matrix::Zero(record_.values.rows(), record_.values.cols());
  for (const Window& window : plan)
    for (std::size_t q = 0; q < record_.measured.size(); ++q) {
      const auto column = static_cast<Index>(q);
      r.col(column).segment(window.first, window.samples) =
          (record_.values.col(column).segment(window.first, window.samples) -
           point.orbits.samples.col(record_.measured[q])
               .segment(window.first, window.samples)) /
          sigma_[column];
    }
  return r;
}

Matrix ShootingProblem::row_weights(const ShootingPoint& point) const {
  Matrix weights(record_.values.rows(), record_.values.cols());
  for (Index q = 0; q < weights.cols(); ++q) weights.col(q).setConstant(1.0 / sigma_[q]);
  if (!huber_) return weights;
  for (Index q = 0; q < weights.cols(); ++q) {
    const Index k = record_.measured[static_cast<std::size_t>(q)];
    for (Index i = 0; i < weights.rows(); ++i) {
      const double size =
          std::abs(record_.values(i, q) - point.orbits.samples(i, k)) / sigma_[q];
      if (size > *huber_) weights(i, q) *= std::sqrt(*huber_ / size);
    }
  }
  return weights;
}

ShootingLinearisation ShootingProblem::linearise(const WindowPlan& plan,
                                                 const ShootingPoint& point) {
  const Matrix weights = row_weights(point);
  const Index m = rates_.dimension(), rest = rates_.columns() + 1;
  ShootingLinearisation linear{{}, {}, {}, Matrix::Zero(record_.samples(), m * m)};
  linear.windows = windows_->triangles({record_, signals(), plan, point.orbits, weights},
                                       point.parameters, linear.transitions);
  RowFold fold(rest);
  add_priors(point.parameters, fold);
  linear.priors = *fold.finish();
  for (const Matrix& triangle : linear.windows)
    fold.add_triangle(triangle.bottomRightCorner(rest, rest));
  fold.add_triangle(linear.priors);
  linear.reduced = *fold.finish();
  return linear;
}

void ShootingProblem::sensitivities(const WindowPlan& plan, const ShootingPoint& point,
                                    FunctionRef<void(Index, Index, const Matrix&)> visit) {
  const Matrix weights = row_weights(point);
  windows_->sensitivities({record_, signals(), plan, point.orbits, weights}, point.parameters,
                          visit);
}

void ShootingProblem::add_priors(const Vector& parameters, RowFold& fold) const {
  for (std::size_t i = 0; i < priors_.size(); ++i) {
    if (!priors_[i]) continue;
    const auto column = static_cast<Index>(i);
    add_row(fold, column, 1.0 / priors_[i]->tolerance,
            (priors_[i]->value - parameters[column]) / priors_[i]->tolerance);
  }
}

}  // namespace lacuna
