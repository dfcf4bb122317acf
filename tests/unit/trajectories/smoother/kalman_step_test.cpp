// SPDX-License-Identifier: MIT
// One step of the filter against the textbook's formulas in full matrices.
#include "trajectories/smoother/kalman_step.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include "support/joint_gaussian.hpp"

namespace lacuna {
namespace {

using support::GaussianCase;

/// Two states, both with coloured noise: N = 4.
GaussianCase coloured_case() {
  GaussianCase made = support::random_case(2, 12, 7);
  made.noise.coloured[0] = ColouredNoise{0.2, 0.3};
  made.noise.coloured[1] = ColouredNoise{0.4, 0.7};
  return made;
}

TEST(ChannelMap, PutsColouredNoiseBehindTheStates) {
  GaussianCase made = support::random_case(3, 12, 1);
  made.noise.measurement[1].reset();
  made.noise.coloured[2] = ColouredNoise{0.4, 0.5};
  const ChannelMap map(made.record, made.noise);
  EXPECT_EQ(map.size, 4);
  EXPECT_EQ(map.state, (std::vector<Index>{0, 2}));
  EXPECT_EQ(map.colour, (std::vector<Index>{4, 3})) << "N where there is none";
  ASSERT_EQ(map.decay.size(), 1u);
  EXPECT_NEAR(map.decay[0], std::exp(-0.1 / 0.5), 1e-12);
}

TEST(Variances, AreTheSquaresOfTheDeviations) {
  GaussianCase made = coloured_case();
  made.record.path.col(1).setConstant(3.0);
  const ChannelMap map(made.record, made.noise);
  const Variances variances(made.record, made.noise, map);
  EXPECT_NEAR(variances.white[1], 0.15 * 0.15, 1e-15);
  EXPECT_NEAR(variances.colour[1], 0.4 * 0.4, 1e-15);
  EXPECT_NEAR(variances.disturbance[1], 0.6 * 0.6, 1e-15);
  const auto x = made.record.path.col(0);
  EXPECT_NEAR(variances.start[0], std::pow(x.maxCoeff() - x.minCoeff(), 2), 1e-12);
  EXPECT_EQ(variances.start[1], 1.0) << "a state at rest";
  EXPECT_NEAR(variances.start[3], 0.4 * 0.4, 1e-15) << "coloured noise is stationary";
}

TEST(KalmanStep, DevianceOfAnInnovationIsItsLogDensity) {
  const GaussianCase made = coloured_case();
  const ChannelMap map(made.record, made.noise);
  const Shape<Eigen::Dynamic, false> shape(4, 2);
  const Innovation seen =
      KalmanStep<Shape<Eigen::Dynamic, false>>(shape, made.record, made.noise, map)
          .update(0, 0.7);
  const double density = std::exp(-0.5 * seen.value * seen.value / seen.variance) /
                         std::sqrt(2.0 * M_PI * seen.variance);
  EXPECT_NEAR(seen.deviance + std::log(seen.scale),
              -2.0 * std::log(density) - std::log(2.0 * M_PI), 1e-12);
}

TEST(DevianceSum, IsTheSumOfWhatEachInnovationAdds) {
  DevianceSum sum;
  double expected = 0.0;
  for (int i = 0; i < 2000; ++i) {
    const Innovation one{0.0, 1.0, 0.01 * i, std::pow(10.0, i % 7 - 8)};
    sum.add(one);
    expected += one.deviance + std::log(one.scale);
  }
  EXPECT_NEAR(sum.value(), expected, 1e-9 * std::abs(expected));
}

TEST(DevianceSum, HoldsScalesOfAnySize) {
  DevianceSum sum;
  for (const double scale : {1e-300, 1e300, 1e-90, 1e-90, 1e90, 1e90, 1e90})
    sum.add({0.0, 1.0, 0.0, scale});
  EXPECT_NEAR(sum.value(), 90.0 * std::log(10.0), 1e-9);
  sum.add({0.0, INFINITY, 0.5, 1.0});
  EXPECT_NEAR(sum.value(), 0.5 + 90.0 * std::log(10.0), 1e-9) << "a sample that says nothing";
}

/// Mean and covariance carried by full matrices: x+ = F x + b, P+ = F P F' + Q.
struct Textbook {
  Vector mean;
  Matrix covariance;

  void predict(const GaussianCase& made, Index i) {
    const Eigen::Map<const Matrix> phi(made.record.transition.col(i).data(), 2, 2);
    Matrix f = Matrix::Zero(4, 4), q = Matrix::Zero(4, 4);
    f.topLeftCorner(2, 2) = phi;
    for (Index k = 0; k < 2; ++k) {
      const ColouredNoise& colour = *made.noise.coloured[static_cast<std::size_t>(k)];
      f(2 + k, 2 + k) = std::exp(-0.1 / colour.time);
      q(2 + k, 2 + k) = std::pow(colour.deviation, 2) * (1.0 - std::exp(-0.2 / colour.time));
      const Eigen::Map<const Matrix> w(made.record.response.col(i).data() + 6 * k, 2, 3);
      const Vector moved = w.rowwise().sum() * support::disturbance_in(made, i, k);
      q.topLeftCorner(2, 2) += moved * moved.transpose();
    }
    mean = f * mean;
    mean.head(2) += made.record.defect.col(i);
    covariance = f * covariance * f.transpose() + q;
  }

  /// Joseph's form. @return value and variance of the innovation.
  Innovation update(const Vector& h, double measured, double white) {
    const double variance = h.dot(covariance * h) + white * white;
    const double value = measured - h.dot(mean);
    const Vector gain = covariance * h / variance;
    const Matrix left = Matrix::Identity(4, 4) - gain * h.transpose();
    mean += gain * value;
    covariance = left * covariance * left.transpose() + white * white * gain * gain.transpose();
    return {value, variance};
  }
};

TEST(KalmanStep, IsTheTextbooks) {
  const GaussianCase made = coloured_case();
  const ChannelMap map(made.record, made.noise);
  const Shape<4, false> fixed(4, 2);
  const Shape<Eigen::Dynamic, false> open(4, 2);
  KalmanStep<Shape<4, false>> step(fixed, made.record, made.noise, map);
  KalmanStep<Shape<Eigen::Dynamic, false>> dynamic(open, made.record, made.noise, map);
  using Square = Eigen::Map<const Eigen::Matrix4d>;
  const Square covariance(step.covariance());
  Textbook book{Vector::Zero(4), covariance};
  for (Index i = 0; i + 1 < 12; ++i) {
    for (Index c = 0; c < 2; ++c) {
      const Vector h = Vector::Unit(4, c) + Vector::Unit(4, 2 + c);
      const double seen = made.measured(i, c) - made.record.path(i, c);
      const Innovation found = step.update(c, seen);
      const Innovation expected =
          book.update(h, seen, *made.noise.measurement[static_cast<std::size_t>(c)]);
      dynamic.update(c, seen);
      EXPECT_NEAR(found.value, expected.value, 1e-10);
      EXPECT_NEAR(found.variance, expected.variance, 1e-10);
    }
    step.predict(i);
    dynamic.predict(i);
    book.predict(made, i);
    EXPECT_LT((Eigen::Map<const Eigen::Vector4d>(step.mean()) - book.mean).norm(), 1e-10);
    EXPECT_LT((covariance - book.covariance).norm(), 1e-10);
    EXPECT_LT((covariance - Square(dynamic.covariance())).norm(), 1e-10);
  }
}

TEST(KalmanStep, ABridgeIsTheLeastDensityOfItsStep) {
  GaussianCase made = support::random_case(2, 12, 7);
  made.record.bridge = Matrix::Zero(2, 11);
  made.record.bridge(1, 4) = 3.0;
  EXPECT_EQ(density_in(made.record, 4, 1, 0.5), 3.0);
  EXPECT_EQ(density_in(made.record, 4, 1, 5.0), 5.0);
  EXPECT_EQ(density_in(made.record, 4, 0, 0.5), 0.5);
}

TEST(Transition, TakesTheSkewPartOfTheCovarianceOutNowAndThen) {
  const GaussianCase made = coloured_case();
  const Shape<4, false> shape(4, 2);
  const Transition<Shape<4, false>> transition(shape, ChannelMap(made.record, made.noise));
  Random random(3);
  const Matrix skew = support::random_matrix(random, 4, 4, 1.0);
  Matrix p = skew;
  transition.make_symmetric(8, p.data());
  EXPECT_LT((p - 0.5 * (skew + skew.transpose())).norm(), 1e-15);
  p = skew;
  transition.make_symmetric(9, p.data());
  EXPECT_EQ(p, skew);
}

}  // namespace
}  // namespace lacuna
