// SPDX-License-Identifier: MIT
#include "lacuna/records/binding/bound_records.hpp"

#include <gtest/gtest.h>

#include "core/base/random.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/data/derivatives/finite_differences.hpp"
#include "support/harmonic_model.hpp"
#include "support/oscillation.hpp"

namespace lacuna {
namespace {

/// x with white noise of deviation 0.01, the input u, and no v.
Dataset without_rate() {
  Dataset data = oscillation_data();
  data.states = {{"x", "m"}};
  Trajectory& record = data.trajectories[0];
  record.states = Matrix(record.states.leftCols(1));
  Random random(9);
  for (double& x : record.states.reshaped()) x += 0.01 * random.normal();
  return data;
}

TEST(Bind, SaysHowEachStateWasMeasured) {
  Dataset data = without_rate();
  data.trajectories[0].states(50, 0) += 1.0;
  const BoundRecords records = bind(support::harmonic_model(), data, FiniteDifferences{});
  EXPECT_EQ(records.data.states, support::harmonic_model().states());
  ASSERT_EQ(records.channels.size(), 2u);
  EXPECT_TRUE(records.channels[0].measured);
  EXPECT_FALSE(records.channels[1].measured);
  EXPECT_EQ(records.channels[0].noise.kind, NoiseKind::White);
  EXPECT_NEAR(records.channels[0].noise.sigma, 0.01, 0.002);
  ASSERT_EQ(records.outliers.size(), 1u);
  EXPECT_EQ(records.outliers[0](50, 0), 1.0);
  EXPECT_EQ(records.outliers[0].sum(), 1.0);
}

TEST(Observed, RefusesWhatCannotBeUsed) {
  Dataset data = without_rate();
  data.trajectories[0].time[7] = 0.0;
  EXPECT_THROW(observed(data), DataError);
}

TEST(Observed, CountsRepeatedSamples) {
  Dataset data = without_rate();
  EXPECT_EQ(observed(data).channels[0].repeats, 0.0);
  EXPECT_FALSE(mostly_repeats(observed(data)));
  for (double& x : data.trajectories[0].states.reshaped()) x = std::round(4.0 * x) / 4.0;
  const BoundRecords coarse = observed(data);
  EXPECT_GT(coarse.channels[0].repeats, 0.5);
  EXPECT_TRUE(mostly_repeats(coarse));
  data.reconstructed = {true};
  EXPECT_FALSE(mostly_repeats(observed(data))) << "what was made from others was not rounded";
}

}  // namespace
}  // namespace lacuna
