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

INSTANTIATE_TEST_SUITE_P(All, Disturbance,
                         testing::Values(NoiseKind::White, NoiseKind::Coloured,
                                         NoiseKind::Outliers, NoiseKind::Quantised,
                                         NoiseKind::Drifting),
                         [](const auto& kind) { return to_string(kind.param); });

TEST(DisturbanceKind, ColouredIsCorrelatedAndWhiteIsNot) {
  EXPECT_NEAR(autocorrelation(error_of(NoiseKind::Coloured, 0.02), 5), std::exp(-1.0), 0.05);
  EXPECT_NEAR(autocorrelation(error_of(NoiseKind::White, 0.02), 5), 0.0, 0.03);
}

}  // namespace
}  // namespace lacuna::hidden
