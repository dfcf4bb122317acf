// SPDX-License-Identifier: MIT
#include "lacuna/bases/compositions.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lacuna/bases/expressions.hpp"
#include "lacuna/bases/monomials.hpp"

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
  EXPECT_EQ(product.library(kTwo).names(), (Monomials{{.max_degree = 2}}.library(kTwo).names()));
}

TEST(ProductOfBases, TooManyAreRefused) {
  const Stage<Basis> many = Monomials{{.max_degree = 20}};
  const Variables four{{"a", "b", "c", "d"}, {}};
  EXPECT_THROW((ProductOfBases{{.first = many, .second = many}}.library(four)), ConfigError);
}

}  // namespace
}  // namespace lacuna
