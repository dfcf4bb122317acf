// SPDX-License-Identifier: MIT
#include "lacuna/core/numerics/sampled_signal.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "core/base/random.hpp"
#include "core/numerics/lagrange.hpp"
#include "core/numerics/periodogram.hpp"
#include "lacuna/core/base/error.hpp"

namespace lacuna {
namespace {

Vector stretched_grid(Index n, double end) {
  return end * Vector::LinSpaced(n, 0.0, 1.0).array().pow(1.3);
}

double largest(const Vector& values) { return values.cwiseAbs().maxCoeff(); }

TEST(InterpolateCubic, IsExactForCubics) {
  const Vector time = stretched_grid(12, 3.0);
  const Vector values = time.array().cube() - 2.0 * time.array().square() + 0.5;
  const Vector queries = Vector::LinSpaced(50, 0.0, time[11]);
  const Vector expected = queries.array().cube() - 2.0 * queries.array().square() + 0.5;
  EXPECT_LT(largest(interpolate_cubic(time, values, queries) - expected), 1e-12);
}

TEST(InterpolateCubic, GivesTheSamplesAtTheSamples) {
  const Vector time = stretched_grid(9, 2.0);
  const Vector values = Vector::Random(9);
  EXPECT_LT(largest(interpolate_cubic(time, values, time) - values), 1e-14);
}

TEST(InterpolateCubic, ShortRecordsUseWhatThereIs) {
  const Vector time = Vector::LinSpaced(2, 0.0, 1.0);
  const Vector values = Vector::LinSpaced(2, 3.0, 5.0);
  EXPECT_NEAR(interpolate_cubic(time, values, Vector::Constant(1, 0.25))[0], 3.5, 1e-15);
}

TEST(SampledSignal, ALinearSignalGoesInStraightLines) {
  SampledSignal signal(Vector{{0.0, 1.0, 3.0}}, Vector{{0.0, 2.0, 0.0}}, Interpolation::Linear);
  EXPECT_DOUBLE_EQ(signal(0.25), 0.5);
  EXPECT_DOUBLE_EQ(signal(2.5), 0.5);
  EXPECT_DOUBLE_EQ(signal(1.0), 2.0);
}

TEST(SampledSignal, AHeldSignalChangesAtItsSamples) {
  SampledSignal signal(Vector{{0.0, 1.0, 3.0}}, Vector{{5.0, 6.0, 7.0}}, Interpolation::Held);
  EXPECT_EQ(signal(0.999), 5.0);
  EXPECT_EQ(signal(1.0), 6.0);
  EXPECT_EQ(signal.in_interval(0, 1.0), 5.0) << "just before it changes";
  EXPECT_EQ(signal(3.0), 7.0);
}

TEST(SampledSignal, EndsHoldOutsideOfTheRecord) {
  for (const auto interpolation :
       {Interpolation::Held, Interpolation::Linear, Interpolation::Cubic, Interpolation::Quintic}) {
    SampledSignal signal(stretched_grid(6, 2.0), Vector::LinSpaced(6, 1.0, 2.0), interpolation);
    EXPECT_NEAR(signal(9.0), 2.0, 1e-14);
    EXPECT_NEAR(signal(-1.0), 1.0, 1e-14) << "and time may go back";
  }
}

TEST(SampledSignal, ThirdDifferenceIsTheCoefficientOfTheCube) {
  const Vector time = stretched_grid(9, 2.0);
  const Vector cube = 4.0 * time.array().cube() - time.array().square();
  EXPECT_NEAR(SampledSignal(time, cube).third_difference(5), 4.0, 1e-9);
  EXPECT_EQ(SampledSignal(time, cube, Interpolation::Linear).third_difference(5), 0.0);
  SampledSignal quintic(time, cube, Interpolation::Quintic);
  for (const Index interval : {0, 1, 5, 7})
    EXPECT_NEAR(quintic.third_difference(interval), 4.0, 1e-9) << interval;
}

TEST(SampledSignal, AQuinticSignalIsExactForFifthPowers) {
  const Vector time = stretched_grid(12, 3.0);
  const auto power = [](double t) { return std::pow(t, 5) - 2.0 * t * t + 0.5; };
  SampledSignal signal(time, time.unaryExpr(power), Interpolation::Quintic);
  const Vector queries = Vector::LinSpaced(50, 0.0, time[11]);
  const Vector found = queries.unaryExpr([&](double t) { return signal(t); });
  EXPECT_LT(largest(found - queries.unaryExpr(power)), 1e-11);
}

TEST(SampledSignal, AQuinticSignalHasOrderSix) {
  const auto error = [](Index n) {
    const Vector time = Vector::LinSpaced(n, 0.0, 3.0);
    SampledSignal signal(time, time.array().cos().matrix(), Interpolation::Quintic);
    double worst = 0.0;
    for (const double t : Vector::LinSpaced(997, 0.0, 3.0))
      worst = std::max(worst, std::abs(signal(t) - std::cos(t)));
    return worst;
  };
  EXPECT_NEAR(std::log2(error(21) / error(41)), 6.0, 0.4);
}

TEST(SampledSignal, WithFewSamplesAQuinticSignalUsesWhatThereIs) {
  for (const Index n : {1, 2, 3, 4, 5}) {
    const Vector time = Vector::LinSpaced(n, 0.0, 1.0);
    const Vector line = 2.0 * time.array() + 1.0;
    SampledSignal signal(time, line, Interpolation::Quintic);
    EXPECT_NEAR(signal(0.3), n == 1 ? 3.0 : 1.6, 1e-12) << n;
    EXPECT_NEAR(signal.third_difference(0), 0.0, 1e-12) << n;
  }
}

TEST(IntegrateCubic, IsExactForCubics) {
  const Vector time = stretched_grid(10, 2.0);
  const Vector values = 4.0 * time.array().cube() - 3.0 * time.array().square();
  const Vector expected = time.array().pow(4) - time.array().cube();
  EXPECT_LT(largest(integrate_cubic(time, values) - expected), 1e-13);
}

TEST(IntegrateCubic, HasOrderFour) {
  const auto error = [](Index n) {
    const Vector time = Vector::LinSpaced(n, 0.0, 3.0);
    return largest(integrate_cubic(time, time.array().cos().matrix()) -
                   time.array().sin().matrix());
  };
  EXPECT_NEAR(std::log2(error(41) / error(81)), 4.0, 0.4);
}

TEST(IntegrateCubic, StartsAtZero) {
  EXPECT_EQ(integrate_cubic(Vector::Ones(1), Vector::Ones(1)), Vector::Zero(1));
}

TEST(SampledSignal, TheLineOfAHeldSignalHasItsMeanAndMoment) {
  SampledSignal signal(Vector{{0.0, 1.0, 2.0, 3.0}}, Vector{{0.0, 1.0, 0.0, 5.0}},
                       Interpolation::Held);
  // 1 on the middle half of the span.
  const SpanCurve even = signal.held_line(0.5, 2.5);
  EXPECT_DOUBLE_EQ(even.mean, 0.5);
  EXPECT_NEAR(even.slope, 0.0, 1e-15);
  // Least squares on a fine grid for a jump in the first tenth.
  const SpanCurve line = signal.held_line(1.9, 2.9);
  EXPECT_NEAR(line.mean, 0.1, 1e-15);
  EXPECT_NEAR(line.slope, -0.1, 1e-15) << "no value below 0: -0.27 would be the best line";
  EXPECT_DOUBLE_EQ(signal.held_line(-2.0, -1.0).mean, 0.0) << "before the record";
  EXPECT_DOUBLE_EQ(signal.held_line(4.0, 5.0).mean, 5.0) << "behind it";
}

TEST(SampledSignal, TheMomentsOfAHeldSignalAreExact) {
  SampledSignal signal(Vector{{0.0, 1.0, 2.0, 3.0}}, Vector{{0.0, 1.0, -2.0, 5.0}},
                       Interpolation::Held);
  for (const double from : {0.3, 0.8, 1.0, -0.4}) {
    const double to = from + 1.7;
    const SpanCurve curve = signal.held_moments(from, to);
    double signals[3] = {}, curves[3] = {};
    const int n = 200000;
    for (int i = 0; i < n; ++i) {
      const double fraction = (i + 0.5) / n, x = 2.0 * fraction - 1.0;
      const double value = signal(from + fraction * (to - from));
      for (int k = 0; k < 3; ++k) {
        signals[k] += value * std::pow(x, k) / n;
        curves[k] += curve.at(fraction) * std::pow(x, k) / n;
      }
    }
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(curves[k], signals[k], 1e-4) << from << " " << k;
  }
}

const Vector kUneven{{0.0, 0.3, 0.5, 1.1, 1.3, 2.0, 2.2, 3.0, 3.1, 4.0}};

double polynomial(double t, Index degree) {
  double value = 0.0;
  for (Index i = 0; i <= degree; ++i)
    value += std::pow(t - 1.5, static_cast<double>(i)) / static_cast<double>(i + 1);
  return value;
}

double cube(double t) { return polynomial(t, 3); }

Matrix samples_of(Index degree) {
  Matrix values(kUneven.size(), 2);
  for (Index i = 0; i < kUneven.size(); ++i)
    values.row(i) << polynomial(kUneven[i], degree), kUneven[i];
  return values;
}

TEST(LagrangeWindow, IsTheOneOfTheSourceForRk4) {
  const LagrangeWindow window = LagrangeWindow::driving(4);
  EXPECT_EQ(window.points, 4);
  EXPECT_EQ(window.before, 2);  // t_{n-2} .. t_{n+1}
}

TEST(LagrangeInterpolant, IsExactForPolynomialsOfItsDegree) {
  for (const int points : {2, 4, 5, 8}) {
    const Matrix values = samples_of(points - 1);
    LagrangeInterpolant interpolant(kUneven, values, LagrangeWindow::driving(points));
    for (double t = 0.0; t <= 4.0; t += 0.07) {
      double out[2];
      interpolant.select(interpolant.interval_of(t));
      interpolant.evaluate(t, out);
      EXPECT_NEAR(out[0], polynomial(t, points - 1), 1e-11) << points << " points, t = " << t;
      EXPECT_NEAR(out[1], t, 1e-13);
    }
  }
}

TEST(LagrangeInterpolant, GoesThroughTheSamples) {
  const Matrix values = samples_of(9);
  LagrangeInterpolant interpolant(kUneven, values, LagrangeWindow::centred(4));
  ASSERT_GT(kUneven.size(), 0);
  for (Index i = 0; i < kUneven.size(); ++i) {
    double out[2];
    interpolant.select(interpolant.interval_of(kUneven[i]));
    interpolant.evaluate(kUneven[i], out);
    EXPECT_EQ(out[0], values(i, 0));
  }
}

TEST(LagrangeInterpolant, UsesTheSelectedSamples) {
  Matrix values = samples_of(3);
  values(7, 0) += 100.0;  // outside of the window t_1 .. t_4 of interval 3
  LagrangeInterpolant interpolant(kUneven, values, LagrangeWindow::driving(4));
  double out[2];
  interpolant.select(3);
  interpolant.evaluate(1.2, out);
  EXPECT_NEAR(out[0], cube(1.2), 1e-12);
  interpolant.select(6);
  interpolant.evaluate(2.5, out);
  EXPECT_GT(std::abs(out[0] - cube(2.5)), 1.0);
}

TEST(LagrangeInterpolant, FindsIntervals) {
  const Matrix values = samples_of(1);
  const LagrangeInterpolant interpolant(kUneven, values, LagrangeWindow::centred(2));
  EXPECT_EQ(interpolant.interval_of(-1.0), 0);
  EXPECT_EQ(interpolant.interval_of(0.4), 1);
  EXPECT_EQ(interpolant.interval_of(0.5), 2);
  EXPECT_EQ(interpolant.interval_of(9.0), 9);
}

TEST(Periodogram, IsTheSumThatDefinesIt) {
  Random random(3);
  for (const Index n : {12, 15}) {
    const Vector x = Vector::NullaryExpr(n, [&] { return random.normal(); });
    const Vector window = hann_window(n);
    const Vector power = periodogram(x, window);
    ASSERT_EQ(power.size(), n / 2 + 1);
    for (Index f = 0; f <= n / 2; ++f) {
      std::complex<double> sum = 0.0;
      for (Index i = 0; i < n; ++i)
        sum += window[i] * (x[i] - x.mean()) *
               std::polar(1.0, -2.0 * std::numbers::pi * static_cast<double>(f * i) /
                                   static_cast<double>(n));
      const bool alone = f == 0 || 2 * f == n;
      EXPECT_NEAR(power[f], (alone ? 1.0 : 2.0) * std::norm(sum), 1e-12) << f << " of " << n;
    }
  }
}

TEST(Periodogram, HannsWindowRisesToOneAndSumsToHalfItsLength) {
  const Vector window = hann_window(64);
  EXPECT_NEAR(window.maxCoeff(), 1.0, 1e-3);
  EXPECT_NEAR(window.sum(), 32.0, 1e-12);
  EXPECT_NEAR((window - window.reverse()).norm(), 0.0, 1e-12);
  EXPECT_LT(window[0], 1e-3);
}

}  // namespace
}  // namespace lacuna
