// SPDX-License-Identifier: MIT
#include "dynamics/attractor/power_spectrum.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "lacuna/core/base/error.hpp"

namespace lacuna {
namespace {

Trajectory sine(double frequency, double amplitude, Index n = 4000) {
  Trajectory run;
  run.time = Vector::LinSpaced(n, 0.0, 0.01 * static_cast<double>(n - 1));
  run.states.resize(n, 1);
  run.states.col(0) =
      7.0 + amplitude * (2.0 * std::numbers::pi * frequency * run.time).array().sin();
  return run;
}

TEST(PowerSpectrum, OfASineHasItsFrequencyAndItsVariance) {
  const PowerSpectrum spectrum = power_spectrum(sine(5.0, 3.0), 8);
  Index peak = 0;
  spectrum.density.col(0).maxCoeff(&peak);
  EXPECT_NEAR(spectrum.frequency[peak], 5.0, 0.2);
  EXPECT_NEAR(spectrum.density.sum() * spectrum.frequency[1], 0.5 * 9.0, 0.05);
  EXPECT_NEAR(spectrum.frequency[spectrum.frequency.size() - 1], 50.0, 1e-9);
}

TEST(PowerSpectrumDistance, KnowsTheShapeNotTheSize) {
  EXPECT_NEAR(power_spectrum_distance(sine(5.0, 1.0), sine(5.0, 4.0)), 0.0, 1e-6);
  EXPECT_GT(power_spectrum_distance(sine(5.0, 1.0), sine(20.0, 1.0)), 0.95);
}

TEST(PowerSpectrumDistance, CutsToTheShorterRecord) {
  EXPECT_LT(power_spectrum_distance(sine(5.0, 1.0), sine(5.0, 1.0, 3600)), 0.05);
}

}  // namespace
}  // namespace lacuna
