// SPDX-License-Identifier: MIT
#include "hidden/support/signal.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace lacuna::hidden {
namespace {

struct Moments {
  double mean, deviation;
};

Moments moments(const Signal& signal, double end, int n) {
  double sum = 0.0, squares = 0.0;
  for (int i = 0; i < n; ++i) {
    const double value = signal(end * i / n);
    sum += value;
    squares += value * value;
  }
  const double mean = sum / n;
  return {mean, std::sqrt(squares / n - mean * mean)};
}

TEST(Signal, MultisineHasItsMeanAndSize) {
  const Signal signal({.mean = 2.0, .size = 0.5, .low = 0.1, .high = 1.0}, 0.0, 1000.0, 3);
  const auto [mean, deviation] = moments(signal, 1000.0, 20000);
  EXPECT_NEAR(mean, 2.0, 0.01);
  EXPECT_NEAR(deviation, 0.5, 0.02);
}

TEST(Signal, StepsHaveTheirMeanAndSize) {
  const SignalSpec spec{
      .shape = SignalSpec::Shape::Steps, .mean = 1.0, .size = 0.3, .low = 0.2, .high = 1.0};
  const auto [mean, deviation] = moments(Signal(spec, 0.0, 20000.0, 3), 20000.0, 100000);
  EXPECT_NEAR(mean, 1.0, 0.02);
  EXPECT_NEAR(deviation, 0.3, 0.03);
}

TEST(Signal, StepsAreSmooth) {
  const SignalSpec spec{.shape = SignalSpec::Shape::Steps, .low = 0.2, .high = 1.0};
  const Signal signal(spec, 0.0, 100.0, 3);
  // The steepest slope of the edge polynomial is 15/8 height per rise of a quarter time unit.
  for (int i = 0; i < 100000; ++i)
    EXPECT_LE(std::abs(signal(0.001 * (i + 1)) - signal(0.001 * i)), 0.001 * 7.5 * 3.47);
}

TEST(Signal, SeedDecides) {
  const SignalSpec spec;
  EXPECT_EQ(Signal(spec, 0.0, 10.0, 1)(3.3), Signal(spec, 0.0, 10.0, 1)(3.3));
  EXPECT_NE(Signal(spec, 0.0, 10.0, 1)(3.3), Signal(spec, 0.0, 10.0, 2)(3.3));
}

}  // namespace
}  // namespace lacuna::hidden
