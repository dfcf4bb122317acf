// SPDX-License-Identifier: MIT
#include "diagnose/hypotheses/corrected_inputs.hpp"

#include <gtest/gtest.h>

#include "support/asked.hpp"

namespace lacuna {
namespace {

/// Records whose force was written down with half its size.
support::Asked halved() {
  Dataset data = support::hidden_record(support::nothing, 2e-3);
  data.trajectories[0].inputs *= 0.5;
  return {.records = observed(data)};
}

Dataset doubled(Dataset data) {
  for (Trajectory& record : data.trajectories) record.inputs *= 2.0;
  return data;
}

TEST(CorrectedInputs, TheBaselineIsThatOfTheCorrectedRecords) {
  const support::Asked asked = halved();
  const CompositeModel best = asked.bare();
  const Baseline base = corrected_baseline(asked.problem(), *best.base, doubled, 1.0);
  const support::Asked good{.records =
                                observed(support::hidden_record(support::nothing, 2e-3))};
  EXPECT_NEAR(base.fitted.deviance, good.bare().base->fitted.deviance, 0.5);
  EXPECT_NEAR(corrected_deviance(asked.problem(), *best.base, doubled, {}),
              base.fitted.deviance, 1.0);
  EXPECT_EQ(base.parameters, 1.0);
  // What was corrected before is corrected still, and first.
  const Baseline twice = corrected_baseline(
      asked.problem(), base,
      [](Dataset data) {
        data.trajectories[0].inputs.array() += 1.0;
        return data;
      },
      1.0);
  EXPECT_EQ(twice.parameters, 2.0);
  const Dataset& data = asked.records.data;
  EXPECT_EQ(twice.correct(data).trajectories[0].inputs,
            (2.0 * data.trajectories[0].inputs.array() + 1.0).matrix());
}

}  // namespace
}  // namespace lacuna
