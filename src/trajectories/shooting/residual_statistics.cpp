// SPDX-License-Identifier: MIT
#include "trajectories/shooting/residual_statistics.hpp"

#include <algorithm>
#include <cmath>

#include "residual_analysis.hpp"

namespace lacuna {
namespace {

/// One chance in a thousand that white noise is called structured.
constexpr double kSignificance = 3.09;

/// A residual above twice the noise of the record has more in it than noise.
constexpr double kAboveNoise = 2.0;

/// Directions of the columns of one window: rows of Q, so that H_ij = q_i' q_j.
class WindowDirections {
 public:
  WindowDirections(const Matrix& window, const Matrix& reduced, Index dimension)
      : start_inverse_(inverse(window.topLeftCorner(dimension, dimension))),
        elimination_(start_inverse_ *
                     window.block(0, dimension, dimension, reduced.cols() - 1)),
        inverse_(inverse(reduced.topLeftCorner(reduced.cols() - 1, reduced.cols() - 1))) {}

  /// The direction of a weighted row [s_a s_p].
  void direction(const Eigen::Ref<const Vector>& row, Eigen::Ref<Vector> q) const {
    const Index m = start_inverse_.rows(), p = inverse_.rows();
    q.head(m).noalias() = start_inverse_.transpose() * row.head(m);
    const Vector rest = row.tail(p) - elimination_.transpose() * row.head(m);
    q.tail(p).noalias() = inverse_.transpose() * rest;
  }

 private:
  /// Columns that are not determined take nothing from the residuals.
  static Matrix inverse(const Matrix& triangle) {
    Matrix result(triangle.rows(), triangle.cols());
    for (Index j = 0; j < triangle.cols(); ++j)
      result.col(j) = solve_determined(triangle, Vector::Unit(triangle.rows(), j));
    return result;
  }

  Matrix start_inverse_, elimination_, inverse_;
};

/// z of the Wilson-Hilferty transform: a chi-squared value as a standard normal one.
double normal_score(double chi_squared, double freedom) {
  const double v = 2.0 / (9.0 * freedom);
  return (std::cbrt(chi_squared / freedom) - (1.0 - v)) / std::sqrt(v);
}

/// Autocorrelation sums of one residual within windows.
double lagged_product(const WindowPlan& plan, const Eigen::Ref<const Vector>& r, Index lag) {
  double sum = 0.0;
  for (const Window& window : plan) {
    const Index count = window.samples - lag;
    if (count > 0)
      sum += r.segment(window.first, count).dot(r.segment(window.first + lag, count));
  }
  return sum;
}

}  // namespace

FitInfluence fit_influence(ShootingProblem& problem, const ShootingFit& fit, Index lags) {
  const ShootingRecord& record = problem.record();
  const auto states = static_cast<Index>(record.measured.size());
  const Index m = problem.rates().dimension(), p = problem.rates().columns();
  FitInfluence influence{Vector::Zero(states), Matrix::Zero(lags, states),
                         Matrix::Zero(lags, states)};
  const Matrix weights = problem.row_weights(fit.point);
  std::optional<WindowDirections> directions;
  std::vector<Matrix> recent(static_cast<std::size_t>(states), Matrix(m + p, lags + 1));
  problem.sensitivities(fit.plan, fit.point, [&](Index w, Index sample, const Matrix& s) {
    const Window& window = fit.plan[static_cast<std::size_t>(w)];
    const Index age = sample - window.first;
    if (age == 0)
      directions.emplace(fit.linear.windows[static_cast<std::size_t>(w)], fit.linear.reduced,
                         m);
    for (Index q = 0; q < states; ++q) {
      Matrix& columns = recent[static_cast<std::size_t>(q)];
      auto now = columns.col(age % (lags + 1));
      const Vector row =
          weights(sample, q) * s.row(record.measured[static_cast<std::size_t>(q)]).transpose();
      directions->direction(row, now);
      influence.taken[q] += now.squaredNorm();
      for (Index lag = 1; lag <= std::min(lags, age); ++lag) {
        influence.lagged(lag - 1, q) += now.dot(columns.col((age - lag) % (lags + 1)));
        influence.pairs(lag - 1, q) += 1.0;
      }
    }
  });
  return influence;
}

std::vector<ResidualStatistics> residual_statistics(const ShootingProblem& problem,
                                                    const ShootingFit& fit,
                                                    const FitInfluence& influence,
                                                    const Vector& noise) {
  const Matrix r = problem.residuals(fit.plan, fit.point);
  std::vector<ResidualStatistics> result;
  for (Index q = 0; q < r.cols(); ++q) {
    const double freedom = std::max(1.0, static_cast<double>(r.rows()) - influence.taken[q]);
    const double variance = r.col(q).squaredNorm() / freedom, sigma = problem.sigma()[q];
    ResidualStatistics s;
    s.state = problem.record().measured[static_cast<std::size_t>(q)];
    s.rms = std::sqrt(variance) * sigma;
    s.noise = noise[q];
    s.chi_squared = noise[q] > 0.0 ? std::pow(s.rms / noise[q], 2) : 0.0;
    s.autocorrelation = Vector::Zero(influence.lagged.rows());
    double sum = 0.0, count = 0.0;
    for (Index l = 0; l < influence.lagged.rows(); ++l) {
      const double pairs = influence.pairs(l, q);
      if (pairs < 1.0 || variance == 0.0) continue;
      s.autocorrelation[l] =
          (lagged_product(fit.plan, r.col(q), l + 1) / variance + influence.lagged(l, q)) /
          pairs;
      sum += s.autocorrelation[l] * s.autocorrelation[l] * pairs;
      count += 1.0;
    }
    if (count > 0.0) s.structure = normal_score(sum, count);
    s.white = s.structure < kSignificance;
    s.is_noise = s.white && (noise[q] == 0.0 || s.rms <= kAboveNoise * noise[q]);
    result.push_back(std::move(s));
  }
  return result;
}

}  // namespace lacuna
