// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lacuna/bases/expressions.hpp"
#include "lacuna/bases/fourier.hpp"
#include "lacuna/bases/monomials.hpp"

namespace lacuna {
namespace {

using testing::ElementsAre;

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
