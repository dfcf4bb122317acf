// SPDX-License-Identifier: MIT
#include "identify/pipeline/hurried_terms.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "lacuna/bases/expressions.hpp"
#include "lacuna/bases/monomials.hpp"

namespace lacuna {
namespace {

TermLibrary monomials(int states, int degree) {
  Variables variables;
  for (int k = 0; k < states; ++k) variables.states.push_back("x" + std::to_string(k));
  return Stage<Basis>(Monomials{{.max_degree = degree}})->library(variables);
}

TEST(CheapTerms, AreAllOfASmallLibrary) {
  EXPECT_EQ(cheap_terms(monomials(3, 3), 1000000, 3).size(), 20U);
}

TEST(CheapTerms, AreWholeDegreesAndTheTwoLowestInAnyCase) {
  const TermLibrary library = monomials(20, 3);
  ASSERT_EQ(library.size(), 1771);
  EXPECT_EQ(cheap_terms(library, 10000, 20).size(), 231U);     // 6.3e8 products
  EXPECT_EQ(cheap_terms(library, 100000000, 20).size(), 21U);  // 1.7e11
}

TEST(CheapTerms, AFunctionIsLikeAProductOfTwo) {
  const Variables variables{{"x"}, {}};
  const TermLibrary library =
      Stage<Basis>(Expressions{{.terms = {"x^3", "x", "sin(x)"}}})->library(variables);
  EXPECT_EQ(cheap_terms(library, 100000000, 1), (TermSet{1, 2}));
}

TEST(CanBeRead, IsAMatterOfProductsAndTime) {
  EXPECT_TRUE(can_be_read(10000, 1791, 1.0, 1));    // 3.2e10 products
  EXPECT_FALSE(can_be_read(10000, 1791, 0.5, 1));
  EXPECT_TRUE(can_be_read(10000, 1791, 0.5, 2));
  EXPECT_FALSE(can_be_read(15000, 12381, 3.0, 2));  // 2.3e12
  EXPECT_FALSE(can_be_read(10, 10, -1.0, 2));
}

/// y = 2 theta_7 - theta_290 + noise, in so many columns.
LeastSquaresSystem system_of(Index columns, Folding folding) {
  std::srand(3);
  const Matrix theta = Matrix::Random(900, columns);
  const Matrix y = 2.0 * theta.col(7) - theta.col(290) + 0.1 * Matrix::Random(900, 1);
  return {make_row_source(theta, y), std::vector<std::string>(static_cast<std::size_t>(columns)),
          {"y"}, {}, folding};
}

TEST(LeadingCandidates, AreFewAndThoseThatExplain) {
  for (const Folding folding : {Folding::Gram, Folding::Orthogonal}) {
    const LeastSquaresSystem system = system_of(300, folding);
    TermSet candidates = system.all_terms();
    std::erase(candidates, Index{12});
    const TermSet leading = leading_candidates(system, 0, candidates, {});
    EXPECT_EQ(leading.size(), 32U);
    EXPECT_TRUE(std::binary_search(leading.begin(), leading.end(), Index{7}));
    EXPECT_TRUE(std::binary_search(leading.begin(), leading.end(), Index{290}));
    EXPECT_EQ(terms_beside(leading, candidates), TermSet{});
  }
}

TEST(LeadingCandidates, AreAllOfFew) {
  const LeastSquaresSystem system = system_of(300, Folding::Gram);
  EXPECT_EQ(leading_candidates(system, 0, {1, 4, 290}, {}), (TermSet{1, 4, 290}));
}

TEST(TermsBeside, AreThoseOfOneSetAlone) {
  EXPECT_EQ(terms_beside({1, 2, 5, 8}, {2, 8}), (TermSet{1, 5}));
}

}  // namespace
}  // namespace lacuna
