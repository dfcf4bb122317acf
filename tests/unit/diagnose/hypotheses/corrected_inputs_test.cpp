// SPDX-License-Identifier: MIT
// Inputs that were recorded with noise, seldom or otherwise than they act.
#include "diagnose/hypotheses/corrected_inputs.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "cli/configuration/diagnosis_configuration.hpp"
#include "core/base/random.hpp"
#include "diagnose/hypotheses/input_noise.hpp"
#include "diagnose/hypotheses/sensor_fault.hpp"
#include "lacuna/diagnose/diagnose.hpp"
#include "records/channels/interpolated.hpp"
#include "support/asked.hpp"
#include "support/assimilated_oscillator.hpp"

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

/// Records whose force was measured with noise of this deviation.
support::Asked with_noise(double deviation) {
  support::Asked asked = support::asked(support::nothing);
  Dataset data = asked.records.data;
  Random random(11);
  Matrix& inputs = data.trajectories[0].inputs;
  for (Index i = 0; i < inputs.rows(); ++i) inputs(i, 0) += deviation * random.normal();
  asked.records = observed(data);
  return asked;
}

bool is_left_in_v(const std::vector<EquationStructure>& left) {
  return std::any_of(left.begin(), left.end(), [](const EquationStructure& one) {
    return one.equation == 1 && one.sigma > 3.0 && one.relative > 1e-3;
  });
}

TEST(InputNoise, IsWhatSamplesShow) {
  const auto shown = noise_of_inputs(with_noise(0.2).records.data);
  ASSERT_EQ(shown.size(), 1u);
  EXPECT_NEAR(shown[0].noise, 0.2, 0.02);
  EXPECT_NEAR(shown[0].deviation, std::hypot(0.2, std::sqrt(0.5 * (1.0 + 0.49 + 0.25))), 0.1);
  EXPECT_EQ(noise_of_inputs(with_noise(0.0).records.data)[0].noise, 0.0);
}

TEST(InputNoise, DoesNotHideWhatIsMuchMore) {
  support::Asked asked = support::asked(support::ripple);
  asked.options.decision.input_noise = 0.6;
  EXPECT_TRUE(noisy_inputs(asked.problem(), asked.baseline()->fitted).empty());
  EXPECT_TRUE(is_left_in_v(structure_left(asked.problem(), asked.baseline()->fitted)));
}

Dataset with_noisy_input(Dataset data, double noise, std::uint64_t seed = 11) {
  Random random(seed);
  for (Trajectory& record : data.trajectories)
    for (double& u : record.inputs.reshaped()) u += noise * random.normal();
  return data;
}

double off(const Dataset& data, const Dataset& truth) {
  const Matrix rest = data.trajectories[0].inputs - truth.trajectories[0].inputs;
  return std::sqrt(rest.array().square().mean());
}

/// The force as levels that jump.
Dataset levels(std::uint64_t seed, double noise) {
  Random random(seed);
  Dataset data = support::hidden_record(support::nothing, 0.0);
  Trajectory& record = data.trajectories[0];
  double level = 1.0, q = 0.5, v = 0.0;
  for (Index i = 0; i < record.samples(); ++i) {
    if (i % 60 == 0) level = random.uniform(-2.0, 2.0);
    record.states.row(i) << q + 1e-4 * random.normal(), v + 1e-4 * random.normal();
    record.inputs(i, 0) = level;
    constexpr int kParts = 200;  // of a step: semi-implicit Euler
    for (int part = 0; part < kParts; ++part) {
      v += 0.02 / kParts * (-4.0 * q - 0.2 * v + level);
      q += 0.02 / kParts * v;
    }
  }
  return with_noisy_input(std::move(data), noise, seed + 1);
}

TEST(InputSmoothing, KeepsTheJumpsOfLevels) {
  const support::Asked asked{.records = observed(levels(3, 0.05))};
  const auto composites = InputSmoothing{}.propose(asked.problem(), asked.bare()).composites;
  ASSERT_EQ(composites.size(), 1u);
  const Dataset smooth = composites[0].composite.base->correct(levels(9, 0.05));
  EXPECT_LT(off(smooth, levels(9, 0.0)), 0.5 * 0.05);
}

TEST(InputSmoothing, NoiseThatActsStays) {
  // A record in which what was measured is what acted, noise and all.
  Dataset data = levels(3, 0.0);
  Trajectory& record = data.trajectories[0];
  Random random(4);
  double q = 0.5, v = 0.0;
  for (Index i = 0; i < record.samples(); ++i) {
    record.inputs(i, 0) += 0.3 * random.normal();
    record.states.row(i) << q + 1e-4 * random.normal(), v + 1e-4 * random.normal();
    for (int part = 0; part < 200; ++part) {
      v += 1e-4 * (-5.0 * q - 0.2 * v + record.inputs(i, 0));
      q += 1e-4 * v;
    }
  }
  const support::Asked asked{.records = observed(data)};
  EXPECT_TRUE(InputSmoothing{}.propose(asked.problem(), asked.bare()).composites.empty());
}

TEST(InputSmoothing, NoPlayIsNamedForNoise) {
  Configuration configuration;
  configuration.set("effects=[\"backlash\",\"delay\",\"lag\",\"dead-zone\"]");
  const Diagnosis found =
      diagnose(support::oscillator(), levels(3, 0.05), levels(9, 0.05),
               diagnosis_options(configuration, default_registry()), RunContext{});
  EXPECT_TRUE(found.effects.empty());
}

}  // namespace
}  // namespace lacuna
