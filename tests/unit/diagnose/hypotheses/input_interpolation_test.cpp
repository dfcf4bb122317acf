// SPDX-License-Identifier: MIT
// Inputs that were recorded seldom and put on lines: the curve through what was recorded.
#include <gtest/gtest.h>

#include "diagnose/hypotheses/sensor_fault.hpp"
#include "lacuna/diagnose/journey/diagnose.hpp"
#include "records/channels/interpolated.hpp"
#include "support/asked.hpp"
#include "support/assimilated_oscillator.hpp"

namespace lacuna {
namespace {

/// hidden_record() with every tenth sample of its force, and lines between.
Dataset seldom(Dataset data, Index each = 10) {
  for (Trajectory& record : data.trajectories) {
    const Vector force = record.inputs.col(0);
    for (Index i = 0; i < force.size(); ++i) {
      const Index knot = i - i % each, next = std::min<Index>(knot + each, force.size() - 1);
      const double fraction = static_cast<double>(i - knot) / static_cast<double>(each);
      record.inputs(i, 0) = (1.0 - fraction) * force[knot] + fraction * force[next];
    }
  }
  return data;
}

TEST(InputInterpolation, PutsTheInputOnTheCurveThroughWhatWasRecorded) {
  const Dataset smooth = support::hidden_record(support::nothing, 1e-3);
  const support::Asked asked{.records = observed(seldom(smooth))};
  ASSERT_TRUE(is_interpolated(asked.records.data, 0));
  const CompositeModel best = asked.bare();
  ASSERT_TRUE(leaves_structure(best, asked.options.decision)) << "the error of the lines";
  const auto composites = InputInterpolation{}.propose(asked.problem(), best).composites;
  ASSERT_EQ(composites.size(), 1u);
  const CompositeModel& composite = composites[0].composite;
  EXPECT_FALSE(leaves_structure(composite, asked.options.decision));
  ASSERT_EQ(composite.base->notes.size(), 1u);
  const Trajectory other = composite.base->correct(seldom(smooth)).trajectories[0];
  const auto error = [&](const Trajectory& record) {
    return (record.inputs - smooth.trajectories[0].inputs).cwiseAbs().maxCoeff();
  };
  EXPECT_LT(error(other), 0.1 * error(seldom(smooth).trajectories[0]));
}

}  // namespace
}  // namespace lacuna
