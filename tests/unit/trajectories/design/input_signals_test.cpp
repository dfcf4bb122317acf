// SPDX-License-Identifier: MIT
#include "trajectories/design/input_signals.hpp"

#include <gtest/gtest.h>

#include <set>

#include "core/base/random.hpp"

namespace lacuna {
namespace {

Vector grid(Index count) { return Vector::LinSpaced(count, 0.0, 0.1 * double(count - 1)); }

PlanInput input() {
  return {"u", -2.0, 6.0, {}, {}, {}, 4};
}

TEST(InputSignal, PrbsHasTwoLevelsAndBitsOfOneLength) {
  Vector design(4);
  design << 0.25, 0.75, 0.0, 0.3;
  const Vector u = input_signal(input(), InputFamily::Prbs, design, grid(2050), 0.1);
  const std::set<double> levels(u.begin(), u.end());
  EXPECT_EQ(levels, (std::set<double>{0.0, 4.0}));
  // Of the 2047 bits of a period of this register 1024 are 1, 1023 are 0.
  EXPECT_EQ((u.head(2047).array() == 4.0).count(), 1024);
  design[2] = 1.0;  // bits of a quarter of the time
  const Vector slow = input_signal(input(), InputFamily::Prbs, design, grid(81), 0.1);
  for (Index i = 1; i < 80; ++i) {
    const Index begin = i - i % 20;
    EXPECT_EQ(slow[i], slow[begin]) << i;
  }
}

TEST(InputSignal, AChirpGoesFromOneFrequencyToTheOther) {
  Vector design(5);
  design << 0.5, 1.0, 0.0, 0.0, 0.0;  // one period in all of the time
  const Vector u = input_signal(input(), InputFamily::Chirp, design, grid(81), 0.1);
  for (Index i = 0; i < 80; ++i)
    EXPECT_NEAR(u[i], 2.0 + 4.0 * std::sin(2.0 * M_PI * double(i) / 80.0), 1e-9);
}

TEST(InputSignal, AllFamiliesKeepRangeRateAndHold) {
  PlanInput limited = input();
  limited.rate = 3.0;
  limited.hold = 0.5;
  Random random(3);
  ASSERT_FALSE(all_input_families().empty());
  for (const InputFamily family : all_input_families())
    for (int draw = 0; draw < 20; ++draw) {
      Vector design(design_size(limited, family));
      for (double& value : design) value = random.uniform();
      const Vector u = input_signal(limited, family, design, grid(101), 0.1);
      ASSERT_GE(u.minCoeff(), -2.0) << to_string(family);
      ASSERT_LE(u.maxCoeff(), 6.0) << to_string(family);
      for (Index i = 1; i < u.size(); ++i)
        ASSERT_LE(std::abs(u[i] - u[i - 1]), i % 5 == 0 ? 1.5 + 1e-12 : 0.0)
            << to_string(family) << " " << i;
    }
}

TEST(ExperimentOf, SamplesAreTakenAtTheDesignedTimes) {
  PlanProblem problem;
  problem.channels = {{"y", 1.0}};
  problem.starts = {{"x", 1.0, 3.0}};
  problem.duration = 1.0;
  problem.step = 0.25;
  problem.measurements = 2;
  const DesignSpace space = design_spaces(problem).at(0);
  ASSERT_EQ(design_size(problem, space), 3);
  Vector design(3);
  design << 0.5, 0.9, 0.3;
  const Experiment experiment = experiment_of(problem, space, design);
  Vector expected(7);
  expected << 0.0, 0.25, 0.3, 0.5, 0.75, 0.9, 1.0;
  EXPECT_TRUE(experiment.time.isApprox(expected));
  EXPECT_EQ(experiment.measured.sum(), 2.0);
  EXPECT_EQ(experiment.measured(2, 0) + experiment.measured(5, 0), 2.0);
  ASSERT_EQ(experiment.starts.size(), 1u);
  EXPECT_EQ(experiment.starts[0].low, 2.0);
  EXPECT_EQ(experiment.starts[0].high, 2.0);
}

}  // namespace
}  // namespace lacuna
