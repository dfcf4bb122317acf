// SPDX-License-Identifier: MIT
#include "diagnose/hypotheses/input_holds.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/random.hpp"
#include "lacuna/model/files/model_file.hpp"
#include "support/asked.hpp"
#include "support/assimilated_oscillator.hpp"
#include "support/held_oscillator.hpp"
#include "support/one_record.hpp"

namespace lacuna {
namespace {

ChosenHolds chosen(const Dataset& data) {
  const support::Asked asked{.records = observed(data)};
  return choose_holds(asked.problem());
}

std::optional<Hold> hold_of(const ChosenHolds& chosen) { return chosen.model.inputs()[0].hold; }

/// A held force on an oscillator with dry friction, which the model lacks.
Dataset rubbing() {
  return support::held_record(Hold::Zero, 2e-3, 9,
                              [](double v) { return -0.3 * std::tanh(v / 0.01); });
}

class TrueHold : public ::testing::TestWithParam<Hold> {};

TEST_P(TrueHold, IsTheMostLikelyOne) {
  const ChosenHolds found = chosen(support::held_record(GetParam(), 2e-4));
  ASSERT_TRUE(hold_of(found).has_value());
  EXPECT_EQ(to_string(*hold_of(found)), to_string(GetParam()));
  EXPECT_EQ(found.trail.size(), 4U);
  EXPECT_THAT(notes_on_holds(found.model, found.open), ::testing::SizeIs(1));
}

INSTANTIATE_TEST_SUITE_P(All, TrueHold,
                         ::testing::Values(Hold::Zero, Hold::Linear, Hold::Switching),
                         [](const auto& hold) { return to_string(hold.param); });

TEST(InputHolds, OfADenseInputLinesAndSwitchesAreNotAsked) {
  support::Asked asked{.records = observed(support::hidden_record(support::nothing, 0.01))};
  EXPECT_THAT(choose_holds(asked.problem()).trail, ::testing::SizeIs(2));
  asked.options.decision.dense_input = 0.0;
  EXPECT_THAT(choose_holds(asked.problem()).trail, ::testing::SizeIs(4)) << "none is dense";
}

/// Lines from each fifth sample to the next were put there by who made the record.
TEST(InputHolds, OfAnInterpolatedInputNoneIsAsked) {
  support::Asked asked{.records = observed(support::held_record(Hold::Zero, 1e-3))};
  Trajectory& record = asked.records.data.trajectories.front();
  Random random(5);
  const Index last = record.samples() - 1;
  for (Index i = 0; i <= last; i += 5) record.inputs(i, 0) = random.normal();
  record.inputs(last, 0) = random.normal();
  for (Index i = 0; i < last; ++i) {
    const Index before = i - i % 5, after = std::min(before + 5, last);
    const double place = static_cast<double>(i - before) / static_cast<double>(after - before);
    record.inputs(i, 0) =
        (1.0 - place) * record.inputs(before, 0) + place * record.inputs(after, 0);
  }
  const ChosenHolds found = choose_holds(asked.problem());
  EXPECT_EQ(hold_of(found), Hold::Smooth);
  EXPECT_LE(found.trail.size(), 1U);
}

TEST(InputHolds, WhatIsMissingDoesNotChangeThem) {
  EXPECT_EQ(hold_of(chosen(rubbing())), Hold::Zero);
}

TEST(InputHolds, WhatTheModelSaysIsNotAsked) {
  support::Asked asked{.records = observed(support::held_record(Hold::Zero, 1e-3))};
  asked.nominal = asked.nominal.with_holds({Hold::Linear});
  const ChosenHolds found = choose_holds(asked.problem());
  EXPECT_EQ(hold_of(found), Hold::Linear);
  EXPECT_TRUE(found.trail.empty());
}

/// A filter of first order behind a source whose samples lie on lines from each tenth to the next.
/// @param steps whether the source was held from sample to sample none the less.
Dataset behind_a_source(const OdeModel& filter, bool steps) {
  constexpr double kStep = 0.1, kTime = 2.0;  // tau of the model
  const double left = std::exp(-kStep / kTime);
  Random random(3);
  Trajectory record;
  record.time = Vector::LinSpaced(600, 0.0, 599 * kStep);
  record.states.resize(600, 1);
  record.inputs.resize(600, 1);
  double from = 0.0, to = 0.0, value = 0.0;
  for (Index i = 0; i < 600; ++i) {
    if (i % 10 == 0) from = std::exchange(to, random.normal());
    const double u = from + (to - from) * static_cast<double>(i % 10) / 10.0;
    const double slope = steps ? 0.0 : (to - from) / (10.0 * kStep);
    record.inputs(i, 0) = u;
    record.states(i, 0) = value + 1e-3 * random.normal();
    value = u + slope * (kStep - kTime) + (value - u + slope * kTime) * left;
  }
  return support::one_record(filter.states(), filter.inputs(), record);
}

TEST(InputHolds, SamplesOnLinesContradictAModelThatSaysHeld) {
  const OdeModel filter = parse_ode("input u hold zero\ndx/dt = 0.5*u - 0.5*x\n", "made");
  const auto found = [&](bool steps) {
    support::Asked asked{.records = observed(behind_a_source(filter, steps))};
    asked.nominal = filter;
    return choose_holds(asked.problem());
  };
  const ChosenHolds lines = found(false);
  EXPECT_EQ(hold_of(lines), Hold::Linear);
  EXPECT_THAT(lines.trail, ::testing::SizeIs(2));
  EXPECT_THAT(notes_on_holds(lines.model, lines.open), ::testing::SizeIs(1));
  EXPECT_EQ(hold_of(found(true)), Hold::Zero) << "what is more likely is not given up";
}

/// Dry friction beside a force that is held.
class HoldsBesideFriction : public ::testing::Test {
 protected:
  /// The friction that is found under a hold.
  CompositeModel composite_under(Hold hold, const std::string& friction = "tanh(v/0.01)") {
    asked_.nominal = asked_.nominal.with_holds({hold});
    CompositeModel composite = asked_.bare();
    composite.explanation =
        explain_on(asked_.problem(), *composite.base, composite.base->fitted,
                   {{support::plain_candidate(friction), Vector(0), -0.3, 0.0}});
    return composite;
  }

  support::Asked asked_{.records = observed(rubbing())};
};

TEST_F(HoldsBesideFriction, AreJudgedAnew) {
  const auto rivals_under = [&](Hold hold) {
    const CompositeModel composite = composite_under(hold);
    return rival_holds(asked_.problem(), {0, Hold::Linear, 1e9}, composite).models;
  };
  const auto rivals = rivals_under(Hold::Smooth);
  ASSERT_FALSE(rivals.empty()) << "the held force fits better";
  EXPECT_EQ(rivals.front().inputs()[0].hold, Hold::Zero);
  EXPECT_TRUE(rivals_under(Hold::Zero).empty());
}

/// With a friction that is not quite the true one.
TEST_F(HoldsBesideFriction, AreSettledByMoreThanTheEffectsExplain) {
  const CompositeModel composite = composite_under(Hold::Zero, "tanh(v/0.03)");
  const double explained = composite.base->fitted.deviance - composite.explanation.fit.deviance;
  ASSERT_GT(explained, 100.0);
  const auto rivals_with = [&](double lead) {
    return rival_holds(asked_.problem(), {0, Hold::Linear, lead}, composite).models;
  };
  ASSERT_EQ(rivals_with(0.99 * explained).size(), 1u);
  EXPECT_EQ(rivals_with(0.99 * explained).front().inputs()[0].hold, Hold::Linear);
  EXPECT_TRUE(rivals_with(1.01 * explained).empty());
}

TEST_F(HoldsBesideFriction, AreSettledWhereNothingDisturbsTheModel) {
  const CompositeModel composite = composite_under(Hold::Zero);
  const RivalHolds rivals =
      rival_holds(asked_.problem(), {0, Hold::Linear, 0.0}, composite);
  EXPECT_TRUE(rivals.models.empty());
  EXPECT_EQ(rivals.most_parameters, 1) << "as many as the effect has";
}

}  // namespace
}  // namespace lacuna
