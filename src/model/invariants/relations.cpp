// SPDX-License-Identifier: MIT
#include "lacuna/model/invariants/relations.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "core/numerics/least_squares.hpp"
#include "core/numerics/symmetric_eigen.hpp"
#include "data/records/far_variables.hpp"
#include "data/records/known_noise.hpp"
#include "model/invariants/divides.hpp"
#include "moments.hpp"

namespace lacuna {
namespace {

using Set = std::vector<Index>;

/// 1 + what chance adds to a mean of so many squares.
double with_chance(Index count, const RelationOptions& options) {
  return 1.0 +
         options.scatter * std::sqrt(2.0 / static_cast<double>(std::max<Index>(count, 1)));
}

double form(const Matrix& matrix, const Set& set, const Vector& c) {
  return c.dot(matrix(set, set) * c);
}

/// Of what may be below 0 by rounding.
double root(double square) { return std::sqrt(std::max(square, 0.0)); }

/// The combination of a set of monomials that varies least beside its noise; its first
/// coefficient is 1. Nothing where the first does not take part.
std::optional<Vector> flattest(const MonomialMoments& moments, const Set& set) {
  const Matrix covariance = moments.covariance(set, set);
  const Vector scale = covariance.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  Matrix noise = (moments.white + moments.lasting)(set, set);
  noise = scale.asDiagonal() * noise * scale.asDiagonal();
  // A fact of rounding: of moments whose diagonal is 1.
  constexpr double kRounding = 1e-14;
  noise.diagonal().array() += kRounding;
  const auto found =
      symmetric_eigen(scale.asDiagonal() * covariance * scale.asDiagonal(), noise);
  if (!found) return std::nullopt;
  const Vector c = scale.asDiagonal() * found->vectors.col(0);
  if (!(std::abs(c[0]) > 0.0) || !c.allFinite()) return std::nullopt;
  return Vector(c / c[0]);
}

/// By what factor a variance may be above that of noise which is known in part only.
double slack_of(const RelationOptions& options) {
  return (1.0 + options.noise_slack) * (1.0 + options.noise_slack);
}

/// Whether what a combination varies by from sample to sample is noise.
bool is_noise_in_samples(const MonomialMoments& moments, const Set& set, const Vector& c,
                         const RelationOptions& options) {
  const double noise = form(moments.white, set, c) + form(moments.lasting, set, c);
  return form(moments.covariance, set, c) <=
         slack_of(options) * with_chance(moments.samples, options) * noise;
}

/// Whether the same holds for means of blocks, where what lasts is left.
bool is_noise_in_means(const MonomialMoments& moments, const Set& set, const Vector& c,
                       const RelationOptions& options) {
  const Vector means = moments.block_means(Eigen::all, set) * c;
  const double left = means.squaredNorm() / static_cast<double>(means.size());
  const double allowed = form(moments.white, set, c) / static_cast<double>(moments.block) +
                         form(moments.lasting, set, c);
  return left <= slack_of(options) * with_chance(means.size(), options) * allowed;
}

/// Whether the noise of a combination is that of its gradient, as is assumed. Where its
/// gradient hardly differs from 0, of (z - 3)^2 beside z = 3 say, any small motion of z is lost
/// in the square of the noise, so that the combination is constant whatever z does.
bool is_first_order(const MonomialMoments& moments, const Set& set, const Vector& c) {
  const double second = form(moments.second, set, c);
  return form(moments.white, set, c) - second >= second;
}

/// Whether every summand varies by much more than their sum does.
bool is_strong(const MonomialMoments& moments, const Set& set, const Vector& c,
               double strength) {
  if (set.size() == 1) return true;
  const double scatter = root(form(moments.covariance, set, c));
  for (Index j = 0; j < c.size(); ++j) {
    const Index term = set[static_cast<std::size_t>(j)];
    if (std::abs(c[j]) * std::sqrt(moments.covariance(term, term)) < strength * scatter)
      return false;
  }
  return true;
}

/// Errors of the coefficients beside the first, as those of a regression of the first monomial
/// on the others.
Vector errors_of(const MonomialMoments& moments, const Set& set, double scatter) {
  const auto size = static_cast<Index>(set.size());
  Vector errors = Vector::Zero(size);
  if (size < 2) return errors;
  const Matrix covariance = moments.covariance(set, set).bottomRightCorner(size - 1, size - 1);
  const Matrix inverse = solve_symmetric(covariance, Matrix::Identity(size - 1, size - 1));
  const double rows = static_cast<double>(moments.samples);
  errors.tail(size - 1) = scatter * (inverse.diagonal() / rows).cwiseMax(0.0).cwiseSqrt();
  return errors;
}

Relation relation_of(const MonomialMoments& moments, const Set& set, const Vector& c) {
  Relation relation;
  relation.scatter = root(form(moments.covariance, set, c));
  relation.noise = root(form(moments.white, set, c) + form(moments.lasting, set, c));
  const Vector errors = errors_of(moments, set, relation.scatter);
  for (Index j = 0; j < c.size(); ++j) {
    const Index term = set[static_cast<std::size_t>(j)];
    relation.value += c[j] * moments.mean[term];
    relation.terms.push_back(
        {moments.terms[static_cast<std::size_t>(term)].name(), c[j], errors[j]});
  }
  return relation;
}

double binomial(double n, double k) {
  double value = 1.0;
  for (double i = 0.0; i < k; ++i) value *= (n - i) / (i + 1.0);
  return value;
}

int degree_of(const MonomialMoments& moments, Index term) {
  int degree = 0;
  for (const int power : moments.exponents[static_cast<std::size_t>(term)]) degree += power;
  return degree;
}

/// Monomials that may stand in a relation: products with a state far from 0 are as good as
/// lines.
Set pool_of(const MonomialMoments& moments, const Dataset& data) {
  const std::vector<FarVariable> far = far_variables(data);
  Set pool;
  for (Index c = 0; c < static_cast<Index>(moments.terms.size()); ++c) {
    const auto used = moments.terms[static_cast<std::size_t>(c)].expression().variables();
    const bool is_far = std::any_of(far.begin(), far.end(), [&](const FarVariable& one) {
      return used.contains(one.name);
    });
    if (!is_far || degree_of(moments, c) == 1) pool.push_back(c);
  }
  return pool;
}

/// Whether a sum vanishes that is the product of a state and something else: w*z - 3*w = 0 is
/// z = 3, which has been looked at, as it has fewer factors.
bool is_multiple(const MonomialMoments& moments, const Set& set, const Relation& relation) {
  if (std::abs(relation.value) > relation.scatter) return false;
  const std::size_t states = moments.exponents.front().size();
  for (std::size_t k = 0; k < states; ++k)
    if (std::all_of(set.begin(), set.end(), [&](Index term) {
          return moments.exponents[static_cast<std::size_t>(term)][k] > 0;
        }))
      return true;
  return false;
}

/// A polynomial by the exponents of its monomials.
using Polynomial = std::map<std::vector<int>, double>;

Polynomial product(const Polynomial& one, const Polynomial& other) {
  Polynomial result;
  for (const auto& [left, a] : one)
    for (const auto& [right, b] : other) {
      std::vector<int> sum = left;
      for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += right[k];
      result[sum] += a * b;
    }
  return result;
}

/// A sum of states that moves by less than their noise, solved for one of them.
struct StillSum {
  std::size_t state = 0;
  Polynomial rest;  ///< state = rest wherever the sum is what it is on average
};

/// @param set monomials of degree 1 whose combination c hardly moves.
StillSum still_sum(const MonomialMoments& moments, const Set& set, const Vector& c) {
  const auto exponents = [&](Index j) -> const std::vector<int>& {
    return moments.exponents[static_cast<std::size_t>(set[static_cast<std::size_t>(j)])];
  };
  const Index last = c.size() - 1;
  const std::vector<int>& solved = exponents(last);
  StillSum sum;
  sum.state = static_cast<std::size_t>(std::find(solved.begin(), solved.end(), 1) -
                                       solved.begin());
  double value = 0.0;
  for (Index j = 0; j <= last; ++j) {
    value += c[j] * moments.mean[set[static_cast<std::size_t>(j)]];
    if (j < last) sum.rest[exponents(j)] = -c[j] / c[last];
  }
  sum.rest[std::vector<int>(solved.size(), 0)] = value / c[last];
  return sum;
}

/// A combination of monomials with a state replaced by what a sum that hardly moves has for it.
Polynomial without_state(const MonomialMoments& moments, const Set& set, const Vector& c,
                         const StillSum& sum) {
  Polynomial result;
  for (Index j = 0; j < c.size(); ++j) {
    std::vector<int> other =
        moments.exponents[static_cast<std::size_t>(set[static_cast<std::size_t>(j)])];
    const int power = std::exchange(other[sum.state], 0);
    Polynomial term{{other, c[j]}};
    for (int i = 0; i < power; ++i) term = product(term, sum.rest);
    for (const auto& [exponents, coefficient] : term) result[exponents] += coefficient;
  }
  return result;
}

/// Whether a relation is the product of a sum that hardly moves, z - 3 say, and something that
/// moves: with z = 3 nothing of it is left. In (z - 3) x the motion of z is averaged out as
/// soon as x oscillates, so that neither samples nor means of them show it.
bool is_product_with(const MonomialMoments& moments, const Set& set, const Vector& c,
                     const StillSum& sum, double scatter) {
  const Polynomial left = without_state(moments, set, c, sum);
  for (std::size_t term = 0; term < moments.exponents.size(); ++term) {
    const auto at = left.find(moments.exponents[term]);
    if (at == left.end()) continue;
    const auto place = static_cast<Index>(term);
    if (std::abs(at->second) * root(moments.covariance(place, place)) > scatter) return false;
  }
  return true;
}

/// Goes through sets of monomials, fewest first.
class RelationSearch {
 public:
  RelationSearch(const MonomialMoments& moments, const RelationOptions& options,
                 const RunContext& context)
      : moments_(moments), options_(options), context_(context) {}

  std::vector<Relation> run(const Set& all, int most_degree) {
    for (int degree = 1; degree <= most_degree; ++degree) {
      Set pool;
      for (const Index c : all)
        if (degree_of(moments_, c) <= degree) pool.push_back(c);
      for (std::size_t size = 1;
           size <= std::min(pool.size(), static_cast<std::size_t>(options_.most_terms));
           ++size) {
        if (binomial(static_cast<double>(pool.size()), static_cast<double>(size)) >
            options_.most_sets)
          break;
        Set set;
        extend(pool, 0, size, set);
      }
    }
    return std::move(found_);
  }

 private:
  bool follows(Index term) const {
    return std::any_of(leading_.begin(), leading_.end(), [&](Index leader) {
      return divides(moments_.exponents[static_cast<std::size_t>(leader)],
                     moments_.exponents[static_cast<std::size_t>(term)]);
    });
  }

  void extend(const Set& pool, std::size_t from, std::size_t size, Set& set) {
    if (set.size() == size) return look_at(set);
    for (std::size_t i = from; i < pool.size(); ++i) {
      if (follows(pool[i])) continue;
      set.push_back(pool[i]);
      extend(pool, i + 1, size, set);
      set.pop_back();
    }
  }

  void look_at(const Set& set) {
    context_.check_stop();
    if (std::any_of(set.begin(), set.end(), [&](Index term) { return follows(term); })) return;
    const std::optional<Vector> c = flattest(moments_, set);
    if (!c || !is_noise_in_samples(moments_, set, *c, options_) ||
        !is_first_order(moments_, set, *c) ||
        !is_strong(moments_, set, *c, options_.strength))
      return;
    const bool is_sum = degree_of(moments_, set.back()) == 1;
    if (!is_noise_in_means(moments_, set, *c, options_)) {
      if (is_sum) still_.push_back(still_sum(moments_, set, *c));
      return;
    }
    Relation relation = relation_of(moments_, set, *c);
    // A state that is 0 itself is one, and no product.
    if (!is_sum && is_product(set, *c, relation)) return;
    found_.push_back(std::move(relation));
    leading_.push_back(set.back());
  }

  /// Whether what vanishes is a product, of which one factor says more.
  bool is_product(const Set& set, const Vector& c, const Relation& relation) const {
    return is_multiple(moments_, set, relation) ||
           std::any_of(still_.begin(), still_.end(), [&](const StillSum& sum) {
             return is_product_with(moments_, set, c, sum, relation.scatter);
           });
  }

  const MonomialMoments& moments_;
  const RelationOptions& options_;
  const RunContext& context_;
  std::vector<StillSum> still_;  ///< that are no relations, as they move over longer times
  std::vector<Relation> found_;
  std::vector<Index> leading_;
};

}  // namespace

std::vector<Relation> find_relations(const Dataset& data, const RelationOptions& options,
                                     const RunContext& context, const KnownNoise& noise) {
  check_dataset(data);
  check_known(noise, data, "find_relations");
  context.check_stop();
  Index measured = 0;
  for (Index k = 0; k < data.state_count(); ++k)
    if (data.is_measured(k)) ++measured;
  if (measured == 0 || data.samples() < options.fewest_samples) return {};
  const int degree = measured > options.most_states ? 1 : 2;
  const MonomialMoments moments =
      monomial_moments(data, degree, options.resolution, context.threads, noise);
  return RelationSearch(moments, options, context).run(pool_of(moments, data), degree);
}

}  // namespace lacuna
