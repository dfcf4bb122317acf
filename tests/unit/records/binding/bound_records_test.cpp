// SPDX-License-Identifier: MIT
#include "lacuna/records/binding/bound_records.hpp"

#include <gtest/gtest.h>

#include "core/base/random.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/data/derivatives/finite_differences.hpp"
#include "lacuna/data/records/marks.hpp"
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
  const BoundRecords records =
      observed(model_view(support::harmonic_model(), data, FiniteDifferences{}));
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

TEST(BoundRecords, CarryTheNoiseOfTheirSamples) {
  Dataset data = without_rate();
  const BoundRecords records = as_measured(data);
  EXPECT_EQ(visible_noise(records), estimate_noise(data));
  BoundRecords doubled = records;
  doubled.data.trajectories[0].states *= 2.0;
  EXPECT_EQ(visible_noise(doubled), visible_noise(records)) << "nobody looked again";
  EXPECT_EQ(visible_noise(with_noise_anew(doubled)), 2.0 * visible_noise(records));
  data.trajectories[0].time[7] = 0.0;
  EXPECT_THROW(as_measured(data), DataError);
}

TEST(BoundRecords, OnALatticeShowTheNoiseOfRounding) {
  Dataset data = without_rate();
  for (double& x : data.trajectories[0].states.reshaped()) x = std::round(4.0 * x) / 4.0;
  const BoundRecords coarse = as_measured(data);
  ASSERT_EQ(coarse.channels[0].noise.kind, NoiseKind::Quantised);
  EXPECT_EQ(visible_noise(coarse)[0], coarse.channels[0].noise.sigma);
}

TEST(ObservedAlike, HasTheNoiseWithoutTheOutliersThatItMarks) {
  Dataset data = without_rate();
  const BoundRecords first = observed(data);
  EXPECT_EQ(visible_noise(observed_alike(data, first)), visible_noise(first));
  data.trajectories[0].states(50, 0) += 1.0;
  const BoundRecords other = observed_alike(data, first);
  EXPECT_EQ(mark_of(other.data.trajectories[0].marks, 50, 0), Mark::Outlier);
  EXPECT_EQ(visible_noise(other), estimate_noise(other.data));
}

TEST(ObservedAlike, AnEndThatOtherRecordsGoBeyondIsNoneThere) {
  Dataset data = without_rate();
  auto x = data.trajectories[0].states.col(0).array();
  const double end = 0.5 * x.maxCoeff();
  Dataset clipped = data;
  clipped.trajectories[0].states.col(0) = x.min(end).matrix();
  const BoundRecords first = observed(clipped);
  ASSERT_EQ(first.channels[0].limits.high, end);
  EXPECT_GT(observed_alike(clipped, first).channels[0].at_top, 0.0);
  EXPECT_EQ(observed_alike(data, first).channels[0].at_top, 0.0);
  EXPECT_EQ(observed_alike(data, first).data.trajectories[0].states, data.trajectories[0].states);
  Dataset touching = data;  // where its largest samples are, which alone show no end
  touching.trajectories[0].states.col(0) = (0.5 * x).matrix();
  EXPECT_EQ(observed(touching).channels[0].at_top, 0.0);
  EXPECT_GT(observed_alike(touching, first).channels[0].at_top, 0.0);
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
