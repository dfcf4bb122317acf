// SPDX-License-Identifier: MIT
#include "diagnose/hints/slips.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "support/diagnosis_scope.hpp"

namespace lacuna {
namespace {

const OdeModel kSlipped = support::oscillator();  // q, v; F

bool is_tried(const std::vector<Slip>& slips, const Slip& wanted) {
  return std::any_of(slips.begin(), slips.end(), [&](const Slip& slip) {
    return slip.kind == wanted.kind && slip.channels == wanted.channels &&
           std::abs(slip.correction / wanted.correction - 1.0) < 1e-12;
  });
}

TEST(Slips, OfTimeChannelsChainsAndColumnsAreTried) {
  const std::vector<Slip> slips = possible_slips(kSlipped, support::oscillator_record());
  for (const double factor : {1e-3, 1e6, 60.0, 1.0 / 3600.0})
    EXPECT_TRUE(is_tried(slips, {HintKind::TimeUnit, {}, factor})) << factor;
  for (const double factor : {10.0, 1e-6, 57.29577951308232, 6.283185307179586})
    for (const std::vector<Index>& group : {std::vector<Index>{0}, {1}, {2}, {0, 1}})
      EXPECT_TRUE(is_tried(slips, {HintKind::ChannelUnit, group, factor})) << factor;
  EXPECT_TRUE(is_tried(slips, {HintKind::Sign, {2}, -1.0}));
  EXPECT_TRUE(is_tried(slips, {HintKind::SwappedColumns, {0, 2}}));
}

TEST(Slips, AreNotTriedOnStatesThatWereMade) {
  Dataset data = support::oscillator_record();
  data.reconstructed = {false, true};
  ASSERT_FALSE(possible_slips(kSlipped, data).empty());
  for (const Slip& slip : possible_slips(kSlipped, data)) {
    EXPECT_EQ(std::count(slip.channels.begin(), slip.channels.end(), 1), 0);
    EXPECT_NE(slip.kind, HintKind::SwappedColumns);
  }
}

TEST(Slips, AreUndone) {
  const Dataset data = support::oscillator_record();
  const Trajectory& given = data.trajectories[0];
  const Dataset time = corrected(kSlipped, data, {HintKind::TimeUnit, {}, 0.001});
  EXPECT_DOUBLE_EQ(time.trajectories[0].time[1000], 0.01);
  EXPECT_EQ(time.trajectories[0].states, given.states);
  const Dataset unit = corrected(kSlipped, data, {HintKind::ChannelUnit, {1, 2}, 10.0});
  EXPECT_EQ(unit.trajectories[0].states.col(0), given.states.col(0));
  EXPECT_EQ(unit.trajectories[0].states.col(1), 10.0 * given.states.col(1));
  EXPECT_EQ(unit.trajectories[0].inputs, 10.0 * given.inputs);
  const Dataset swapped = corrected(kSlipped, data, {HintKind::SwappedColumns, {1, 2}});
  EXPECT_EQ(swapped.trajectories[0].states.col(1), given.inputs.col(0));
  EXPECT_EQ(swapped.trajectories[0].inputs.col(0), given.states.col(1));
}

TEST(Slips, MadeStatesFollow) {
  Dataset data = support::oscillator_record();
  data.reconstructed = {false, true};
  const Matrix& given = data.trajectories[0].states;
  const Dataset time = corrected(kSlipped, data, {HintKind::TimeUnit, {}, 0.001});
  EXPECT_LT((time.trajectories[0].states.col(1) - 1000.0 * given.col(1)).norm(), 1e-9);
  const Dataset unit = corrected(kSlipped, data, {HintKind::ChannelUnit, {0}, 10.0});
  EXPECT_EQ(unit.trajectories[0].states, 10.0 * given);
}

TEST(Slips, ThatOneCoefficientMayBeAsWell) {
  const auto change = as_coefficient(kSlipped, {HintKind::ChannelUnit, {2}, 10.0});
  ASSERT_TRUE(change);
  EXPECT_EQ(change->equation, 1);
  EXPECT_EQ(change->summand, 2);
  EXPECT_DOUBLE_EQ(change->factor, 10.0);
  EXPECT_FALSE(as_coefficient(kSlipped, {HintKind::ChannelUnit, {0}, 10.0})) << "an identity";
  EXPECT_FALSE(as_coefficient(kSlipped, {HintKind::TimeUnit, {}, 10.0})) << "more than one";
  const OdeModel decay({{"x", ""}}, {}, {{{Term::parse("x^2", {{"x"}, {}}), -0.5}}});
  EXPECT_DOUBLE_EQ(as_coefficient(decay, {HintKind::ChannelUnit, {0}, 10.0})->factor, 10.0)
      << "(10 x)' = -0.5 (10 x)^2 is x' = -5 x^2";
  EXPECT_DOUBLE_EQ(as_coefficient(decay, {HintKind::TimeUnit, {}, 60.0})->factor, 60.0);
}

}  // namespace
}  // namespace lacuna
