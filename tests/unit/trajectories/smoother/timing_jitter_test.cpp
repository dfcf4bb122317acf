// SPDX-License-Identifier: MIT
#include "trajectories/smoother/timing_jitter.hpp"

#include <gtest/gtest.h>

#include "core/base/random.hpp"
#include "support/assimilated_oscillator.hpp"

namespace lacuna {
namespace {

/// The oscillator, its states moved along their rates by a time that scatters. @param shared
/// whether both states are taken at one time.
Dataset scattered(double deviation, bool shared) {
  Dataset data = support::hidden_record(support::nothing, 0.002);
  Trajectory& record = data.trajectories[0];
  const Matrix states = record.states;
  Random random(7);
  for (Index i = 1; i + 1 < record.samples(); ++i) {
    double late = deviation * random.normal();
    for (Index k = 0; k < 2; ++k) {
      const double rate =
          (states(i + 1, k) - states(i - 1, k)) / (record.time[i + 1] - record.time[i - 1]);
      record.states(i, k) += late * rate;
      if (!shared) late = deviation * random.normal();
    }
  }
  return data;
}

TEST(TimingJitter, IsHowFarTheTimesScatter) {
  for (const bool shared : {true, false}) {
    const TimingJitter found = timing_jitter(support::assimilated(scattered(0.01, shared)));
    EXPECT_NEAR(found.deviation, shared ? 0.01 : 0.008, 0.002);
    EXPECT_GT(found.sigma, 5.0);
    EXPECT_GT(found.fraction, 0.5);
  }
}

}  // namespace
}  // namespace lacuna
