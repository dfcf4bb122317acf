// SPDX-License-Identifier: MIT
#include "data/derivatives/wiener_path.hpp"

#include <Eigen/Cholesky>
#include <cmath>
#include <limits>

#include "core/base/check.hpp"

namespace lacuna {
namespace {

/// Samples that only start the filter: twice the states of the largest model, so that models of
/// different order predict the same samples.
constexpr Index kStart = 8;

template <int M>
using WienerMatrix = Eigen::Matrix<double, M, M>;
template <int M>
using WienerStates = Eigen::Matrix<double, M, Eigen::Dynamic>;

constexpr double factorial(int k) { return k < 2 ? 1.0 : k * factorial(k - 1); }

template <int M>
WienerMatrix<M> transition(double h) {
  WienerMatrix<M> phi = WienerMatrix<M>::Zero();
  for (int a = 0; a < M; ++a)
    for (int b = a; b < M; ++b) phi(a, b) = std::pow(h, b - a) / factorial(b - a);
  return phi;
}

template <int M>
WienerMatrix<M> increment(double h) {
  WienerMatrix<M> q;
  for (int a = 0; a < M; ++a)
    for (int b = 0; b < M; ++b) {
      const int p = 2 * M - 1 - a - b;
      q(a, b) = std::pow(h, p) / (p * factorial(M - 1 - a) * factorial(M - 1 - b));
    }
  return q;
}

/// One sample of the filter, in units of the samples' noise.
template <int M>
struct WienerStep {
  WienerMatrix<M> phi, predicted, filtered;  ///< from the sample before; covariances
  WienerStates<M> mean;                      ///< filtered
};

/// Squares of prediction errors, and what they are compared with.
struct Innovations {
  Vector squares;  ///< of each column, sum of v^2 / F from sample kStart on
  double log_variances = 0.0;
};

/// Takes up sample i in the predicted mean and covariance of `step`.
template <int M>
void take_sample(WienerStep<M>& step, const Eigen::RowVectorXd& sample, Index i,
                 Innovations& sums) {
  const double variance = step.predicted(0, 0) + 1.0;
  const Eigen::Matrix<double, M, 1> gain = step.predicted.col(0) / variance;
  const Eigen::RowVectorXd error = sample - step.mean.row(0);
  WienerMatrix<M> kept = WienerMatrix<M>::Identity();
  kept.col(0) -= gain;
  step.mean += gain * error;
  step.filtered = kept * step.predicted * kept.transpose() + gain * gain.transpose();
  if (i < kStart) return;
  sums.squares += (error.array().square() / variance).matrix().transpose();
  sums.log_variances += std::log(variance);
}

/// Filters all samples; `keep` sees every step. Times in units of the mean step.
template <int M, class Keep>
Innovations filter(const Vector& time, const Matrix& values, double lambda, Keep keep) {
  Innovations sums{Vector::Zero(values.cols()), 0.0};
  WienerStep<M> step;
  // A diffuse start: deviations so large that they change the result by 1e-8 of itself.
  step.filtered = 1e8 * (1.0 + 1.0 / lambda) * WienerMatrix<M>::Identity();
  step.mean = WienerStates<M>::Zero(M, values.cols());
  for (Index i = 0; i < time.size(); ++i) {
    const double h = i == 0 ? 0.0 : time[i] - time[i - 1];
    step.phi = transition<M>(h);
    step.predicted = step.phi * step.filtered * step.phi.transpose();
    if (i > 0) step.predicted += increment<M>(h) / lambda;
    step.mean = (step.phi * step.mean).eval();
    take_sample(step, values.row(i), i, sums);
    keep(i, step);
  }
  return sums;
}

Vector wiener_noise(const Innovations& sums, Index samples) {
  const double count = static_cast<double>(std::max<Index>(samples - kStart, 1));
  return (sums.squares / count).cwiseSqrt();
}

template <int M>
WienerPath smooth_of_order(const Vector& time, const Matrix& values, double lambda) {
  const Index n = time.size();
  std::vector<WienerStep<M>> steps(static_cast<std::size_t>(n));
  const Innovations sums = filter<M>(time, values, lambda, [&](Index i, const auto& step) {
    steps[static_cast<std::size_t>(i)] = step;
  });
  WienerPath path{std::vector<Matrix>(M, Matrix(n, values.cols())),
                  std::vector<Vector>(M, Vector(n)), wiener_noise(sums, n)};
  WienerMatrix<M> covariance = steps.back().filtered;
  WienerStates<M> mean = steps.back().mean;
  for (Index i = n - 1;; --i) {
    for (std::size_t k = 0; k < M; ++k) {
      const auto row = static_cast<Index>(k);
      path.states[k].row(i) = mean.row(row);
      path.deviations[k][i] = std::sqrt(std::max(covariance(row, row), 0.0));
    }
    if (i == 0) break;
    const WienerStep<M>& next = steps[static_cast<std::size_t>(i)];
    const WienerStep<M>& here = steps[static_cast<std::size_t>(i - 1)];
    const WienerMatrix<M> gain =
        next.predicted.llt().solve(next.phi * here.filtered).transpose();
    mean = (here.mean + gain * (mean - next.phi * here.mean)).eval();
    covariance =
        (here.filtered + gain * (covariance - next.predicted) * gain.transpose()).eval();
  }
  return path;
}

template <int M>
double score_of_order(const Vector& time, const Matrix& values, double lambda) {
  const Innovations sums = filter<M>(time, values, lambda, [](Index, const auto&) {});
  const double count = static_cast<double>(time.size() - kStart);
  constexpr double kUnit = std::numeric_limits<double>::epsilon();
  const Vector rounding = kUnit * kUnit * values.colwise().squaredNorm().transpose();
  const Vector squares = (sums.squares + rounding).array() + std::numeric_limits<double>::min();
  return count * (squares / count).array().log().sum() +
         static_cast<double>(values.cols()) * sums.log_variances;
}

void check_wiener(const Vector& time, const Matrix& values, int order, double lambda,
                  Index fewest, const char* where) {
  check_argument(order >= 2 && order <= 4 && lambda > 0.0 && values.rows() == time.size(),
                 where, "the order is not 2, 3 or 4, lambda not positive, or shapes do not fit");
  check_times(time, fewest, where);
}

}  // namespace

WienerPath smooth_wiener(const Vector& time, const Matrix& values, int order, double lambda) {
  check_wiener(time, values, order, lambda, 2, "smooth_wiener");
  const double step = (time[time.size() - 1] - time[0]) / static_cast<double>(time.size() - 1);
  const Vector scaled = time / step;
  const double ratio = lambda / std::pow(step, 2 * order - 1);
  WienerPath path = order == 2   ? smooth_of_order<2>(scaled, values, ratio)
                    : order == 3 ? smooth_of_order<3>(scaled, values, ratio)
                                 : smooth_of_order<4>(scaled, values, ratio);
  for (std::size_t k = 0; k < path.states.size(); ++k) {
    const double unit = std::pow(step, -static_cast<double>(k));
    path.states[k] *= unit;
    path.deviations[k] *= unit;
  }
  return path;
}

double wiener_score(const Vector& time, const Matrix& values, int order, double lambda) {
  check_wiener(time, values, order, lambda, kStart + 2, "wiener_score");
  const double step = (time[time.size() - 1] - time[0]) / static_cast<double>(time.size() - 1);
  const Vector scaled = time / step;
  const double ratio = lambda / std::pow(step, 2 * order - 1);
  if (order == 2) return score_of_order<2>(scaled, values, ratio);
  if (order == 3) return score_of_order<3>(scaled, values, ratio);
  return score_of_order<4>(scaled, values, ratio);
}

}  // namespace lacuna
