// SPDX-License-Identifier: MIT
#include "trajectories/shooting/residual_statistics.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "trajectories/shooting/residual_analysis.hpp"
#include "unit/trajectories/shooting/dense_problem.hpp"

namespace lacuna {
namespace {

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
