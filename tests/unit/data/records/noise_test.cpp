// SPDX-License-Identifier: MIT
#include "lacuna/data/records/noise.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "core/base/random.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/data/records/marks.hpp"

namespace lacuna {
namespace {

constexpr Index kNoisySamples = 4000;

/// Three smooth signals of about unit size: an oscillation, a sum of two, spikes.
Vector signals(double t) {
  return Vector{{std::sin(t), 0.7 * std::cos(2.3 * t) + 0.3 * std::sin(0.4 * t),
                 std::exp(6.0 * (std::cos(t) - 1.0))}};
}

/// @param noise standard deviation of white noise on every state.
/// @param jitter of the times, as a fraction of the step.
Trajectory record(double noise, double jitter, std::uint64_t seed) {
  Random random(seed);
  Trajectory trajectory;
  trajectory.time.resize(kNoisySamples);
  trajectory.states.resize(kNoisySamples, 3);
  for (Index i = 0; i < kNoisySamples; ++i) {
    trajectory.time[i] = 0.05 * (static_cast<double>(i) + jitter * random.uniform(-0.5, 0.5));
    trajectory.states.row(i) = signals(trajectory.time[i]).transpose();
    for (Index j = 0; j < 3; ++j) trajectory.states(i, j) += noise * random.normal();
  }
  return trajectory;
}

Dataset dataset(std::vector<Trajectory> trajectories) {
  Dataset data;
  data.states = {{"x", ""}, {"y", ""}, {"z", ""}};
  data.trajectories = std::move(trajectories);
  return data;
}

void expect_noise(const Dataset& data, double expected) {
  const Vector noise = estimate_noise(data);
  ASSERT_EQ(noise.size(), 3);
  for (Index j = 0; j < 3; ++j)
    EXPECT_NEAR(noise[j], expected, 0.1 * expected) << "state " << j;
}

TEST(EstimateNoise, FindsWhiteNoise) {
  for (const double sigma : {1e-4, 1e-3, 1e-2, 0.1})
    expect_noise(dataset({record(sigma, 0.0, 1)}), sigma);
}

/// Median over 0.6745 of the differences of some order, fully sorted.
double sigma_of_order(const Trajectory& trajectory, Index order) {
  Vector sizes = difference_sizes(trajectory, 0, order);
  std::sort(sizes.begin(), sizes.end());
  return sizes[sizes.size() / 2] / 0.674489750196082;
}

TEST(EstimateNoise, IsTheLeastOfTheMediansFromTheLevelOn) {
  // White noise is level from the first order on, and four more count.
  for (const Index samples : {100, 5000, 30000}) {
    Random random(7);
    Dataset data;
    data.states = {{"x", ""}};
    Trajectory& noise = data.trajectories.emplace_back();
    noise.time = Vector::LinSpaced(samples, 0.0, static_cast<double>(samples - 1));
    noise.states = Matrix::NullaryExpr(samples, 1, [&] { return 1e-3 * random.normal(); });
    noise.states.middleRows(samples / 2, samples / 4).setZero();  // many differences are 0
    double least = sigma_of_order(noise, 1);
    for (Index order = 2; order <= 5; ++order)
      least = std::min(least, sigma_of_order(noise, order));
    EXPECT_DOUBLE_EQ(estimate_noise(data)[0], least) << samples;
  }
}

TEST(EstimateNoise, FindsItOnTimesThatAreNotUniform) {
  for (const double sigma : {1e-3, 1e-2}) expect_noise(dataset({record(sigma, 0.6, 2)}), sigma);
}

TEST(EstimateNoise, JoinsRecords) {
  expect_noise(dataset({record(0.01, 0.0, 3), record(0.01, 0.0, 4)}), 0.01);
}

TEST(EstimateNoise, ScalesWithTheData) {
  Dataset data = dataset({record(0.01, 0.0, 5)});
  const Vector noise = estimate_noise(data);
  data.trajectories[0].states *= 1e-6;
  EXPECT_LT((estimate_noise(data) - 1e-6 * noise).norm(), 1e-15);
}

TEST(EstimateNoise, IsNotMisledByOutliers) {
  Dataset data = dataset({record(0.01, 0.0, 6)});
  for (Index i = 50; i < kNoisySamples; i += 400)
    data.trajectories[0].states.row(i).array() += 5.0;
  const Vector noise = estimate_noise(data);
  for (Index j = 0; j < 3; ++j) EXPECT_NEAR(noise[j], 0.01, 0.0015);
}

TEST(EstimateNoise, SeesNoneInCleanData) {
  EXPECT_LT(estimate_noise(dataset({record(0.0, 0.0, 7)})).maxCoeff(), 1e-6);
  EXPECT_LT(estimate_noise(dataset({record(0.0, 0.6, 7)})).maxCoeff(), 1e-6);
}

TEST(EstimateNoise, IsZeroForConstantsAndForTooFewSamples) {
  Dataset data = dataset({record(0.0, 0.0, 8)});
  data.trajectories[0].states.setConstant(3.0);
  EXPECT_EQ(estimate_noise(data), Vector::Zero(3));
  data.trajectories[0].time.conservativeResize(2);
  data.trajectories[0].states = Matrix::Random(2, 3);
  EXPECT_EQ(estimate_noise(data), Vector::Zero(3));
}

StateNoise noise_of_first_state(const Trajectory& trajectory) {
  return analyse_noise(dataset({trajectory}))[0];
}

TEST(AnalyseNoise, TellsWhiteNoise) {
  const StateNoise noise = noise_of_first_state(record(0.01, 0.0, 9));
  EXPECT_EQ(noise.kind, NoiseKind::White);
  EXPECT_EQ(to_string(noise.kind), "white");
  EXPECT_NEAR(noise.sigma, 0.01, 0.001);
  EXPECT_EQ(noise.outliers, 0.0);
  EXPECT_FALSE(noise.lattice);
}

TEST(AnalyseNoise, GivesABoundWhereThereIsNone) {
  const StateNoise noise = noise_of_first_state(record(0.0, 0.0, 9));
  EXPECT_LT(noise.sigma, 1e-8);
}

TEST(AnalyseNoise, TellsColouredNoise) {
  Trajectory trajectory = record(0.0, 0.0, 9);
  Random random(4);
  double state = 0.0;
  for (Index i = 0; i < kNoisySamples; ++i) {
    state = 0.8 * state + 0.6 * 0.05 * random.normal();
    trajectory.states(i, 0) += state;
  }
  const StateNoise noise = noise_of_first_state(trajectory);
  EXPECT_EQ(noise.kind, NoiseKind::Coloured);
  EXPECT_GT(noise.sigma, 0.02);
}

TEST(AnalyseNoise, TellsQuantisation) {
  Trajectory trajectory = record(0.0, 0.0, 9);
  for (Index i = 0; i < kNoisySamples; ++i)
    trajectory.states(i, 0) = 0.004 * std::round(trajectory.states(i, 0) / 0.004);
  const StateNoise noise = noise_of_first_state(trajectory);
  EXPECT_EQ(noise.kind, NoiseKind::Quantised);
  ASSERT_TRUE(noise.lattice);
  EXPECT_NEAR(*noise.lattice, 0.004, 1e-9);
  EXPECT_NEAR(noise.sigma, 0.004 / std::sqrt(12.0), 0.0006);
}

TEST(AnalyseNoise, CountsOutliers) {
  Trajectory trajectory = record(0.01, 0.0, 10);
  for (Index i = 100; i < kNoisySamples; i += 100) trajectory.states(i, 0) += 1.0;
  EXPECT_NEAR(noise_of_first_state(trajectory).outliers, 0.01, 0.001);
  const std::vector<Index> outliers = outlying_samples(trajectory, 0, 0.01);
  EXPECT_EQ(outliers.front(), 100);
  EXPECT_EQ(outliers.size(), 39U);
}

TEST(AnalyseNoise, DoesNotDependOnThreads) {
  const Dataset data = dataset({record(0.01, 0.3, 11), record(0.02, 0.0, 12)});
  const std::vector<StateNoise> one = analyse_noise(data);
  for (const int threads : {2, 3, 8}) {
    EXPECT_EQ(estimate_noise(data, threads), estimate_noise(data));
    const std::vector<StateNoise> more = analyse_noise(data, threads);
    ASSERT_EQ(more.size(), one.size());
    for (std::size_t k = 0; k < one.size(); ++k) {
      EXPECT_EQ(more[k].sigma, one[k].sigma);
      EXPECT_EQ(more[k].kind, one[k].kind);
      EXPECT_EQ(more[k].order, one[k].order);
      EXPECT_EQ(more[k].outliers, one[k].outliers);
    }
  }
}

TEST(AnalyseNoise, OfOneStateIsThatOfAll) {
  Dataset data = dataset({record(0.01, 0.3, 11), record(0.02, 0.0, 12)});
  set_mark(data.trajectories[0], 7, 0, Mark::Outlier);
  const std::vector<StateNoise> all = analyse_noise(data);
  const Vector white = estimate_noise(data);
  ASSERT_FALSE(all.empty());
  for (std::size_t k = 0; k < all.size(); ++k) {
    const StateNoise one = analyse_noise_of(data, static_cast<Index>(k));
    EXPECT_EQ(one.sigma, all[k].sigma);
    EXPECT_EQ(one.outliers, all[k].outliers);
    EXPECT_EQ(one.white, white[static_cast<Index>(k)]);
    EXPECT_EQ(all[k].white, white[static_cast<Index>(k)]);
  }
  EXPECT_THROW(analyse_noise_of(data, data.state_count()), ArgumentError);
}

TEST(DifferenceSizes, AreThoseOfWhiteNoiseOnAnyGrid) {
  Random random(4);
  for (const bool uniform : {true, false}) {
    Trajectory trajectory = record(0.0, 0.0, 1);
    for (Index i = 0; i < kNoisySamples; ++i) trajectory.states(i, 0) = 0.3 * random.normal();
    if (!uniform)
      for (Index i = 0; i + 1 < kNoisySamples; ++i)
        trajectory.time[i] +=
            0.5 * random.uniform() * (trajectory.time[i + 1] - trajectory.time[i]);
    for (const Index order : {1, 4}) {
      const Vector sizes = difference_sizes(trajectory, 0, order);
      ASSERT_EQ(sizes.size(), kNoisySamples - order);
      EXPECT_NEAR(sizes.norm() / std::sqrt(double(sizes.size())), 0.3, 0.015);
    }
  }
  Trajectory three = record(0.0, 0.0, 1);
  three.time.conservativeResize(3);
  three.states.conservativeResize(3, Eigen::NoChange);
  EXPECT_EQ(difference_sizes(three, 0, 5).size(), 0);
}

TEST(AnalyseNoise, OutliersOfGrowingNoiseAreMeasuredByIt) {
  Trajectory trajectory = record(0.0, 0.0, 10);
  Random random(5);
  Vector sigma(kNoisySamples);
  for (Index i = 0; i < kNoisySamples; ++i) {
    sigma[i] = i < kNoisySamples / 2 ? 0.001 : 0.1;
    trajectory.states(i, 0) = sigma[i] * random.normal();
  }
  trajectory.states(100, 0) += 0.1;
  trajectory.states(kNoisySamples - 100, 0) += 0.1;  // nothing special there
  EXPECT_EQ(outlying_samples(trajectory, 0, sigma), std::vector<Index>{100});
}

}  // namespace
}  // namespace lacuna
