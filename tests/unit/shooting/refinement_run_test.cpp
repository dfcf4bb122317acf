// SPDX-License-Identifier: MIT
#include "shooting/refinement_run.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "lacuna/core/error.hpp"
#include "lacuna/data/noise.hpp"
#include "unit/shooting/dense_problem.hpp"

namespace lacuna {
namespace {

TEST(RefinementRun, EndsWhereNoUnknownHasAGradient) {
  const RefineOptions options{.sigma = Vector{{0.1, 0.1}}};
  const RunContext context;
  RefinementRun run(testing::van_der_pol(), testing::two_records(), options, context);
  ASSERT_TRUE(run.run());
  ShootingPoint point = run.fit().point;
  const testing::DenseProblem dense =
      testing::dense_problem(run.problem(), run.fit().plan, point);
  const Vector gradient = dense.jacobian.transpose() * dense.residual;
  EXPECT_LT(gradient.dot(dense.jacobian.householderQr().solve(dense.residual)), 1e-4);
  EXPECT_EQ(run.noise(), *options.sigma);
  EXPECT_EQ(run.problem().sigma(), *options.sigma) << "a noise that is given stands";
  EXPECT_GT(run.iterations(), 0);
}

TEST(RefinementRun, DegreesOfFreedomTakenAreTheUnknowns) {
  const RunContext context;
  const RefineOptions options;
  const ParametrisedModel model = with_free_coefficients(test_system("van-der-pol").model);
  RefinementRun run(model, testing::noisy_record("van-der-pol", 300, 0.03), options, context);
  ASSERT_TRUE(run.run());
  const double unknowns =
      static_cast<double>(model.size()) + 2.0 * static_cast<double>(run.fit().plan.size());
  EXPECT_NEAR(run.influence().taken.sum(), unknowns, 1e-6 * unknowns);
}

TEST(RefinementRun, NoiseIsThatOfTheResidualsWithTheirDegreesOfFreedom) {
  const RunContext context;
  const RefineOptions options;
  const Dataset record = testing::noisy_record("van-der-pol", 300, 0.03);
  RefinementRun run(with_free_coefficients(test_system("van-der-pol").model), record, options,
                    context);
  ASSERT_TRUE(run.run());
  EXPECT_EQ(run.noise(), estimate_noise(record));
  const Matrix r = run.problem().residuals(run.fit().plan, run.fit().point);
  for (Index q = 0; q < 2; ++q) {
    const double freedom = 300.0 - run.influence().taken[q];
    EXPECT_NEAR(r.col(q).squaredNorm() / freedom, 1.0, 5e-3) << "in units of sigma";
  }
}

TEST(RefinementRun, WindowsOfAnOrderlyModelGrow) {
  const RunContext context;
  const RefineOptions options;
  const Dataset record = testing::noisy_record("van-der-pol", 600, 0.03);
  RefinementRun run(with_free_coefficients(test_system("van-der-pol").model), record, options,
                    context);
  ASSERT_TRUE(run.run());
  // Errors of a limit cycle do not grow: a window of a few periods knows all that there is.
  EXPECT_LE(run.fit().plan.size(), 4u);
  RefineOptions fixed;
  fixed.window_samples = 30;
  RefinementRun given(with_free_coefficients(test_system("van-der-pol").model), record, fixed,
                      context);
  ASSERT_TRUE(given.run());
  EXPECT_EQ(given.fit().plan.size(), 20u) << "windows that are given stand";
}

TEST(RefinementRun, GuessIsTheRecordOrWhatIsGiven) {
  const RunContext context;
  const Dataset record = testing::noisy_record("van-der-pol", 100, 0.03);
  const ParametrisedModel model = with_free_coefficients(test_system("van-der-pol").model);
  const RefineOptions plain;
  RefinementRun run(model, record, plain, context);
  ASSERT_TRUE(run.run());
  EXPECT_EQ(run.guess(), record.trajectories[0].states);
  RefineOptions options;
  options.states = 0.99 * record.trajectories[0].states;
  RefinementRun other(model, record, options, context);
  ASSERT_TRUE(other.run());
  EXPECT_EQ(other.guess(), *options.states);
}

TEST(RefinementRun, NeedsASigmaForEachMeasuredState) {
  const RunContext context;
  const RefineOptions options{.sigma = Vector{{0.1, 0.1, 0.1}}};
  EXPECT_THROW(RefinementRun(testing::van_der_pol(), testing::two_records(), options, context),
               ArgumentError);
}

}  // namespace
}  // namespace lacuna
