// SPDX-License-Identifier: MIT
// Bases, their names and products.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "bases/compositions.hpp"
#include "bases/expressions.hpp"
#include "bases/fourier.hpp"
#include "bases/monomials.hpp"
#include "bases/orthogonal_polynomials.hpp"
#include "bases/piecewise_linear.hpp"
#include "bases/radial.hpp"
#include "bases/real_powers.hpp"

namespace lacuna {
namespace {

using testing::ElementsAre;

const Variables kTwo{{"x", "y"}, {}};

Stage<Basis> written(std::vector<std::string> terms) {
  return Expressions{{.terms = std::move(terms)}};
}

TEST(SumOfBases, HasTheTermsOfBothOnce) {
  const SumOfBases sum{{.first = written({"1", "x", "sin(x)"}), .second = written({"y", "x"})}};
  EXPECT_THAT(sum.library(kTwo).names(), ElementsAre("1", "x", "sin(x)", "y"));
}

TEST(SumOfBases, MayHaveASumInside) {
  const SumOfBases inner{{.first = written({"y"}), .second = written({"x*y"})}};
  const SumOfBases sum{{.first = written({"x"}), .second = inner}};
  EXPECT_THAT(sum.library(kTwo).names(), ElementsAre("x", "y", "x*y"));
}

TEST(ProductOfBases, StandsInOrderOfDegreeWithMonomialsInFront) {
  const ProductOfBases product{
      {.first = written({"1", "sin(x)", "x"}), .second = written({"1", "y", "cos(x)"})}};
  EXPECT_THAT(product.library(kTwo).names(),
              ElementsAre("1", "y", "cos(x)", "sin(x)", "x", "y*sin(x)", "cos(x)*sin(x)", "x*y",
                          "x*cos(x)"));
}

TEST(ProductOfBases, OfABasisWithItselfHasEachProductOnce) {
  const Stage<Basis> waves = written({"sin(x)", "cos(x)", "y"});
  EXPECT_THAT((ProductOfBases{{.first = waves, .second = waves}}.library(kTwo).names()),
              ElementsAre("sin(x)*sin(x)", "cos(x)*sin(x)", "y*sin(x)", "cos(x)*cos(x)",
                          "y*cos(x)", "y^2"));
}

TEST(ProductOfBases, DegreesAreBounded) {
  const Stage<Basis> cubes = Monomials{{.max_degree = 3}};
  const ProductOfBases product{{.first = cubes, .second = cubes, .max_degree = 2}};
  EXPECT_EQ(product.library(kTwo).names(),
            (Monomials{{.max_degree = 2}}.library(kTwo).names()));
}

TEST(ProductOfBases, TooManyAreRefused) {
  const Stage<Basis> many = Monomials{{.max_degree = 20}};
  const Variables four{{"a", "b", "c", "d"}, {}};
  EXPECT_THROW((ProductOfBases{{.first = many, .second = many}}.library(four)), ConfigError);
}

// Bases of functions, each by its values.
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
  Vector of_chebyshev(5), of_legendre(5), of_hermite(5);
  of_chebyshev << 1.0, 0.3, -0.82, -0.792, 0.3448;
  of_legendre << 1.0, 0.3, -0.365, -0.3825, 0.0729375;
  of_hermite << 1.0, 0.3, -0.91, -0.873, 2.4681;
  EXPECT_LT((of_x(chebyshev({.max_degree = 4}), 0.3) - of_chebyshev).norm(), 1e-12);
  EXPECT_LT((of_x(legendre({.max_degree = 4}), 0.3) - of_legendre).norm(), 1e-12);
  EXPECT_LT((of_x(hermite({.max_degree = 4}), 0.3) - of_hermite).norm(), 1e-12);
}

TEST(OrthogonalPolynomials, AreThoseOfTheScaledVariable) {
  const Vector scaled = of_x(chebyshev({.max_degree = 5, .low = 10.0, .high = 30.0}), 23.0);
  EXPECT_LT((scaled - of_x(chebyshev({.max_degree = 5}), 0.3)).norm(), 1e-12);
}

TEST(OrthogonalPolynomials, ProductsGoUpToTheDegree) {
  const TermLibrary library = legendre({.max_degree = 3})->library({{"x", "y"}, {"u"}});
  EXPECT_EQ(library.size(), 20);  // binomial(3 + 3, 3)
  EXPECT_EQ(
      (legendre({.max_degree = 3, .with_inputs = false})->library({{"x", "y"}, {"u"}}).size()),
      10);
  const std::vector<std::string> names = library.names();
  EXPECT_THAT(names, ::testing::Contains("x*y*u"));
}

TEST(OrthogonalPolynomials, EmptyRangesAreRefused) {
  EXPECT_THROW((hermite({.low = 1.0, .high = 1.0})->library({{"x"}, {}})), ConfigError);
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
    EXPECT_NEAR(values_at(library, 1.3)[2 + i], std::exp(-0.5 * distance * distance / 4.0),
                1e-12);
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

const Variables kPendulum{{"q", "v"}, {"F"}};

TEST(Expressions, AreTheTermsInTheOrderGiven) {
  const Expressions basis{{.terms = {"sign(v)", "1", "F", "v"}}};
  EXPECT_THAT(basis.library(kPendulum).names(), testing::ElementsAre("sign(v)", "1", "F", "v"));
}

TEST(Expressions, RepeatedTermsCountOnce) {
  const Expressions basis{{.terms = {"q*v", "v*q", "v*v", "v^2"}}};
  EXPECT_THAT(basis.library(kPendulum).names(), testing::ElementsAre("q*v", "v^2"));
}

TEST(Expressions, UnreadableTermNamesTheEntry) {
  const Expressions basis{{.terms = {"v", "sin(v"}}};
  try {
    basis.library(kPendulum);
    FAIL();
  } catch (const ModelError& error) {
    EXPECT_EQ(error.where().rfind("expressions.terms[1], term 'sin(v'", 0), 0u) << error.what();
  }
}

TEST(Expressions, NoTermsAreRefused) {
  EXPECT_THROW(Expressions{}.library(kPendulum), ConfigError);
}

const Variables kDriven{{"x"}, {"u"}};

TEST(Fourier, ListsHarmonicsOfEachVariable) {
  EXPECT_THAT(Fourier{}.library(kDriven).names(),
              ElementsAre("1", "x", "sin(x)", "cos(x)", "sin(2*x)", "cos(2*x)"));
}

TEST(Fourier, WaveNumberScalesTheArgument) {
  const Fourier basis{{.harmonics = 2, .wave_number = 0.5, .with_linear = false}};
  EXPECT_THAT(basis.library(kDriven).names(),
              ElementsAre("sin(0.5*x)", "cos(0.5*x)", "sin(x)", "cos(x)"));
}

TEST(Fourier, InputsOnRequest) {
  const Fourier basis{{.harmonics = 1, .with_inputs = true}};
  EXPECT_THAT(basis.library(kDriven).names(),
              ElementsAre("1", "x", "u", "sin(x)", "cos(x)", "sin(u)", "cos(u)"));
}

TEST(Fourier, ZeroWaveNumberIsRefused) {
  EXPECT_THROW(Fourier{{.wave_number = 0.0}}.library(kDriven), ConfigError);
}

const Variables kXyz{{"x", "y", "z"}, {}};
const Variables kDrivenPlane{{"x"}, {"u"}};

std::vector<std::string> names(const MonomialsOptions& options, const Variables& variables) {
  return Monomials{options}.library(variables).names();
}

TEST(Monomials, AreInDegreeLexicographicOrder) {
  EXPECT_THAT(names({.max_degree = 2}, kXyz),
              ElementsAre("1", "x", "y", "z", "x^2", "x*y", "x*z", "y^2", "y*z", "z^2"));
}

TEST(Monomials, LowestDegreeAboveZeroLeavesLowerTermsOut) {
  EXPECT_THAT(names({.min_degree = 2, .max_degree = 2}, kXyz),
              ElementsAre("x^2", "x*y", "x*z", "y^2", "y*z", "z^2"));
}

TEST(Monomials, NegativeDegreesAllowNegativePowers) {
  const Variables two{{"x", "y"}, {}};
  EXPECT_THAT(names({.min_degree = -1, .max_degree = 1}, two),
              ElementsAre("x^-1", "y^-1", "1", "x*y^-1", "x^-1*y", "x", "y"));
}

TEST(Monomials, TermsEvaluateAsNamed) {
  const TermLibrary library =
      Monomials{{.min_degree = -1, .max_degree = 2}}.library(kDrivenPlane);
  const Program program = library.compile();
  Program::Workspace workspace;
  std::vector<double> out(static_cast<std::size_t>(library.size()));
  const double x = 1.3, u = -0.7, slots[] = {x, u, 9.0};
  program.evaluate(slots, out.data(), workspace);
  ASSERT_FALSE(out.empty());
  for (std::size_t i = 0; i < out.size(); ++i) {
    const std::vector<int> e = *library.terms[i].exponents();
    EXPECT_NEAR(out[i], std::pow(x, e[0]) * std::pow(u, e[1]), 1e-14)
        << library.terms[i].name();
  }
}

TEST(Monomials, InputsAndTimeAreFurtherVariables) {
  EXPECT_THAT(names({.max_degree = 1}, kDrivenPlane), ElementsAre("1", "x", "u"));
  EXPECT_THAT(names({.max_degree = 1, .with_inputs = false}, kDrivenPlane),
              ElementsAre("1", "x"));
  EXPECT_THAT(names({.max_degree = 1, .with_time = true}, kDrivenPlane),
              ElementsAre("1", "x", "u", "t"));
  EXPECT_THAT(names({.max_degree = 1, .with_inputs = false, .with_time = true}, kDrivenPlane),
              ElementsAre("1", "x", "t"));
}

TEST(Monomials, IncludeAddsAndExcludeRemoves) {
  EXPECT_THAT(
      names({.max_degree = 1, .include = {"sin(x)", "x"}, .exclude = {"u"}}, kDrivenPlane),
      ElementsAre("1", "x", "sin(x)"));
}

TEST(Monomials, UnknownVariableNamesTheEntry) {
  try {
    names({.include = {"x", "sin(q)"}}, kXyz);
    FAIL();
  } catch (const ModelError& error) {
    EXPECT_NE(error.where().find("monomials.include[1]"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("q"), std::string::npos);
  }
  EXPECT_THROW(names({.exclude = {"w"}}, kXyz), ModelError);
}

TEST(Monomials, DegreesOutOfOrderAreRefused) {
  EXPECT_THROW(names({.min_degree = 3, .max_degree = 2}, kXyz), ConfigError);
  EXPECT_THROW(Monomials({.max_degree = 21}), ConfigError);
}

TEST(Monomials, NoTermLeftIsRefused) {
  EXPECT_THROW(names({.max_degree = 0, .exclude = {"1"}}, kXyz), ConfigError);
}

TEST(Monomials, TooManyTermsAreRefusedBeforeTheyAreMade) {
  const auto variables = [](int count) {
    Variables many;
    for (int i = 0; i < count; ++i) many.states.push_back("x" + std::to_string(i));
    return many;
  };
  EXPECT_THROW(names({.max_degree = 20}, variables(8)), ConfigError);
  EXPECT_THROW(names({.max_degree = 20}, variables(1000000)), ConfigError);
  EXPECT_THROW(names({.min_degree = 20, .max_degree = 20}, variables(1000000)), ConfigError);
  // 99 681 and 100 128 squares and products; 90 901 and 106 601 powers of both signs.
  EXPECT_THROW(names({.min_degree = 2, .max_degree = 2}, variables(447)), ConfigError);
  EXPECT_THROW(names({.min_degree = -2, .max_degree = 2}, variables(25)), ConfigError);
  EXPECT_EQ(names({.min_degree = 2, .max_degree = 2}, variables(40)).size(), 820u);
}

}  // namespace
}  // namespace lacuna
