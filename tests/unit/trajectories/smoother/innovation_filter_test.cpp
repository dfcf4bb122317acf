// SPDX-License-Identifier: MIT
#include "lacuna/trajectories/smoother/innovation_filter.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>

#include "lacuna/core/base/error.hpp"
#include "support/driven_oscillator.hpp"
#include "support/joint_gaussian.hpp"

namespace lacuna {
namespace {

constexpr double kNoise = 0.01;

NoiseModel noise_of(double disturbance) {
  Vector q(2);
  q << 0.0, disturbance;
  return {{kNoise, 2.0 * kNoise}, {{}, {}}, q};
}

struct Case {
  Dataset data;
  LinearisedRecord record;
};

Case make_case(const support::Hidden& hidden) {
  Case made{support::hidden_record(hidden, kNoise), {}};
  const Trajectory& record = made.data.trajectories.front();
  made.record =
      linearise(support::oscillator(), record, record.states, Vector::Constant(2, 1e-4));
  return made;
}

TEST(InnovationFilter, DevianceIsThatOfTheFilter) {
  const Case made = make_case(support::nothing);
  const Matrix& measured = made.data.trajectories[0].states;
  EXPECT_NEAR(filter_deviance(made.record, measured, Matrix(), noise_of(0.1)),
              run_filter(made.record, measured, Matrix(), noise_of(0.1)).deviance, 1e-6);
  EXPECT_THROW(run_filter(made.record, Matrix::Zero(4, 2), Matrix(), noise_of(0.1)),
               ArgumentError);
}

/// log det S + r' S^-1 r of all measurements r, whose covariance S is written out.
double joint_deviance(const LinearisedRecord& record, const Matrix& measured,
                      const NoiseModel& noise) {
  const Index n = record.samples();
  const double step = record.time[1] - record.time[0];
  const Vector span = record.path.colwise().maxCoeff() - record.path.colwise().minCoeff();
  // What moves the deviations: both at the start, then the disturbance of v in each step.
  Matrix from = Matrix::Zero(2 * n, 2 + n - 1);
  from.topLeftCorner(2, 2) = span.asDiagonal();
  Vector left(2 * n), shift = Vector::Zero(2);
  for (Index i = 0; i < n; ++i) {
    left.segment(2 * i, 2) = (measured.row(i) - record.path.row(i)).transpose() - shift;
    if (i + 1 == n) break;
    const Eigen::Map<const Matrix> phi(record.transition.col(i).data(), 2, 2);
    from.middleRows(2 * i + 2, 2) = phi * from.middleRows(2 * i, 2);
    const auto w = record.response.col(i).tail(6);
    from.block(2 * i + 2, 2 + i, 2, 1) = noise.disturbance[1] / std::sqrt(step) *
                                         (w.segment(0, 2) + w.segment(2, 2) + w.tail(2));
    shift = phi * shift + record.defect.col(i);
  }
  Matrix covariance = from * from.transpose();
  for (Index i = 0; i < 2 * n; ++i) {
    covariance(i, i) += std::pow(*noise.measurement[static_cast<std::size_t>(i % 2)], 2);
    for (Index j = 0; i % 2 == 0 && j < 2 * n; j += 2)
      covariance(i, j) += std::pow(noise.coloured[0]->deviation, 2) *
                          std::exp(-std::abs(record.time[i / 2] - record.time[j / 2]) /
                                   noise.coloured[0]->time);
  }
  const Eigen::LLT<Matrix> factor(covariance);
  return 2.0 * Matrix(factor.matrixL()).diagonal().array().log().sum() +
         left.dot(factor.solve(left));
}

TEST(InnovationFilter, WhitensAsTheCholeskyFactorOfTheCovarianceDoes) {
  support::GaussianCase made = support::random_case(3, 20, 11);
  made.noise.measurement[1].reset();
  made.noise.coloured[2] = ColouredNoise{0.3, 0.25};
  made.record.bridge = Matrix::Zero(3, 19);
  made.record.bridge(0, 9) = 40.0;
  const InnovationFilter filter = run_filter(made.record, made.measured, Matrix(), made.noise);
  const support::JointGaussian joint = support::joint_of(made);
  const Matrix factor = support::measured_covariance(joint).matrixL();
  const Vector expected = factor.triangularView<Eigen::Lower>().solve(joint.left);
  EXPECT_LT((filter.innovations.reshaped() - expected).norm(), 1e-8);
  EXPECT_LT((filter.inverse_deviation.reshaped() - factor.diagonal().cwiseInverse()).norm(),
            1e-8);
  EXPECT_EQ(filter.used, 40);
  EXPECT_NEAR(filter.deviance, support::joint_deviance(made), 1e-7);
}

}  // namespace
}  // namespace lacuna
