// SPDX-License-Identifier: MIT
#include "lacuna/regression/pruners/sequential_thresholding.hpp"

#include <gtest/gtest.h>

#include "support/pruner_checks.hpp"

namespace lacuna {
namespace {

using testing::rossler_10000;

TEST(SequentialThresholding, FindsRosslersTermsHoweverWritten) {
  const Matrix noisy = testing::with_noise(rossler_10000().derivatives, 1e-4, 3);
  testing::expect_rossler_terms(SequentialThresholding(), rossler_10000().derivatives, 3);
  for (const auto& r : testing::rewritings())
    testing::expect_rossler_terms(SequentialThresholding(), noisy, 3, r);
}

TEST(SequentialThresholding, KeptTermsAreAboveTheThresholdAndRemovedOnesWereBelow) {
  const auto& data = rossler_10000();
  const auto system =
      testing::monomial_system(data.states, testing::with_noise(data.derivatives, 0.1, 3), 2);
  const SequentialThresholding pruner({.threshold = 0.3});
  const PruneResult result = pruner.prune(system, 2, system.all_terms(), Ols());
  const Regression fit = Ols().fit(system, system.subproblem(2, result.kept));
  for (const auto& [name, fraction] :
       testing::fractions(system, 2, fit.active, fit.coefficients, {"same"}))
    EXPECT_GE(std::abs(fraction), 0.3) << name;
  EXPECT_FALSE(result.removed.empty());
  for (const Removal& gone : result.removed) EXPECT_LT(gone.value, 0.3);
}

TEST(SequentialThresholding, SurvivesOddProblems) {
  testing::expect_survives_odd_problems(SequentialThresholding());
}

}  // namespace
}  // namespace lacuna
