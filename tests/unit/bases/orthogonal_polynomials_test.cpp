// SPDX-License-Identifier: MIT
#include "lacuna/bases/orthogonal_polynomials.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "unit/bases/values.hpp"

namespace lacuna {
namespace {

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

}  // namespace
}  // namespace lacuna
