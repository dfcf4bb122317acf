// SPDX-License-Identifier: MIT
#include "trajectories/refiners/noise_growth.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.hpp"

namespace lacuna {
namespace {

/// Growth from 1 to 100 with noise sqrt(floor^2 + (fraction x)^2).
Dataset growing(double floor, double fraction, Index samples, std::uint64_t seed) {
  Random random(seed);
  Dataset data;
  data.states = {{"x", ""}};
  Trajectory& record = data.trajectories.emplace_back();
  record.time = Vector::LinSpaced(samples, 0.0, 10.0);
  record.states.resize(samples, 1);
  record.inputs.resize(samples, 0);
  for (Index i = 0; i < samples; ++i) {
    const double x = 100.0 / (1.0 + 99.0 * std::exp(-record.time[i]));
    const double deviation = std::sqrt(floor * floor + fraction * fraction * x * x);
    record.states(i, 0) = x + deviation * random.normal();
  }
  return data;
}

SampleNoise noise_of(const Dataset& data, const GrowingNoise& rule = {}) {
  const std::vector<StateNoise> noise = analyse_noise(data);
  return noise_of_samples(data, Vector::Constant(1, noise[0].sigma), noise, rule);
}

TEST(NoiseGrowth, IsFoundWithItsFraction) {
  for (const Index samples : {256, 512, 4096}) {
    const SampleNoise noise = noise_of(growing(0.0, 0.05, samples, 1));
    ASSERT_TRUE(noise.growth[0].has_value()) << samples;
    EXPECT_NEAR(noise.growth[0]->fraction, 0.05, 0.01) << samples;
    const Matrix& deviations = noise.deviations[0];
    EXPECT_NEAR(deviations(samples - 5, 0), 5.0, 1.0);
    EXPECT_LT(deviations(4, 0), 0.2);
    EXPECT_NEAR(noise.rms[0], std::sqrt(deviations.squaredNorm() / double(samples)), 1e-12);
  }
}

TEST(NoiseGrowth, KnowsAFloor) {
  const SampleNoise noise = noise_of(growing(1.0, 0.05, 4096, 2));
  ASSERT_TRUE(noise.growth[0].has_value());
  EXPECT_NEAR(noise.growth[0]->floor, 1.0, 0.2);
  EXPECT_NEAR(noise.growth[0]->fraction, 0.05, 0.01);
  EXPECT_NEAR(noise.growth[0]->at(20.0), std::sqrt(2.0), 0.3);
}

TEST(NoiseGrowth, TheRuleDecides) {
  const Dataset data = growing(0.0, 0.05, 512, 1);
  EXPECT_FALSE(noise_of(data, {.least_fraction = 0.1}).growth[0].has_value());
  EXPECT_FALSE(noise_of(data, {.significance = 1e3}).growth[0].has_value());
  EXPECT_FALSE(noise_of(data, {.unit_variance = 0.5}).growth[0].has_value());
}

TEST(NoiseGrowth, ConstantNoiseDoesNotGrow) {
  int growing_ones = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    const SampleNoise noise = noise_of(growing(1.0, 0.0, 512, seed));
    growing_ones += noise.growth[0].has_value();
    if (noise.growth[0]) continue;
    EXPECT_EQ(noise.deviations[0].minCoeff(), noise.rms[0]);
  }
  EXPECT_LE(growing_ones, 2);
}

TEST(NoiseGrowth, DoesNotVanishWhereASignalCrossesZero) {
  Random random(3);
  Dataset data = growing(0.0, 0.0, 1000, 1);
  for (Index i = 0; i < 1000; ++i)
    data.trajectories[0].states(i, 0) =
        std::sin(data.trajectories[0].time[i]) * (1.0 + 0.05 * random.normal());
  const SampleNoise noise = noise_of(data);
  ASSERT_TRUE(noise.growth[0].has_value());
  EXPECT_GT(noise.deviations[0].minCoeff(), 1e-4);
}

TEST(NoiseGrowth, FastStretchesAreNoNoise) {
  // Spikes, sampled coarsely: what differences see of them is largest where they are high.
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Random random(seed);
    Dataset data = growing(0.0, 0.0, 3000, 1);
    for (Index i = 0; i < 3000; ++i) {
      const double phase = 0.05 * static_cast<double>(i);
      data.trajectories[0].states(i, 0) =
          std::exp(8.0 * (std::cos(phase) - 1.0)) + 0.002 * random.normal();
    }
    EXPECT_FALSE(noise_of(data).growth[0].has_value()) << seed;
  }
}

TEST(NoiseGrowth, ErrorsOfSolversAndDigitsAreNoNoise) {
  EXPECT_FALSE(noise_of(growing(0.0, 1e-6, 4096, 1)).growth[0].has_value());
  EXPECT_TRUE(noise_of(growing(0.0, 1e-3, 4096, 1)).growth[0].has_value());
}

}  // namespace
}  // namespace lacuna
