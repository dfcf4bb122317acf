// SPDX-License-Identifier: MIT
#include "dynamics/attractor/lyapunov.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "lacuna/core/base/error.hpp"
#include "lacuna/dynamics/integration/runge_kutta.hpp"
#include "lacuna/dynamics/test_systems/test_systems.hpp"

namespace lacuna {
namespace {

OdeModel linear_model(double a, double b) {
  const Variables names{{"x", "y"}, {}};
  return OdeModel(
      {{"x", ""}, {"y", ""}}, {},
      {{{Term::parse("x", names), a, {}, {}}, {Term::parse("y", names), 3.0, {}, {}}},
       {{Term::parse("y", names), b, {}, {}}}});
}

TEST(LyapunovSpectrum, OfALinearSystemAreItsEigenvalues) {
  const LyapunovSpectrum spectrum = lyapunov_spectrum(linear_model(-0.5, -2.0), Dopri8{},
                                                      Vector{{1.0, 1.0}}, {0.05, 50.0, 200.0});
  EXPECT_NEAR(spectrum.exponents[0], -0.5, 1e-9);
  EXPECT_NEAR(spectrum.exponents[1], -2.0, 1e-9);
  EXPECT_EQ(spectrum.dimension, 0.0);
}

TEST(LyapunovSpectrum, OfLorenzIsTheKnownOne) {
  const TestSystem& lorenz = test_system("lorenz");
  const LyapunovSpectrum spectrum =
      lyapunov_spectrum(lorenz.model, Rk4{}, lorenz.start, {0.01, 20.0, 600.0});
  EXPECT_NEAR(spectrum.exponents[0], 0.906, 0.02);
  EXPECT_NEAR(spectrum.exponents[1], 0.0, 0.01);
  EXPECT_NEAR(spectrum.exponents[2], -14.572, 0.03);
  EXPECT_NEAR(spectrum.exponents.sum(), -(10.0 + 1.0 + 8.0 / 3.0), 1e-3);
  EXPECT_NEAR(spectrum.dimension, 2.062, 0.002);
  EXPECT_LT(spectrum.half_width[0], 0.05);
}

TEST(KaplanYorkeDimension, FillsTheSumOfTheExponents) {
  EXPECT_DOUBLE_EQ(kaplan_yorke_dimension(Vector{{0.5, 0.0, -2.0}}), 2.25);
  EXPECT_DOUBLE_EQ(kaplan_yorke_dimension(Vector{{-0.1, -0.2}}), 0.0);
  EXPECT_DOUBLE_EQ(kaplan_yorke_dimension(Vector{{0.3, -0.1}}), 2.0);
}

}  // namespace
}  // namespace lacuna
