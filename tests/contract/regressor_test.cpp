// SPDX-License-Identifier: MIT
#include "contract/contract.hpp"
#include "lacuna/regression/stages/solvers.hpp"

namespace lacuna::contract {
namespace {

class EveryRegressor : public testing::TestWithParam<StageVariant> {
 protected:
  Regression fit(const LeastSquaresSystem& system, const TermSet& active,
                 const RunContext& context = {}) const {
    return stage_of<Regressor>(GetParam())
        ->fit(system, system.subproblem(0, active), Effort::Final, context);
  }
};

Vector scattered(const Regression& regression) {
  Vector h = Vector::Zero(kTerms);
  for (std::size_t i = 0; i < regression.active.size(); ++i)
    h[regression.active[i]] = regression.coefficients[static_cast<Index>(i)];
  return h;
}

/// An l1 penalty shrinks coefficients by its own size even without noise: 1e-6 by default.
constexpr double kShrinkage = 1e-4;

TEST_P(EveryRegressor, FindsTheExactCoefficientsOfTheTrueTerms) {
  const Regression regression = fit(good_system(), {1, 4});
  const double error = (scattered(regression) - true_coefficients()).cwiseAbs().maxCoeff();
  EXPECT_LT(error, kShrinkage);
}

TEST_P(EveryRegressor, LeavesNothingToSuperfluousTerms) {
  const LeastSquaresSystem system = good_system();
  const Regression regression = fit(system, system.all_terms());
  const double error = (scattered(regression) - true_coefficients()).cwiseAbs().maxCoeff();
  EXPECT_LT(error, kShrinkage);
}

TEST_P(EveryRegressor, ResidualIsThatOfTheCoefficients) {
  const LeastSquaresSystem system = system_over(good_columns(), 0.3);
  const Regression regression = fit(system, system.all_terms());
  EXPECT_TRUE(regression.converged);
  const Vector residuals = system.residuals(0, regression.active, regression.coefficients);
  EXPECT_NEAR(regression.residual_norm, residuals.norm(), 1e-8 * residuals.norm());
  EXPECT_NEAR(residuals.norm() / std::sqrt(static_cast<double>(kRows)), 0.3, 0.05);
}

TEST_P(EveryRegressor, NoTermsLeaveTheTargetAsResidual) {
  const LeastSquaresSystem system = good_system();
  const Regression regression = fit(system, {});
  EXPECT_TRUE(regression.active.empty());
  EXPECT_DOUBLE_EQ(regression.residual_norm, system.factor().target_norms[0]);
}

TEST_P(EveryRegressor, RemovedTermsAreAccountedFor) {
  const LeastSquaresSystem system = system_over(good_columns(), 0.1);
  const Regression regression = fit(system, system.all_terms());
  TermSet together = regression.active;
  for (const Removal& removal : regression.removed) together.push_back(removal.term);
  std::sort(together.begin(), together.end());
  EXPECT_EQ(together, system.all_terms());
}

TEST_P(EveryRegressor, ThreadsDoNotChangeTheResult) {
  RunContext two;
  two.threads = 2;
  const LeastSquaresSystem one_thread = system_over(good_columns(), 0.1, 1);
  const LeastSquaresSystem two_threads = system_over(good_columns(), 0.1, 2);
  const Regression a = fit(one_thread, one_thread.all_terms());
  const Regression b = fit(two_threads, two_threads.all_terms(), two);
  EXPECT_EQ(a.active, b.active);
  EXPECT_EQ(a.coefficients, b.coefficients);
}

TEST_P(EveryRegressor, UnitsOfTheColumnsDoNotMatter) {
  Matrix theta = good_columns();
  const Regression before = fit(system_over(theta, 0.1), {1, 4});
  Vector scale(kTerms);
  scale << 1e-6, 1e3, 1.0, 1e6, 1e-3, 1.0;
  const LeastSquaresSystem plain = system_over(theta, 0.1);
  Random random(11);
  Matrix target = theta * true_coefficients();
  for (Index i = 0; i < target.rows(); ++i) target(i, 0) += 0.1 * random.normal();
  const LeastSquaresSystem scaled(make_row_source(theta * scale.asDiagonal(), target),
                                  plain.term_names(), {"y"});
  const Regression after = fit(scaled, {1, 4});
  ASSERT_EQ(after.active, before.active);
  EXPECT_NEAR(after.coefficients[0] * scale[1], before.coefficients[0], 1e-8);
  EXPECT_NEAR(after.coefficients[1] * scale[4], before.coefficients[1], 1e-8);
}

TEST_P(EveryRegressor, HonoursAStopRequest) {
  std::stop_source source;
  source.request_stop();
  RunContext context;
  context.stop = source.get_token();
  const LeastSquaresSystem system = system_over(good_columns(), 0.1);
  EXPECT_THROW(fit(system, system.all_terms(), context), Cancelled);
}

INSTANTIATE_TEST_SUITE_P(Registry, EveryRegressor,
                         testing::ValuesIn(available(Regressor::kKind)), test_name);

}  // namespace
}  // namespace lacuna::contract
