// SPDX-License-Identifier: MIT
#include "trajectories/fit/fit_solver.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "support/grey_box.hpp"

namespace lacuna {
namespace {

/// x' = -k x + b u of two records with noise.
struct Decay {
  explicit Decay(const std::string& more = "", const std::string& param = "param k = 0.5")
      : system(parse_ode_system(
            "input u hold linear\n" + param + "\ndx/dt = -k*x + 0.7*u\ny = x\n" + more,
            "m.ode")),
        model(system.parametrised()) {
    const OdeModel truth =
        parse_ode("input u hold linear\ndx/dt = -0.5*x + 0.7*u\ny = x\n", "t.ode");
    Dataset data = support::grey_box(truth, {.start = Vector::Constant(1, 2.0), .noise = 0.05});
    data.trajectories.push_back(
        support::grey_box(truth, {.start = Vector::Constant(1, -1.0), .noise = 0.05, .seed = 2})
            .trajectories[0]);
    engine = std::make_unique<FitEngine>(fit_engine(model, fit_records(model, data)));
  }
  FitPoint start(double k, double b) const {
    return {(Matrix(2, 2) << b, k, b, k).finished(), engine->records.starts};
  }
  SystemModel system;
  ParametrisedModel model;
  std::unique_ptr<FitEngine> engine;
};

/// The step of least squares by a dense QR of all rows.
TEST(FitSolver, AMinimumHasNoGradientLeft) {
  Decay decay;
  const FitUnknowns unknowns = fit_unknowns(decay.model, {});
  const FitMinimum found = minimise(*decay.engine, unknowns, decay.start(1.5, 0.2), {}, 60, {});
  EXPECT_TRUE(found.converged);
  EXPECT_NEAR(found.point.parameters(0, 0), 0.7, 0.02);
  EXPECT_NEAR(found.point.parameters(1, 1), 0.5, 0.02);
  EXPECT_NEAR(found.point.starts(0, 0), 2.0, 0.1);
  EXPECT_NEAR(found.point.starts(1, 0), -1.0, 0.1);
  Matrix rows = Matrix::Zero(1200, 4);
  Vector residuals(1200);
  for (Index r = 0; r < 2; ++r)
    sensitivities(*decay.engine, found.point, found.path, {}, r,
                  [&](Index n, const Matrix& row, const Vector& residual) {
                    rows(n, r) = row(0, 0);
                    rows.row(n).tail(2) = row.row(0).tail(2);
                    residuals[n] = residual[0];
                  });
  const Vector step = rows.colPivHouseholderQr().solve(residuals);
  const Matrix inverse = (rows.transpose() * rows).inverse();
  for (Index j = 0; j < 4; ++j)
    EXPECT_LT(std::abs(step[j]), 0.02 * std::sqrt(inverse(j, j))) << "of a standard error";
  const FitLinear linear =
      linearise(*decay.engine, unknowns, found.point, found.path, {}, true);
  const Matrix r = linear.reduced.topLeftCorner(2, 2);
  EXPECT_LT(((r.transpose() * r).inverse() - inverse.bottomRightCorner(2, 2)).norm(),
            1e-8 * inverse.bottomRightCorner(2, 2).norm());
  EXPECT_LT(linear.gradients.rowwise().sum().norm(), 0.02 * linear.gradients.norm());
}

TEST(FitSolver, RangesAreKeptAndTheRestFitted) {
  Decay decay("", "param k = 0.3 in 0..0.4");
  const FitUnknowns unknowns = fit_unknowns(decay.model, {});
  const FitMinimum found = minimise(*decay.engine, unknowns, decay.start(0.3, 0.7), {}, 60, {});
  EXPECT_EQ(found.point.parameters(0, 1), 0.4);
  // The best b where k is held at 0.4.
  Decay held("", "param k = 0.4 fixed");
  const FitUnknowns others = fit_unknowns(held.model, {});
  const FitMinimum best =
      minimise(*held.engine, others, {Matrix::Constant(2, 1, 0.7), held.engine->records.starts},
               {}, 60, {});
  EXPECT_NEAR(found.point.parameters(0, 0), best.point.parameters(0, 0), 1e-3);
}

TEST(FitSolver, InitialStatesAreFixedOrHeldNearWhatIsKnown) {
  Decay fixed("initial x = 1.5 fixed\n");
  const FitUnknowns known = fit_unknowns(fixed.model, {});
  const FitMinimum found = minimise(*fixed.engine, known, fixed.start(0.5, 0.7), {}, 60, {});
  EXPECT_EQ(found.point.starts(0, 0), 1.5);
  EXPECT_EQ(found.point.starts(1, 0), 1.5);
  EXPECT_EQ(degrees_of_freedom(*fixed.engine, known), 1198.0);
  Decay near("initial x = 1.5 deviation 1e-6\n");
  const FitUnknowns prior = fit_unknowns(near.model, {});
  const FitMinimum held = minimise(*near.engine, prior, near.start(0.5, 0.7), {}, 60, {});
  EXPECT_NEAR(held.point.starts(0, 0), 1.5, 1e-4);
  EXPECT_EQ(degrees_of_freedom(*near.engine, prior), 1196.0);
}

TEST(FitSolver, RecordsMayHaveParametersOfTheirOwn) {
  Decay decay;
  const FitUnknowns unknowns = fit_unknowns(decay.model, {1});
  const FitMinimum found = minimise(*decay.engine, unknowns, decay.start(0.9, 0.5), {}, 60, {});
  EXPECT_EQ(found.point.parameters(0, 0), found.point.parameters(1, 0));
  EXPECT_NE(found.point.parameters(0, 1), found.point.parameters(1, 1));
  EXPECT_NEAR(found.point.parameters(0, 1), 0.5, 0.03);
  EXPECT_NEAR(found.point.parameters(1, 1), 0.5, 0.03);
}

}  // namespace
}  // namespace lacuna
