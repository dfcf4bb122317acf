// SPDX-License-Identifier: MIT
#include "trajectories/smoother/innovation_system.hpp"

#include <gtest/gtest.h>

#include "support/driven_oscillator.hpp"

namespace lacuna {
namespace {

TEST(InnovationSystem, StacksTheRecords) {
  Dataset data = support::hidden_record(support::nothing, 0.01);
  data.trajectories.push_back(data.trajectories.front());
  AssimilationOptions options;
  options.free = free_coefficients(support::oscillator());
  const Assimilation fit =
      assimilate(support::oscillator(), as_measured(data), options, RunContext{});
  const InnovationSystem system(fit);
  EXPECT_EQ(system.rows(), 2 * 3002);
  EXPECT_EQ(system.offsets().back(), system.rows());
  const Matrix columns = system.fitted_columns();
  ASSERT_EQ(columns.cols(), 3);
  const std::vector<TermValues> terms = system.free_terms();
  ASSERT_EQ(terms.size(), 2u);
  EXPECT_TRUE(terms[0].empty()) << "nothing is free in an identity";
  ASSERT_EQ(terms[1].size(), 2u) << "records";
  EXPECT_EQ(terms[1][0].rows(), 3001);
  EXPECT_EQ(terms[1][0].cols(), 3);
  EXPECT_EQ(columns, system.fitted_columns(terms));
  // At the maximum of the likelihood no fitted coefficient wants to move.
  for (Index j = 0; j < 3; ++j)
    EXPECT_LT(std::abs(columns.col(j).dot(system.innovations())) / columns.col(j).norm(), 0.5);
}

TEST(InnovationSystem, FormulasAreEvaluatedBetweenSamplesToo) {
  const Dataset data = support::hidden_record(support::nothing, 0.0);
  const LinearisedRecord grid =
      grid_of(data.inputs, data.trajectories.front(), data.trajectories.front().states);
  const Vector values = evaluate_on(grid, support::oscillator().variables(),
                                    parse_expression("2*q+delay(v,0.02)"));
  ASSERT_EQ(values.size(), 3001);
  EXPECT_NEAR(values[20], 2.0 * grid.path(10, 0) + grid.path(9, 1), 1e-12);
}

}  // namespace
}  // namespace lacuna
