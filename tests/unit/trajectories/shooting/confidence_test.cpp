// SPDX-License-Identifier: MIT
#include "trajectories/shooting/confidence.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <Eigen/LU>
#include <Eigen/QR>
#include <array>
#include <cmath>

#include "core/base/random.hpp"
#include "lacuna/core/base/error.hpp"
#include "trajectories/shooting/cramer_rao.hpp"
#include "trajectories/shooting/residual_analysis.hpp"
#include "trajectories/shooting/residual_statistics.hpp"
#include "unit/trajectories/shooting/dense_problem.hpp"
#include "unit/trajectories/shooting/records.hpp"

namespace lacuna {
namespace {

TEST(Confidence, IntervalsAreThoseOfStudent) {
  // 97.5 % quantiles of tables: 4.303 with 2 degrees of freedom, 2.228 with 10, 1.960.
  const Vector values = Vector{{1.0, -2.0}}, errors = Vector{{0.5, 0.1}};
  const Matrix few = intervals95(values, errors, 2.0);
  EXPECT_NEAR(few(0, 0), 1.0 - 4.3027 * 0.5, 1e-3);
  EXPECT_NEAR(few(0, 1), 1.0 + 4.3027 * 0.5, 1e-3);
  EXPECT_NEAR(intervals95(values, errors, 10.0)(1, 1), -2.0 + 2.2281 * 0.1, 1e-4);
  EXPECT_NEAR(intervals95(values, errors, 1e9)(1, 0), -2.0 - 1.95996 * 0.1, 1e-5);
}

TEST(Confidence, RobustFactorIsHubersFormula) {
  // huber 1: psi = 0.5, -1, 1; weights = 1, 1/2, 1/4; psi' = 1, 0, 0.
  const Matrix residuals = Matrix{{0.5, -2.0, 4.0}};
  const double psi2 = (0.25 + 1.0 + 1.0) / 3.0, weight = (1.0 + 0.5 + 0.25) / 3.0;
  EXPECT_NEAR(robust_factor(residuals, 1.0), psi2 * weight / (1.0 / 9.0), 1e-12);
  // Where no residual is cut it is their mean square.
  EXPECT_NEAR(robust_factor(residuals, 10.0), (0.25 + 4.0 + 16.0) / 3.0, 1e-12);
}

Matrix triangle_of(const Matrix& rows) {
  return Eigen::HouseholderQR<Matrix>(rows)
      .matrixQR()
      .topRows(rows.cols())
      .triangularView<Eigen::Upper>();
}

/// Windows of 30 rows: one initial state, p parameters, the residual.
std::vector<Matrix> windows_of(Index count, Index p) {
  Random random(3);
  std::vector<Matrix> windows;
  for (Index w = 0; w < count; ++w) {
    Matrix rows(30, p + 2);
    for (double& entry : rows.reshaped()) entry = random.normal();
    rows.col(0).array() += 1.0;
    rows.col(p + 1).array() += std::sin(0.3 * static_cast<double>(w));
    windows.push_back(rows);
  }
  return windows;
}

/// B / (B - P) (J'J)^-1 (sum g g') (J'J)^-1 from the rows, initial states projected out.
Matrix sandwich(const std::vector<Matrix>& windows, Index p, Index blocks) {
  const auto count = static_cast<Index>(windows.size());
  Matrix information = Matrix::Zero(p, p), gradients = Matrix::Zero(p, blocks);
  for (Index w = 0; w < count; ++w) {
    const Matrix& rows = windows[static_cast<std::size_t>(w)];
    const Vector start = rows.col(0).normalized();
    const Matrix s = rows.middleCols(1, p), own = s - start * (start.transpose() * s);
    information += own.transpose() * own;
    gradients.col(w * blocks / count) += own.transpose() * rows.col(p + 1);
  }
  const Matrix inverse = information.inverse();
  const Matrix meat = inverse * gradients * gradients.transpose() * inverse;
  return static_cast<double>(blocks) / static_cast<double>(blocks - p) * meat;
}

Matrix information_inverse(const std::vector<Matrix>& triangles, Index p) {
  Matrix information = Matrix::Zero(p, p);
  for (const Matrix& r : triangles) {
    const Matrix own = r.block(1, 1, p, p);
    information += own.transpose() * own;
  }
  return information.inverse();
}

TEST(Confidence, BlockCovarianceIsTheSandwichOfTheRows) {
  for (const auto& [count, p, blocks] :
       {std::array<Index, 3>{90, 2, 30}, {31, 3, 30}, {10, 3, 10}, {50, 20, 40}}) {
    const std::vector<Matrix> rows = windows_of(count, p);
    std::vector<Matrix> triangles;
    for (const Matrix& window : rows) triangles.push_back(triangle_of(window));
    const auto found = block_covariance(triangles, information_inverse(triangles, p));
    ASSERT_TRUE(found.has_value());
    const Matrix expected = sandwich(rows, p, blocks);
    EXPECT_LT((*found - expected).norm(), 1e-9 * expected.norm()) << count << " windows";
  }
}

TEST(Confidence, FewWindowsSayNothingOfTheCovariance) {
  const Matrix window = Matrix::Identity(5, 5), inverse = Matrix::Identity(3, 3);
  EXPECT_FALSE(block_covariance(std::vector<Matrix>(5, window), inverse).has_value());
  EXPECT_TRUE(block_covariance(std::vector<Matrix>(6, window), inverse).has_value());
  EXPECT_FALSE(block_covariance(std::vector<Matrix>(6, window), Matrix(0, 0)).has_value());
}

/// dx/dt = a, x(t) = x0 + a t: the textbook variance of a slope.
TEST(CramerRao, IsTheTextbookVarianceOfASlope) {
  const Variables variables{{"x"}, {}};
  const OdeModel drift({{"x", ""}}, {}, {{{Term::parse("1", variables), 2.0}}});
  Dataset truth;
  truth.states = {{"x", ""}};
  const Index n = 50;
  const Vector time = Vector::LinSpaced(n, 0.0, 4.9);
  truth.trajectories.push_back({"run", time, 1.0 + (2.0 * time.array()), Matrix(n, 0), {}});
  const Vector bound = cramer_rao_bound(with_free_coefficients(drift), truth,
                                        Vector::Constant(1, 0.3), equal_windows({0, n}, n));
  const double spread = (time.array() - time.mean()).matrix().squaredNorm();
  EXPECT_NEAR(bound[0], 0.3 / std::sqrt(spread), 1e-9);
}

/// A minimum, its influence up to lag 4, and the projector on the columns of the dense problem
/// as it is there: first all samples of one state, then of the other.
struct InfluenceCase {
  InfluenceCase() : fit{c.plan, c.point, {}} {
    minimise(c.problem, fit, 1e-12, 50, {});
    influence = fit_influence(c.problem, fit, 4);
    const Matrix j = testing::dense_problem(c.problem, c.plan, fit.point).jacobian;
    projector = j * (j.transpose() * j).inverse() * j.transpose();
  }

  /// Calls `visit(q, lag, a, b)` with the rows of all pairs of samples within windows.
  template <class Visit>
  void pairs(Visit visit) const {
    const Index n = c.problem.record().samples();
    for (Index q = 0; q < 2; ++q)
      for (const Window& window : c.plan)
        for (Index lag = 1; lag <= 4; ++lag)
          for (Index i = window.first; i + lag < window.first + window.samples; ++i)
            visit(q, lag, q * n + i, q * n + i + lag);
  }

  testing::ShootingCase c;
  ShootingFit fit;
  FitInfluence influence;
  Matrix projector;
};

TEST(FitInfluence, IsTheProjectorOfTheDenseProblem) {
  const InfluenceCase c;
  const Index n = c.c.problem.record().samples();
  for (Index q = 0; q < 2; ++q)
    EXPECT_NEAR(c.influence.taken[q], c.projector.diagonal().segment(q * n, n).sum(), 1e-5);
  Matrix lagged = Matrix::Zero(4, 2), pairs = Matrix::Zero(4, 2);
  c.pairs([&](Index q, Index lag, Index a, Index b) {
    lagged(lag - 1, q) += c.projector(a, b);
    pairs(lag - 1, q) += 1.0;
  });
  EXPECT_LT((c.influence.lagged - lagged).norm(), 1e-5);
  EXPECT_EQ(c.influence.pairs, pairs);
}

TEST(ResidualStatistics, AreTheFormulasOnTheResiduals) {
  const InfluenceCase c;
  const Matrix r = c.c.problem.residuals(c.c.plan, c.fit.point);
  const Vector noise = Vector{{0.15, 0.0}};
  const auto statistics = residual_statistics(c.c.problem, c.fit, c.influence, noise);
  ASSERT_EQ(statistics.size(), 2u);
  Matrix products = Matrix::Zero(4, 2);
  c.pairs([&](Index q, Index lag, Index a, Index b) {
    products(lag - 1, q) += r.reshaped()[a] * r.reshaped()[b];
  });
  for (Index q = 0; q < 2; ++q) {
    const ResidualStatistics& s = statistics[static_cast<std::size_t>(q)];
    const double variance = r.col(q).squaredNorm() / (41.0 - c.influence.taken[q]);
    EXPECT_NEAR(s.rms, std::sqrt(variance) * c.c.problem.sigma()[q], 1e-12);
    EXPECT_EQ(s.state, q);
    double sum = 0.0;
    for (Index l = 0; l < 4; ++l) {
      const double pairs = c.influence.pairs(l, q);
      const double rho = (products(l, q) / variance + c.influence.lagged(l, q)) / pairs;
      EXPECT_NEAR(s.autocorrelation[l], rho, 1e-9);
      sum += rho * rho * pairs;
    }
    // Chi-squared with 4 degrees of freedom, by the transform of Wilson and Hilferty.
    const double score = (std::cbrt(sum / 4.0) - (1.0 - 1.0 / 18.0)) * std::sqrt(18.0);
    EXPECT_NEAR(s.structure, score, 1e-9);
  }
  EXPECT_NEAR(statistics[0].chi_squared, std::pow(statistics[0].rms / 0.15, 2), 1e-12);
  EXPECT_EQ(statistics[1].chi_squared, 0.0) << "no noise to hold it against";
}

}  // namespace
}  // namespace lacuna
