// SPDX-License-Identifier: MIT
#include "gaussian_information.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "core/base/check.hpp"
#include "significance.hpp"

namespace lacuna {
namespace {

/// A fact of rounding: less than this fraction of a variance is none.
constexpr double kRounding = 1e-20;

/// That of a squared correlation; one of 1 is a fact of rounding.
double information_of(double square) {
  return -0.5 * std::log1p(-std::min(square, 1.0 - 1e-15));
}

Vector without_mean(const Vector& x) {
  Vector rest = x.array() - x.mean();
  return rest.squaredNorm() > kRounding * x.squaredNorm() ? rest : Vector::Zero(x.size());
}

/// Scores of sizes among all sizes of either sign, with the signs of the values.
Vector signed_scores(const Vector& x, const Vector& quantiles) {
  const Vector both = (Vector(2 * x.size()) << x.cwiseAbs(), -x.cwiseAbs()).finished();
  const Vector sizes = normal_scores(both, quantiles).head(x.size());
  return (x.array() < 0.0).select(-sizes, (x.array() > 0.0).select(sizes, 0.0));
}

}  // namespace

Vector normal_quantiles(Index n) {
  check_argument(n >= 0, "normal_quantiles", "the number of values is negative",
                 "give one from 0 on");
  Vector quantiles(n);
  for (Index rank = 0; rank < n - rank; ++rank) {
    const double tail = (2.0 * static_cast<double>(rank) + 1.0) / static_cast<double>(n);
    quantiles[rank] = -sigma_of_log_probability(std::log(tail));
    quantiles[n - 1 - rank] = -quantiles[rank];
  }
  return quantiles;
}

Vector normal_scores(const Vector& values, const Vector& quantiles) {
  check_argument(values.size() == quantiles.size(), "normal_scores",
                 "there are not as many quantiles as values", "give those of as many");
  std::vector<Index> order(static_cast<std::size_t>(values.size()));
  std::iota(order.begin(), order.end(), Index{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](Index a, Index b) { return values[a] < values[b]; });
  Vector scores(values.size());
  for (std::size_t first = 0; first < order.size();) {
    std::size_t last = first + 1;
    while (last < order.size() && values[order[last]] == values[order[first]]) ++last;
    const double mean = quantiles
                            .segment(static_cast<Index>(first), static_cast<Index>(last - first))
                            .mean();
    for (; first < last; ++first) scores[order[first]] = mean;
  }
  return scores;
}

double gaussian_information(const Vector& x, const Vector& y) {
  check_argument(x.size() == y.size(), "gaussian_information",
                 "the variables have not as many values as each other",
                 "give values of the same samples");
  if (x.size() == 0) return 0.0;
  const Vector a = without_mean(x), b = without_mean(y);
  const double sizes = a.squaredNorm() * b.squaredNorm();
  return sizes > 0.0 ? information_of(a.dot(b) * a.dot(b) / sizes) : 0.0;
}

double signed_information(const Vector& x, const Vector& y) {
  check_argument(x.size() == y.size(), "signed_information",
                 "the variables have not as many values as each other",
                 "give values of the same samples");
  const Vector quantiles = normal_quantiles(2 * x.size());
  const Vector a = signed_scores(x, quantiles), b = signed_scores(y, quantiles);
  const double sizes = a.squaredNorm() * b.squaredNorm();
  return sizes > 0.0 ? information_of(a.dot(b) * a.dot(b) / sizes) : 0.0;
}

}  // namespace lacuna
