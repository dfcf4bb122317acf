// SPDX-License-Identifier: MIT
#include "records/channels/shown_holds.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/driven_oscillator.hpp"
#include "support/held_oscillator.hpp"

namespace lacuna {
namespace {

TEST(ShownHolds, StepsShowThemselvesAndSmoothSignalsDoNot) {
  EXPECT_EQ(shown_hold(support::held_record(Hold::Zero, 0.0), 0), Hold::Zero);
  EXPECT_EQ(shown_hold(support::hidden_record(support::nothing, 0.0), 0), Hold::Smooth);
}

TEST(ShownHolds, EveryRecordInWhichItMovesHasToShowIt) {
  Dataset data = support::held_record(Hold::Zero, 0.0);
  Trajectory still = data.trajectories.front();
  still.inputs.setConstant(2.0);
  data.trajectories.push_back(still);
  EXPECT_EQ(shown_hold(data, 0), Hold::Zero);
  data.trajectories.push_back(
      support::hidden_record(support::nothing, 0.0).trajectories.front());
  EXPECT_EQ(shown_hold(data, 0), Hold::Smooth);
  data.trajectories = {still};
  EXPECT_EQ(shown_hold(data, 0), std::nullopt);
}

TEST(ShownHolds, TheModelComesFirst) {
  const OdeModel model = support::oscillator();
  const Dataset data = support::held_record(Hold::Zero, 0.0);
  EXPECT_EQ(with_shown_holds(model, data).inputs()[0].hold, Hold::Zero);
  EXPECT_EQ(with_shown_holds(model.with_holds({Hold::Linear}), data).inputs()[0].hold,
            Hold::Linear);
}

TEST(ShownHolds, RecordsGetThoseThatNothingIsSaidOf) {
  Dataset data = support::held_record(Hold::Zero, 0.0);
  data.inputs[0].hold.reset();
  const auto held = with_shown_holds(data);
  ASSERT_TRUE(held);
  EXPECT_EQ(held->inputs[0].hold, Hold::Zero);
  data.inputs[0].hold = Hold::Linear;
  EXPECT_FALSE(with_shown_holds(data));
  EXPECT_FALSE(with_shown_holds(support::hidden_record(support::nothing, 0.0)));
}

}  // namespace
}  // namespace lacuna
