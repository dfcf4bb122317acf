// SPDX-License-Identifier: MIT
#include "diagnose/candidates/shape_step.hpp"

#include <gtest/gtest.h>

#include <Eigen/QR>
#include <cmath>

#include "diagnose/candidates/candidate_column.hpp"
#include "support/assimilated_oscillator.hpp"

namespace lacuna {
namespace {

/// A stop of which coefficient and edge were fitted.
struct FittedStop {
  Dataset data = support::hidden_record(
      [](double, double q, double) { return -3.0 * std::min(q + 0.2, 0.0); }, 0.002);
  Assimilation base = support::assimilated(data);
  AssimilationOptions options = support::oscillator_fit_options();
  RunContext context = {};
  JointFitTask task{data, base.model, options, context};
  Explanation found =
      explain(task, base, {{support::stop_candidate(0.0), Vector::Constant(1, -0.1), -2.0}});
};

/// Columns of everything that was fitted and of the edge, which moves the column of the stop.
Matrix all_columns(const Explanation& at) {
  const InnovationSystem system(at.fit);
  const FittedEffect& stop = at.effects[0];
  constexpr double kReach = 1e-4;
  const auto column = [&](double edge) {
    return *candidate_column(stop.candidate, {&edge, 1}, at.fit, system);
  };
  const double edge = stop.shapes[0];
  const Matrix fitted = system.fitted_columns();
  Matrix all(fitted.rows(), fitted.cols() + 1);
  all << fitted,
      stop.coefficient * (column(edge + kReach) - column(edge - kReach)) / (2.0 * kReach);
  return all;
}

TEST(ShapeStep, ErrorsAreThoseOfTheJointProblem) {
  const FittedStop stop;
  const Explanation joint = with_joint_errors(stop.task, stop.found);
  // (X'X)^-1 by the triangular factor of X: columns of its inverse.
  const Matrix columns = all_columns(stop.found);
  const Matrix r = Eigen::HouseholderQR<Matrix>(columns)
                       .matrixQR()
                       .topRows(columns.cols())
                       .triangularView<Eigen::Upper>();
  const Matrix inverse = r.inverse();
  const Vector deviations = inverse.rowwise().norm();
  const Index p = joint.fit.covariance.rows();
  ASSERT_EQ(deviations.size(), p + 1);
  for (Index j = 0; j < p; ++j)
    EXPECT_NEAR(std::sqrt(joint.fit.covariance(j, j)) / deviations[j], 1.0, 0.02);
  EXPECT_NEAR(joint.effects[0].deviation / deviations[p - 1], 1.0, 0.02);
  EXPECT_NEAR(joint.effects[0].shape_deviations[0] / deviations[p], 1.0, 0.02);
  EXPECT_GT(joint.effects[0].deviation, 1.05 * stop.found.effects[0].deviation)
      << "an edge that may move leaves the coefficient less certain";
}

}  // namespace
}  // namespace lacuna
