// SPDX-License-Identifier: MIT
// Inputs that are recorded late: the time of their samples is told, and nothing in its place.
#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.hpp"
#include "diagnose/hypotheses/sensor_fault.hpp"
#include "lacuna/diagnose/journey/diagnose.hpp"
#include "support/asked.hpp"
#include "support/assimilated_oscillator.hpp"
#include "support/held_oscillator.hpp"

namespace lacuna {
namespace {

/// The force of hidden_record() as it was so long ago.
Dataset late_force(Dataset data, double late) {
  for (Trajectory& record : data.trajectories)
    for (Index i = 0; i < record.time.size(); ++i) {
      const double t = record.time[i] - late;
      record.inputs(i, 0) =
          std::sin(1.7 * t) + 0.7 * std::sin(2.9 * t + 1.0) + 0.5 * std::sin(0.6 * t);
    }
  return data;
}

support::Asked asked_of(const Dataset& data) { return {.records = observed(data)}; }

std::vector<Proposal> moved_ahead_in(const support::Asked& asked) {
  return InputSkew{}.propose(asked.problem(), asked.bare()).composites;
}

class LateForce : public ::testing::TestWithParam<double> {};

TEST_P(LateForce, IsMovedAhead) {
  const double late = GetParam();
  const auto composites = moved_ahead_in(
      asked_of(late_force(support::hidden_record(support::nothing, 2e-3), late)));
  ASSERT_EQ(composites.size(), 1u);
  EXPECT_TRUE(composites[0].search_first);
  const CompositeModel& composite = composites[0].composite;
  ASSERT_EQ(composite.findings.size(), 1u);
  const NamedEffect& found = composite.findings[0];
  EXPECT_EQ(found.name, "channel-skew");
  EXPECT_EQ(found.equation, 1);
  EXPECT_NEAR(found.parameters.at(0).value, late, 1e-3);
  EXPECT_NEAR(found.coefficient, late, 1e-3) << "the force acts with coefficient 1";
  ASSERT_GT(found.deviation, 0.0);
  EXPECT_LT(std::abs(found.coefficient - late), 4.0 * found.deviation + 1e-4);
  EXPECT_LT(found.deviation, 1e-3);
  EXPECT_GT(found.gap_closed, 0.99);
  EXPECT_FALSE(leaves_structure(composite, DecisionOptions{}));
  // Other records are moved alike.
  const Dataset other =
      composite.base->correct(support::hidden_record(support::nothing, 0.0, 4));
  const Dataset ahead =
      late_force(support::hidden_record(support::nothing, 0.0, 4), -found.parameters[0].value);
  const Index inner = other.trajectories[0].time.size() - 20;
  EXPECT_LT((other.trajectories[0].inputs - ahead.trajectories[0].inputs)
                .topRows(inner)
                .cwiseAbs()
                .maxCoeff(),
            1e-5);
}

INSTANTIATE_TEST_SUITE_P(Steps, LateForce, ::testing::Values(0.01, 0.02, 0.05, 0.073),
                         [](const auto& late) {
                           return std::to_string(std::lround(1000 * late.param)) + "ms";
                         });

TEST(InputSkew, NothingIsProposedOfAForceThatIsInTimeOrEarly) {
  const Dataset in_time = support::hidden_record(support::nothing, 2e-3);
  EXPECT_TRUE(moved_ahead_in(asked_of(in_time)).empty());
  EXPECT_TRUE(moved_ahead_in(asked_of(late_force(in_time, -0.05))).empty())
      << "a delay of the plant";
  EXPECT_TRUE(
      moved_ahead_in(asked_of(support::hidden_record(support::dry_friction, 2e-3))).empty());
}

TEST(InputSkew, TheStandardErrorIsTheScatterOfTheTime) {
  constexpr int kDraws = 24;
  double scatter = 0.0, said = 0.0;
  for (int draw = 0; draw < kDraws; ++draw) {
    const Dataset data = support::hidden_record(support::nothing, 1e-2, 100 + draw);
    const auto composites = moved_ahead_in(asked_of(late_force(data, 0.05)));
    ASSERT_EQ(composites.size(), 1u);
    const NamedParameter& lead = composites[0].composite.findings.at(0).parameters.at(0);
    scatter += std::pow(lead.value - 0.05, 2) / kDraws;
    said += std::pow(lead.deviation.value(), 2) / kDraws;
  }
  EXPECT_NEAR(std::sqrt(scatter / said), 1.0, 0.25);
}

TEST(InputSkew, NoiseOfTheForceIsNoTimeOfIt) {
  Dataset noisy = support::hidden_record(support::nothing, 1e-3);
  Random random(8);
  for (double& force : noisy.trajectories[0].inputs.reshaped()) force += 0.2 * random.normal();
  const support::Asked asked = asked_of(noisy);
  ASSERT_TRUE(leaves_structure(asked.bare(), asked.options.decision) ||
              asked.bare().explanation.fit.noise.disturbance[1] > 0.0);
  EXPECT_TRUE(moved_ahead_in(asked).empty());
}

TEST(InputSkew, HeldInputsAreLateByWholeSteps) {
  Dataset data = support::held_record(Hold::Zero, 1e-3);
  Trajectory& record = data.trajectories.front();
  const Index n = record.time.size() - 3;
  const Vector before = record.inputs.col(0).head(n);
  record.inputs.col(0).tail(n) = before;
  support::Asked asked = asked_of(data);
  asked.nominal = asked.nominal.with_holds({Hold::Zero});
  const auto composites = moved_ahead_in(asked);
  ASSERT_EQ(composites.size(), 1u);
  const CompositeModel& composite = composites[0].composite;
  EXPECT_NEAR(composite.findings.at(0).parameters.at(0).value, 0.06, 1e-9);
  const Vector moved = composite.base->correct(data).trajectories[0].inputs.col(0);
  EXPECT_EQ(moved.head(n), record.inputs.col(0).tail(n));
}

}  // namespace
}  // namespace lacuna
