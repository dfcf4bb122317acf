// SPDX-License-Identifier: MIT
#include "trajectories/shooting/refinement_run.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "lacuna/core/base/error.hpp"
#include "lacuna/data/records/noise.hpp"
#include "unit/trajectories/shooting/dense_problem.hpp"

namespace lacuna {
namespace {

/// A problem and what its refinement came to.
struct Refined {
  Refined(const ParametrisedModel& model, const Dataset& record, const RefineOptions& options)
      : problem(model, record, options.huber),
        start(refinement_start(problem, record, options)),
        run(run_refinement(problem, start, options, RunContext{})) {}

  ShootingProblem problem;
  RefinementStart start;
  RefinementRun run;
};

ParametrisedModel free_van_der_pol() {
  return with_free_coefficients(test_system("van-der-pol").model);
}

TEST(RefinementRun, EndsWhereNoUnknownHasAGradient) {
  const RefineOptions options{.sigma = Vector{{0.1, 0.1}}};
  Refined refined(testing::van_der_pol(), testing::two_records(), options);
  ASSERT_TRUE(refined.run.simulated);
  ShootingPoint point = refined.run.fit.point;
  const testing::DenseProblem dense =
      testing::dense_problem(refined.problem, refined.run.fit.plan, point);
  const Vector gradient = dense.jacobian.transpose() * dense.residual;
  EXPECT_LT(gradient.dot(dense.jacobian.householderQr().solve(dense.residual)), 1e-4);
  EXPECT_EQ(refined.start.noise, *options.sigma);
  EXPECT_EQ(refined.problem.sigma(), *options.sigma) << "a noise that is given stands";
  EXPECT_GT(refined.run.iterations, 0);
}

TEST(RefinementRun, DegreesOfFreedomTakenAreTheUnknowns) {
  const ParametrisedModel model = free_van_der_pol();
  const Refined refined(model, testing::noisy_record("van-der-pol", 300, 0.03), {});
  ASSERT_TRUE(refined.run.simulated);
  const double unknowns = static_cast<double>(model.size()) +
                          2.0 * static_cast<double>(refined.run.fit.plan.size());
  EXPECT_NEAR(refined.run.influence.taken.sum(), unknowns, 1e-6 * unknowns);
}

TEST(RefinementRun, NoiseIsThatOfTheResidualsWithTheirDegreesOfFreedom) {
  const Dataset record = testing::noisy_record("van-der-pol", 300, 0.03);
  const Refined refined(free_van_der_pol(), record, {});
  ASSERT_TRUE(refined.run.simulated);
  EXPECT_EQ(refined.start.noise, estimate_noise(record));
  const ShootingFit& fit = refined.run.fit;
  const Matrix r = refined.problem.residuals(fit.plan, fit.point);
  for (Index q = 0; q < 2; ++q) {
    const double freedom = 300.0 - refined.run.influence.taken[q];
    EXPECT_NEAR(r.col(q).squaredNorm() / freedom, 1.0, 5e-3) << "in units of sigma";
  }
}

TEST(RefinementRun, WindowsOfAnOrderlyModelGrow) {
  const Dataset record = testing::noisy_record("van-der-pol", 600, 0.03);
  const Refined refined(free_van_der_pol(), record, {});
  ASSERT_TRUE(refined.run.simulated);
  // Errors of a limit cycle do not grow: a window of a few periods knows all that there is.
  EXPECT_LE(refined.run.fit.plan.size(), 4u);
  RefineOptions fixed;
  fixed.window_samples = 30;
  const Refined given(free_van_der_pol(), record, fixed);
  ASSERT_TRUE(given.run.simulated);
  EXPECT_EQ(given.run.fit.plan.size(), 20u) << "windows that are given stand";
}

TEST(RefinementStart, GuessIsTheRecordOrWhatIsGiven) {
  const Dataset record = testing::noisy_record("van-der-pol", 100, 0.03);
  ShootingProblem problem(free_van_der_pol(), record, std::nullopt);
  EXPECT_EQ(refinement_start(problem, record, {}).guess, record.trajectories[0].states);
  RefineOptions options;
  options.states = 0.99 * record.trajectories[0].states;
  EXPECT_EQ(refinement_start(problem, record, options).guess, *options.states);
}

TEST(RefinementStart, NeedsASigmaForEachMeasuredState) {
  const RefineOptions options{.sigma = Vector{{0.1, 0.1, 0.1}}};
  const Dataset record = testing::two_records();
  ShootingProblem problem(testing::van_der_pol(), record, std::nullopt);
  EXPECT_THROW(refinement_start(problem, record, options), ArgumentError);
}

}  // namespace
}  // namespace lacuna
