// SPDX-License-Identifier: MIT
#include "lacuna/estimation/variance_fit.hpp"

#include <gtest/gtest.h>

#include "support/driven_oscillator.hpp"

namespace lacuna {
namespace {

struct Case {
  Dataset data;
  std::vector<LinearisedRecord> records;
  std::vector<Matrix> measured, omitted;

  LinearisedData view() const { return {records, measured, omitted}; }
};

Case make_case(const support::Hidden& hidden) {
  Case made{support::hidden_record(hidden, 0.01), {}, {}, {}};
  const Trajectory& record = made.data.trajectories.front();
  made.records.push_back(
      linearise(support::oscillator(), record, record.states, Vector::Constant(2, 1e-4)));
  made.measured.push_back(record.states);
  return made;
}

NoiseModel noise_of(double white, double disturbance) {
  NoiseModel noise;
  noise.measurement = {white, white};
  noise.coloured.resize(2);
  noise.disturbance = Vector{{0.0, disturbance}};
  return noise;
}

double deviance_of(const Case& made, const NoiseModel& noise) {
  return filter_deviance(made.records[0], made.measured[0], Matrix(), noise);
}

TEST(VarianceFit, FindsTheNoiseFromFarAway) {
  const Case made = make_case(support::nothing);
  for (const double start : {0.001, 0.1}) {
    const SmoothedNoise found =
        VarianceFit(Vector::Constant(2, 1e-9)).run(made.view(), noise_of(start, 0.01), 40);
    EXPECT_NEAR(*found.noise.measurement[0], 0.01, 0.001);
    EXPECT_NEAR(*found.noise.measurement[1], 0.02, 0.002);
    EXPECT_NEAR(found.deviance, deviance_of(made, found.noise), 1e-6);
  }
}

TEST(VarianceFit, NoNeighbourIsMoreLikely) {
  const Case made = make_case([](double t, double, double) { return std::sin(3.0 * t); });
  const SmoothedNoise found =
      VarianceFit(Vector::Constant(2, 1e-9)).run(made.view(), noise_of(0.02, 0.1), 40);
  for (const double factor : {0.95, 1.05}) {
    NoiseModel other = found.noise;
    other.disturbance[1] *= factor;
    EXPECT_GT(deviance_of(made, other), found.deviance - 0.05);
    other = found.noise;
    *other.measurement[0] *= factor;
    EXPECT_GT(deviance_of(made, other), found.deviance - 0.05);
  }
}

TEST(VarianceFit, GradientIsThatOfTheDeviance) {
  const Case made = make_case(support::nothing);
  NoiseModel noise = noise_of(0.015, 0.05);
  noise.coloured[0] = ColouredNoise{0.01, 0.3};
  const SmoothedNoise here = VarianceFit(Vector::Constant(2, 1e-9)).run(made.view(), noise, 0);
  const double reach = 1e-4;
  NoiseModel above = noise, below = noise;
  above.disturbance[1] *= std::exp(reach);
  below.disturbance[1] *= std::exp(-reach);
  EXPECT_NEAR((deviance_of(made, above) - deviance_of(made, below)) / (2.0 * reach),
              here.gradient[0], 0.01 * std::abs(here.gradient[0]));
  above = below = noise;
  above.coloured[0]->deviation *= std::exp(reach);
  below.coloured[0]->deviation *= std::exp(-reach);
  EXPECT_NEAR((deviance_of(made, above) - deviance_of(made, below)) / (2.0 * reach),
              here.gradient[2], 0.05 * std::abs(here.gradient[2]));
}

TEST(VarianceFit, WhatIsKnownOfTheCurvatureDoesNotMoveTheAnswer) {
  const Case made = make_case([](double t, double, double) { return std::sin(3.0 * t); });
  const Vector floor = Vector::Constant(2, 1e-9);
  VarianceFit first(floor);
  const SmoothedNoise found = first.run(made.view(), noise_of(0.02, 0.1), 40);
  NoiseCurvature much_too_steep = first.curvature();
  much_too_steep.inverse *= 1e-6;
  for (const NoiseCurvature& known : {first.curvature(), much_too_steep})
    EXPECT_NEAR(VarianceFit(floor, known).run(made.view(), noise_of(0.05, 1.0), 40).deviance,
                found.deviance, 0.05);
}

TEST(VarianceFit, WhiteNoiseStaysAboveItsFloor) {
  const Case made = make_case(support::nothing);
  const SmoothedNoise found =
      VarianceFit(Vector::Constant(2, 0.05)).run(made.view(), noise_of(0.06, 0.01), 20);
  EXPECT_GE(*found.noise.measurement[0], 0.05);
}

}  // namespace
}  // namespace lacuna
