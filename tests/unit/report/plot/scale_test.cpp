// SPDX-License-Identifier: MIT
#include "report/plot/scale.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>

namespace lacuna {
namespace {

using ::testing::ElementsAre;

std::vector<std::string> labels(const Scale& scale, int count) {
  std::vector<std::string> all;
  for (const Tick& tick : ticks_of(scale, count)) all.push_back(tick.label);
  return all;
}

TEST(Scale, HoldsAllFiniteValues) {
  const Vector a = Eigen::Vector3d(1.0, NAN, 3.0), b = Eigen::Vector2d(-1.0, INFINITY);
  const Scale scale = scale_of({&a, &b});
  EXPECT_DOUBLE_EQ(scale.low, -1.0 - 0.16);
  EXPECT_DOUBLE_EQ(scale.high, 3.0 + 0.16);
  EXPECT_DOUBLE_EQ(scale.part(1.0), 0.5);
}

TEST(Ticks, AreRoundAndInside) {
  EXPECT_THAT(labels({-0.3, 1.1, false}, 6), ElementsAre("0", "0.5", "1"));
  EXPECT_THAT(labels({0.0, 1040.0, false}, 5), ElementsAre("0", "500", "1000"));
  EXPECT_THAT(labels({1e-9, 3e-9, false}, 2), ElementsAre("1e-09", "2e-09", "3e-09"));
  EXPECT_THAT(labels({0.5, 2000.0, true}, 5), ElementsAre("1", "10", "100", "1e+03"));
}

TEST(Ticks, TellNeighboursOfALargeOffsetApart) {
  const auto all = labels({1e6, 1e6 + 0.4, false}, 4);
  EXPECT_EQ(std::set<std::string>(all.begin(), all.end()).size(), all.size());
}

TEST(Ticks, OfLogarithmsAreEveryFewDecades) {
  const std::vector<Tick> ticks = ticks_of({1e-3, 1e9, true}, 5);
  ASSERT_EQ(ticks.size(), 5u);
  for (std::size_t i = 0; i < 5; ++i)
    EXPECT_NEAR(std::log10(ticks[i].value), 3.0 * static_cast<double>(i) - 3.0, 1e-12);
}

TEST(ShownSamples, KeepTheExtremesOfEveryColumn) {
  const Index n = 100000, columns = 50;
  const Vector x = Vector::LinSpaced(n, 0.0, 1.0);
  Vector y = (200.0 * x.array()).sin();
  y[31234] = 9.0;
  y[31240] = -9.0;
  const auto shown = shown_samples(x, y, {0.0, 1.0, false}, columns);
  EXPECT_LE(shown.size(), 4u * (columns + 1));
  EXPECT_TRUE(std::is_sorted(shown.begin(), shown.end()));
  for (Index c = 0; c < columns; ++c) {
    const Index begin = c * n / columns, end = (c + 1) * n / columns;
    double least = 1e9, all_least = y.segment(begin, end - begin).minCoeff();
    double most = -1e9, all_most = y.segment(begin, end - begin).maxCoeff();
    for (const Index i : shown)
      if (i >= begin - 1 && i <= end) {
        least = std::min(least, y[i]);
        most = std::max(most, y[i]);
      }
    EXPECT_LE(least, all_least) << c;
    EXPECT_GE(most, all_most) << c;
  }
}

TEST(ShownSamples, KeepAGap) {
  const Vector x = Vector::LinSpaced(1000, 0.0, 1.0);
  Vector y = Vector::Ones(1000);
  y.segment(400, 100).setConstant(std::numeric_limits<double>::quiet_NaN());
  int gaps = 0;
  for (const Index i : shown_samples(x, y, {0.0, 1.0, false}, 20)) gaps += std::isnan(y[i]);
  EXPECT_EQ(gaps, 1);
}

TEST(ShownSamples, OfAnOrbitAreSpreadOverIt) {
  const Vector t = Vector::LinSpaced(10000, 0.0, 100.0);
  const auto shown = shown_samples(t.array().cos(), t.array().sin(), {-1.0, 1.0, false}, 100);
  EXPECT_LE(shown.size(), 402u);
  EXPECT_EQ(shown.front(), 0);
  EXPECT_EQ(shown.back(), 9999);
}

}  // namespace
}  // namespace lacuna
