// SPDX-License-Identifier: MIT
// Records as instruments give them, at 1 % noise: the structure is still found.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>
#include <vector>

#include "lacuna/dynamics/test_systems/test_systems.hpp"
#include "lacuna/identify/pipeline/presets.hpp"
#include "support/noisy_records.hpp"

namespace lacuna {
namespace {

constexpr Index kSamples = 2000;

/// What a test is made for: a system and a preset.
class HardRecords : public ::testing::TestWithParam<std::tuple<std::string, std::string>> {
 protected:
  std::string system() const { return std::get<0>(GetParam()); }

  Dataset record(std::uint64_t seed) const {
    return noisy_record(system(), kSamples, 0.01, seed);
  }

  Structure truth() const { return structure_of(test_system(system()).model); }

  void expect_found(const Dataset& data, const Structure& expected) const {
    Pipeline pipeline = preset(std::get<1>(GetParam()));
    pipeline.basis = Monomials{{.max_degree = 2}};
    const OdeModel found = identify(data, pipeline).model;
    EXPECT_EQ(structure_of(found), expected) << to_text(found, 4);
  }
};

TEST_P(HardRecords, OtherUnits) {
  Dataset data = record(11);
  Trajectory& orbit = data.trajectories.front();
  orbit.states.col(0) *= 1e-3;
  orbit.states.col(1) *= 1e4;
  orbit.time *= 1e-4;
  expect_found(data, truth());
}

TEST_P(HardRecords, OffsetChannels) {
  Dataset data = record(12);
  const Eigen::RowVector3d offsets = 0.5 * spread(data.trajectories.front().states).transpose();
  data.trajectories.front().states.rowwise() += offsets;
  // What the equations become: those of a clean record with the same offsets.
  const TestSystem& which = test_system(system());
  Dataset clean = record_of(which.model, Dopri87{}, which.start, which.step, kSamples);
  clean.trajectories.front().states.rowwise() += offsets;
  expect_found(data, structure_of(identify(clean, algorithm1()).model));
}

TEST_P(HardRecords, SixteenBits) {
  const Dataset data = record(13);
  const double range = 1.5 * data.trajectories.front().states.cwiseAbs().maxCoeff();
  expect_found(quantise(data, 16, range), truth());
}

TEST_P(HardRecords, OnePercentOutliers) {
  Dataset data = record(14);
  Matrix& states = data.trajectories.front().states;
  const Vector size = spread(states);
  Random random(5);
  for (Index k = 0; k < states.cols(); ++k)
    for (Index count = 0; count < kSamples / 100; ++count) {
      const auto i = static_cast<Index>(random.below(static_cast<std::uint64_t>(kSamples)));
      states(i, k) +=
          (random.uniform() < 0.5 ? -1.0 : 1.0) * random.uniform(1.0, 5.0) * size[k];
    }
  expect_found(data, truth());
}

TEST_P(HardRecords, TwentyPercentMissing) {
  Random random(6);
  std::vector<bool> missing(static_cast<std::size_t>(kSamples));
  for (std::size_t i = 0; i < missing.size(); ++i) missing[i] = random.uniform() < 0.2;
  expect_found(cut_at_gaps(record(15), missing), truth());
}

TEST_P(HardRecords, UnequalSteps) {
  const TestSystem& which = test_system(system());
  Random random(7);
  Vector times = sample_times(0.0, which.step, kSamples);
  for (double& t : times) t += random.uniform(-0.4, 0.4) * which.step;
  const Dataset grid = record_of(which.model, Dopri87{}, which.start, which.step, 2000);
  const Vector start = grid.trajectories.front().states.bottomRows(1).transpose();
  Dataset data = grid;
  Trajectory& orbit = data.trajectories.front();
  orbit.time = times;
  orbit.states = simulate(which.model, Dopri87{}, start, times).states;
  expect_found(add_relative_noise(data, 0.01, 16), truth());
}

INSTANTIATE_TEST_SUITE_P(Systems, HardRecords,
                         ::testing::Combine(::testing::Values("lorenz", "rossler"),
                                            ::testing::Values("algorithm1", "robust")),
                         [](const auto& test) {
                           return std::get<0>(test.param) + "_" + std::get<1>(test.param);
                         });

}  // namespace
}  // namespace lacuna
