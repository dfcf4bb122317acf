// SPDX-License-Identifier: MIT
// Bases of functions, each by its values.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lacuna/bases/orthogonal_polynomials.hpp"
#include "lacuna/bases/piecewise_linear.hpp"
#include "lacuna/bases/radial.hpp"
#include "lacuna/bases/real_powers.hpp"

namespace lacuna {
namespace {

/// The values of all terms of a library of one variable at x.
Vector values_at(const TermLibrary& library, double x) {
  const Program program = library.compile();
  Vector slots = Vector::Zero(program.slots()), values(program.outputs());
  slots[0] = x;
  Program::Workspace workspace;
  program.evaluate(slots.data(), values.data(), workspace);
  return values;
}

Vector of_x(const Basis& basis, double x) { return values_at(basis.library({{"x"}, {}}), x); }

TEST(OrthogonalPolynomials, HaveTheTabulatedValues) {
  // scipy.special: eval_chebyt, eval_legendre, eval_hermitenorm (k, 0.3) for k = 0..4.
  Vector chebyshev(5), legendre(5), hermite(5);
  chebyshev << 1.0, 0.3, -0.82, -0.792, 0.3448;
  legendre << 1.0, 0.3, -0.365, -0.3825, 0.0729375;
  hermite << 1.0, 0.3, -0.91, -0.873, 2.4681;
  EXPECT_LT((of_x(Chebyshev{{.max_degree = 4}}, 0.3) - chebyshev).norm(), 1e-12);
  EXPECT_LT((of_x(Legendre{{.max_degree = 4}}, 0.3) - legendre).norm(), 1e-12);
  EXPECT_LT((of_x(Hermite{{.max_degree = 4}}, 0.3) - hermite).norm(), 1e-12);
}

TEST(OrthogonalPolynomials, AreThoseOfTheScaledVariable) {
  const Vector scaled = of_x(Chebyshev{{.max_degree = 5, .low = 10.0, .high = 30.0}}, 23.0);
  EXPECT_LT((scaled - of_x(Chebyshev{{.max_degree = 5}}, 0.3)).norm(), 1e-12);
}

TEST(OrthogonalPolynomials, ProductsGoUpToTheDegree) {
  const TermLibrary library = Legendre{{.max_degree = 3}}.library({{"x", "y"}, {"u"}});
  EXPECT_EQ(library.size(), 20);  // binomial(3 + 3, 3)
  EXPECT_EQ((Legendre{{.max_degree = 3, .with_inputs = false}}.library({{"x", "y"}, {"u"}}).size()),
            10);
  const std::vector<std::string> names = library.names();
  EXPECT_THAT(names, ::testing::Contains("x*y*u"));
}

TEST(OrthogonalPolynomials, EmptyRangesAreRefused) {
  EXPECT_THROW((Hermite{{.low = 1.0, .high = 1.0}}.library({{"x"}, {}})), ConfigError);
}

TEST(PiecewiseLinear, SpansFunctionsThatAreLinearBetweenTheBends) {
  const TermLibrary library =
      PiecewiseLinear{{.count = 2, .low = -1.0, .high = 1.0}}.library({{"x"}, {}});
  EXPECT_THAT(library.names(), ::testing::ElementsAre("1", "x", "max(x+1,0)", "max(x-1,0)"));
  EXPECT_EQ(values_at(library, -2.0)[2], 0.0);
  EXPECT_EQ(values_at(library, 0.5)[2], 1.5);
}

TEST(RadialFunctions, AreGaussiansAroundTheirCentres) {
  const RadialFunctions basis{{.count = 3, .low = 0.0, .high = 4.0}};
  const TermLibrary library = basis.library({{"x"}, {}});
  ASSERT_EQ(library.size(), 5);
  for (int i = 0; i < 3; ++i) {
    const double distance = 1.3 - 2.0 * i;
    EXPECT_NEAR(values_at(library, 1.3)[2 + i],
                std::exp(-0.5 * distance * distance / 4.0), 1e-12);
  }
}

TEST(RealPowers, HaveASignOrAreForPositiveValues) {
  const TermLibrary library = RealPowers{{.exponents = {"0.5", "-0.25"}}}.library({{"x"}, {}});
  ASSERT_EQ(library.size(), 4);
  EXPECT_DOUBLE_EQ(values_at(library, -4.0)[2], -2.0);
  EXPECT_DOUBLE_EQ(values_at(library, 16.0)[3], 0.5);
  const TermLibrary plain =
      RealPowers{{.exponents = {"1.5"}, .signed_powers = false}}.library({{"x"}, {}});
  EXPECT_DOUBLE_EQ(values_at(plain, 4.0)[2], 8.0);
  EXPECT_THROW((RealPowers{{.exponents = {"1"}}}.library({{"x"}, {}})), ConfigError);
  EXPECT_THROW((RealPowers{{.exponents = {"two"}}}.library({{"x"}, {}})), ConfigError);
}

}  // namespace
}  // namespace lacuna
