// SPDX-License-Identifier: MIT
#include "hidden/support/disturbance.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace lacuna::hidden {
namespace {

constexpr Index kSamples = 20000;

Dataset clean_record() {
  Dataset record;
  record.states = {{"x", ""}};
  record.inputs = {{"u", ""}};
  const Vector t = Vector::LinSpaced(kSamples, 0.0, 200.0);
  record.trajectories = {{"", t, t.array().sin() * 3.0, t.array().cos(), Matrix()}};
  return record;
}

double deviation(const Vector& x) { return std::sqrt((x.array() - x.mean()).square().mean()); }

Vector error_of(NoiseKind kind, double level) {
  const Dataset clean = clean_record();
  return disturbed(clean, kind, level, 5).trajectories[0].states - clean.trajectories[0].states;
}

double autocorrelation(const Vector& e, Index lag) {
  return e.head(kSamples - lag).dot(e.tail(kSamples - lag)) / e.squaredNorm();
}

class Disturbance : public testing::TestWithParam<NoiseKind> {};

TEST_P(Disturbance, HasItsLevel) {
  const double expected = 0.02 * deviation(clean_record().trajectories[0].states.col(0));
  const double slack = GetParam() == NoiseKind::Outliers ? 0.4 : 0.1;
  EXPECT_NEAR(std::sqrt(error_of(GetParam(), 0.02).array().square().mean()), expected,
              slack * expected);
}

TEST_P(Disturbance, LevelZeroLeavesTheRecord) {
  EXPECT_EQ(error_of(GetParam(), 0.0).norm(), 0.0);
}

TEST_P(Disturbance, InputsStayExact) {
  const Dataset clean = clean_record();
  EXPECT_EQ(disturbed(clean, GetParam(), 0.1, 5).trajectories[0].inputs,
            clean.trajectories[0].inputs);
}

INSTANTIATE_TEST_SUITE_P(All, Disturbance,
                         testing::Values(NoiseKind::White, NoiseKind::Coloured,
                                         NoiseKind::Outliers, NoiseKind::Quantised,
                                         NoiseKind::Drifting),
                         [](const auto& kind) { return to_string(kind.param); });

TEST(DisturbanceKind, ColouredIsCorrelatedAndWhiteIsNot) {
  EXPECT_NEAR(autocorrelation(error_of(NoiseKind::Coloured, 0.02), 5), std::exp(-1.0), 0.05);
  EXPECT_NEAR(autocorrelation(error_of(NoiseKind::White, 0.02), 5), 0.0, 0.03);
}

TEST(DisturbanceKind, DriftingLastsOverTheRecord) {
  EXPECT_GT(autocorrelation(error_of(NoiseKind::Drifting, 0.02), 500), 0.3);
}

TEST(DisturbanceKind, SmoothedNoiseIsSharedWithinTheWindow) {
  const double sigma = 0.02 * deviation(clean_record().trajectories[0].states.col(0));
  const Vector mean = error_of(NoiseKind::Averaged, 0.02);
  EXPECT_NEAR(deviation(mean), sigma / 3.0, 0.01 * sigma);
  EXPECT_NEAR(autocorrelation(mean, 3), 6.0 / 9.0, 0.04);
  EXPECT_NEAR(autocorrelation(mean, 9), 0.0, 0.04);
  // The weight of the sample itself: 167 of 1105 (Savitzky and Golay, table I).
  EXPECT_NEAR(deviation(error_of(NoiseKind::Parabolas, 0.02)),
              std::sqrt(167.0 / 1105.0) * sigma, 0.01 * sigma);
}

TEST(DisturbanceKind, OutliersStandOut) {
  const Vector e = error_of(NoiseKind::Outliers, 0.02);
  const double sigma = 0.02 * deviation(clean_record().trajectories[0].states.col(0));
  const auto spikes = (e.array().abs() > 4.5 * sigma).count();
  EXPECT_NEAR(static_cast<double>(spikes) / kSamples, 0.01, 0.003);
}

TEST(DisturbanceKind, QuantisedLiesOnAGrid) {
  const Dataset clean = clean_record();
  const Vector x = disturbed(clean, NoiseKind::Quantised, 0.05, 5).trajectories[0].states;
  const double grid = 0.05 * std::sqrt(12.0) * deviation(clean.trajectories[0].states.col(0));
  EXPECT_LT(((x / grid).array() - (x / grid).array().round()).abs().maxCoeff(), 1e-9);
}

}  // namespace
}  // namespace lacuna::hidden
