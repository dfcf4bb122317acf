// SPDX-License-Identifier: MIT
#include "hurried_terms.hpp"

#include <algorithm>
#include <cstdlib>
#include <iterator>
#include <limits>
#include <numeric>

#include "regression/linear/forward_order.hpp"

namespace lacuna {
namespace {

/// Decisions on what an answer is made of past its time limit (docs/decisions/bounds.md).
constexpr double kCheapProducts = 1e9;
constexpr Index kLeading = 32;

/// Degree of a product; 2 of anything else.
int degree_of(const Term& term) {
  constexpr int kOfOthers = 2;  // a fact of the order: they come with the squares
  const auto exponents = term.exponents();
  if (!exponents) return kOfOthers;
  return std::accumulate(exponents->begin(), exponents->end(), 0,
                         [](int sum, int exponent) { return sum + std::abs(exponent); });
}

/// Orthogonal least squares in the Gram matrix, or in the triangle where there is none.
std::vector<Index> forward_terms(const Factor& factor, Index target, const TermSet& candidates,
                                 const RunContext& context) {
  const ForwardLimits limits{.first = {},
                             .fewest = kLeading,
                             .enough = std::numeric_limits<double>::infinity(),
                             .only = candidates};
  const Index terms = factor.terms();
  if (factor.gram.size() > 0)
    return forward_order_in_gram(factor.gram, terms, terms + target, limits, context).columns;
  return forward_order(factor.triangle.topLeftCorner(terms, terms),
                       factor.triangle.col(terms + target).head(terms), limits, context)
      .columns;
}

}  // namespace

TermSet cheap_terms(const TermLibrary& library, Index rows, Index targets) {
  std::vector<int> degrees;
  for (const Term& term : library.terms) degrees.push_back(degree_of(term));
  std::vector<int> levels = degrees;
  std::sort(levels.begin(), levels.end());
  levels.erase(std::unique(levels.begin(), levels.end()), levels.end());
  TermSet cheap;
  for (std::size_t level = 0; level < levels.size(); ++level) {
    TermSet terms;
    for (std::size_t i = 0; i < degrees.size(); ++i)
      if (degrees[i] <= levels[level]) terms.push_back(static_cast<Index>(i));
    const auto columns = static_cast<double>(static_cast<Index>(terms.size()) + targets);
    if (level > 1 && static_cast<double>(rows) * columns * columns > kCheapProducts) break;
    cheap = std::move(terms);
  }
  return cheap;
}

bool can_be_read(Index rows, Index columns, double seconds, int threads) {
  constexpr double kMostProducts = 5e10;  // a second of a thread: a fact of the machines
  const auto wide = static_cast<double>(columns);
  return static_cast<double>(rows) * wide * wide <= kMostProducts * seconds * threads;
}

TermSet leading_candidates(const LeastSquaresSystem& system, Index target,
                           const TermSet& candidates, const RunContext& context) {
  if (static_cast<Index>(candidates.size()) <= kLeading) return candidates;
  TermSet leading = forward_terms(system.factor(), target, candidates, context);
  std::sort(leading.begin(), leading.end());
  return leading;
}

TermSet terms_beside(const TermSet& all, const TermSet& some) {
  TermSet others;
  std::set_difference(all.begin(), all.end(), some.begin(), some.end(),
                      std::back_inserter(others));
  return others;
}

}  // namespace lacuna
