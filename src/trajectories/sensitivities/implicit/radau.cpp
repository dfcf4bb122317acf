// SPDX-License-Identifier: MIT
#include "trajectories/sensitivities/implicit/radau.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>

#include "core/numerics/eigenvalues.hpp"

namespace lacuna {
namespace {

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

/// Writes what changes of the states are let pass in a step: a fraction of the state, and the
/// rounding of its rate.
void write_scale(const PassedErrors& passed, double h, const Matrix& slope, const Vector& x,
                 const Matrix& shift, Vector& scale) {
  constexpr double kRounding = 1e-15, kLeast = std::numeric_limits<double>::min();
  const Index m = x.size();
  scale.resize(m);
  for (Index i = 0; i < m; ++i) {
    double rounding = 0.0;
    for (Index j = 0; j < m; ++j) rounding += std::abs(slope(i, j)) * std::abs(x[j]);
    const double state =
        std::max({std::abs(x[i]), std::abs(x[i] + shift(i, 2)), kOfLargest * passed.seen[i]});
    scale[i] = std::max({passed.tolerance * state, kRounding * h * rounding, kLeast,
                         passed.accuracy.size() > 0 ? passed.accuracy[i] : 0.0});
  }
}

/// Root mean square of a change, in units of what is let pass.
double size_of(const Eigen::Ref<const Vector>& change, const Vector& scale) {
  return std::sqrt((change.array() / scale.array()).square().mean());
}

}  // namespace

void RadauFlow::begin(double tolerance) {
  passed_.tolerance = tolerance;
  step_ = 0.0;
  passed_.seen.resize(0);
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
  linearise(rates, drive, t, x);
  if (is_rising_from_nothing(x)) guess_sizes(rates, drive, t, longest, x);
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
    passed_.seen = passed_.seen.cwiseMax(x.cwiseAbs());
    const double next = h * std::clamp(factor, 0.2, 5.0);
    step_ = last ? std::max(step_, next) : next;
    return h;
  }
  return 0.0;
}

/// Whether sizes of states are to be guessed: before any step, and where one that has been 0 so
/// far begins to move.
bool RadauFlow::is_rising_from_nothing(const Vector& x) {
  if (passed_.seen.size() == 0) {
    passed_.seen = x.cwiseAbs();
    return (x.array() == 0.0).any();
  }
  return (passed_.seen.array() == 0.0 && rate_.array() != 0.0).any();
}

/// Sizes of the states that have been 0 so far: a thousandth of what one long step makes of
/// them, or their rates where there is none so long. Without, a state that rises by another
/// power of the time than the method is exact for would have no step whose error is a small
/// fraction of it.
void RadauFlow::guess_sizes(Rates& rates, DriveSlots drive, double t, double h,
                            const Vector& x) {
  if (!x.allFinite()) return;
  const bool is_solved = solve_stages(rates, drive, t, h, x);
  for (Index i = 0; i < x.size(); ++i) {
    const double shift = is_solved ? shift_(i, 2) : h * rate_[i];
    if (passed_.seen[i] == 0.0 && std::isfinite(shift))
      passed_.seen[i] = kOfLargest * std::abs(shift);
  }
}

/// Sets the rates and their slope at the begin of a step.
void RadauFlow::linearise(Rates& rates, DriveSlots drive, double t, const Vector& x) {
  const Index m = x.size();
  slots_.resize(Radau::kStages, rates.slots());
  slot_.resize(static_cast<std::size_t>(rates.slots()));
  begin_.resize(slot_.size());
  stage_rates_.resize(Radau::kStages, m);
  jacobian_.resize(Radau::kStages, static_cast<Index>(rates.jacobian_places().size()));
  columns_.resize(Radau::kStages, static_cast<Index>(rates.column_places().size()));
  rate_.resize(m);
  drive(t, begin_.data());
  std::copy(x.begin(), x.end(), begin_.begin());
  rates.rate(begin_.data(), rate_.data());
  slots_.row(0) = Eigen::Map<const Vector>(begin_.data(), rates.slots()).transpose();
  rates.derivatives(slots_.topRows(1), jacobian_.topRows(1), columns_.topRows(1));
  slope_.setZero(m, m);
  scatter(jacobian_, 0, rates.jacobian_places(), slope_);
}

/// Newton's method for the states of the stages, with the slope at the begin; false where it
/// does not converge.
bool RadauFlow::solve_stages(Rates& rates, DriveSlots drive, double t, double h,
                             const Vector& x) {
  for (Index row = 0; row < Radau::kStages; ++row) {
    drive(t + Radau::nodes()[static_cast<std::size_t>(row)] * h, slot_.data());
    slots_.row(row) = Eigen::Map<const Vector>(slot_.data(), rates.slots()).transpose();
  }
  shift_.setZero(x.size(), Radau::kStages);
  system_.factorise(h, slope_);
  double last = std::numeric_limits<double>::infinity();
  for (int i = 0; i < kMostIterations; ++i) {
    const double off = correct(rates, h, x);
    if (!std::isfinite(off) || off > 2.0 * last) return false;
    // Changes fall by the same factor each time: those to come are a geometric series.
    const double factor = i == 0 ? 0.5 : off / last;
    if (factor < 1.0 && off * factor / (1.0 - factor) < kNewton) return true;
    last = off;
  }
  return false;
}

/// One iteration of it. @return the size of the change, of the stage with the largest.
double RadauFlow::correct(Rates& rates, double h, const Vector& x) {
  const Index m = x.size();
  for (Index j = 0; j < Radau::kStages; ++j)
    slots_.row(j).head(m) = (x + shift_.col(j)).transpose();
  rates.rate(slots_, stage_rates_);
  through_inverse(shift_, weighted_);
  change_ = stage_rates_.transpose() - weighted_ / h;
  system_.solve(change_);
  shift_ += change_;
  write_scale(passed_, h, slope_, x, shift_, scale_);
  double off = 0.0;
  for (Index j = 0; j < Radau::kStages; ++j) off = std::max(off, size_of(change_.col(j), scale_));
  return change_.allFinite() ? off : std::numeric_limits<double>::infinity();
}

/// The estimated error of the step, in units of what is let pass.
double RadauFlow::error(Rates& rates, double h, const Vector& x) {
  const Vector known = (shift_.col(0) * (-13.0 - 7.0 * Radau::kRoot) +
                        shift_.col(1) * (-13.0 + 7.0 * Radau::kRoot) - shift_.col(2)) /
                       (3.0 * h);
  Vector off = system_.solve_real(rate_ + known);
  if (const double first = size_of(off, scale_); first <= 1.0) return first;
  const Vector moved = x + off;
  std::copy(moved.begin(), moved.end(), begin_.begin());
  Vector rate(x.size());
  rates.rate(begin_.data(), rate.data());
  off = system_.solve_real(rate + known);
  return size_of(off, scale_);
}

/// Carries derivatives through the step: the linearised equations of its stages.
void RadauFlow::vary(Rates& rates, double h, Matrix& sensitivity) {
  const Index m = sensitivity.rows(), parameters = sensitivity.cols() - m;
  std::vector<Index> moving;  // columns of 0 that no rate depends on stay 0
  for (Index j = 0; j < sensitivity.cols(); ++j)
    if (j >= m || (sensitivity.col(j).array() != 0.0).any()) moving.push_back(j);
  const auto columns = static_cast<Index>(moving.size());
  for (Index j = 0; j < Radau::kStages; ++j)
    slots_.row(j).head(m) += change_.col(j).transpose();
  rates.derivatives(slots_, jacobian_, columns_);
  for (std::size_t j = 0; j < 3; ++j) {
    slopes_.jacobian[j].setZero(m, m);
    scatter(jacobian_, static_cast<Index>(j), rates.jacobian_places(), slopes_.jacobian[j]);
    slopes_.forcing[j].setZero(m, columns);
    if (parameters > 0)
      scatter(columns_, static_cast<Index>(j), rates.column_places(),
              slopes_.forcing[j].rightCols(parameters));
  }
  Matrix part = sensitivity(Eigen::all, moving);
  system_.carry(h, slopes_, part);
  sensitivity(Eigen::all, moving) = part;
}

bool is_beyond_explicit_steps(const Eigen::Ref<const Matrix>& jacobian, double step) {
  constexpr double kStable = 2.785;  // a fact of the method
  const double bound = kStable / step;
  if (!(jacobian.cwiseAbs().rowwise().sum().maxCoeff() > bound) || !jacobian.allFinite())
    return false;  // no eigenvalue is larger than the largest sum of a row
  const std::vector<std::complex<double>> values = eigenvalues(jacobian);
  return std::any_of(values.begin(), values.end(), [&](const std::complex<double>& value) {
    return value.real() < 0.0 && std::abs(value) > bound;
  });
}

}  // namespace lacuna
