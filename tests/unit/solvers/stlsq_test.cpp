// SPDX-License-Identifier: MIT
#include "lacuna/solvers/stlsq.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/sparse_problem.hpp"
#include "support/rossler_system.hpp"

namespace lacuna {
namespace {

using testing::rossler_10000;

TEST(Stlsq, FindsRosslersEquations) {
  const auto system =
      testing::monomial_system(rossler_10000().states, rossler_10000().derivatives, 3);
  for (Index k = 0; k < 3; ++k) {
    const Regression fit = Stlsq().fit(system, system.subproblem(k, system.all_terms()));
    EXPECT_THAT(testing::names_of(system, fit.active),
                ::testing::UnorderedElementsAreArray(
                    testing::rossler_terms()[static_cast<std::size_t>(k)]));
    EXPECT_EQ(fit.removed.size() + fit.active.size(), 20u);
  }
}

TEST(Stlsq, RawThresholdRemovesSmallCoefficients) {
  const auto system = testing::sparse_problem(500, 0.05, 0.0);
  StlsqOptions options;
  options.scale = StlsqOptions::Scale::Coefficient;
  options.threshold = 0.7;
  const Regression fit = Stlsq(options).fit(system, system.subproblem(0, system.all_terms()));
  EXPECT_EQ(fit.active, (TermSet{1, 4}));
  for (const Removal& gone : fit.removed) {
    EXPECT_LT(gone.value, 0.7);
    EXPECT_EQ(gone.quantity, "|h|");
  }
}

TEST(Stlsq, RidgeChoosesTermsButLeavesNoBias) {
  const auto system = testing::sparse_problem(500, 0.0, 0.0);
  StlsqOptions options;
  options.alpha = 1.0;
  options.threshold = 0.1;
  const Regression fit = Stlsq(options).fit(system, system.subproblem(0, system.all_terms()));
  ASSERT_EQ(fit.active, (TermSet{1, 4, 7}));
  EXPECT_TRUE(fit.coefficients.isApprox(Eigen::Vector3d(2.0, -1.0, 0.5), 1e-12));
  options.threshold = 0.15;  // 0.22 without the penalty, about half of it with it
  const Regression fewer = Stlsq(options).fit(system, system.subproblem(0, system.all_terms()));
  EXPECT_EQ(fewer.active, (TermSet{1, 4}));
}

}  // namespace
}  // namespace lacuna
