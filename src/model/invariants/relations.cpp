// SPDX-License-Identifier: MIT
#include "lacuna/model/invariants/relations.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/numerics/least_squares.hpp"
#include "core/numerics/symmetric_eigen.hpp"
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
  constexpr double kRounding = 1e-14;
  noise.diagonal().array() += kRounding;
  const auto found =
      symmetric_eigen(scale.asDiagonal() * covariance * scale.asDiagonal(), noise);
  if (!found) return std::nullopt;
  const Vector c = scale.asDiagonal() * found->vectors.col(0);
  if (!(std::abs(c[0]) > 0.0) || !c.allFinite()) return std::nullopt;
  return Vector(c / c[0]);
}

/// Whether what a combination varies by is noise, over samples and over blocks of them.
bool is_noise(const MonomialMoments& moments, const Set& set, const Vector& c,
              const RelationOptions& options) {
  const double white = form(moments.white, set, c), lasting = form(moments.lasting, set, c);
  const double slack = (1.0 + options.noise_slack) * (1.0 + options.noise_slack);
  if (form(moments.covariance, set, c) >
      slack * with_chance(moments.samples, options) * (white + lasting))
    return false;
  const Vector means = moments.block_means(Eigen::all, set) * c;
  const double left = means.squaredNorm() / static_cast<double>(means.size());
  const double allowed = white / static_cast<double>(moments.block) + lasting;
  return left <= slack * with_chance(means.size(), options) * allowed;
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

/// Goes through sets of monomials, fewest first.
class RelationSearch {
 public:
  RelationSearch(const MonomialMoments& moments, const RelationOptions& options,
                 const RunContext& context)
      : moments_(moments), options_(options), context_(context) {}

  std::vector<Relation> run(int most_degree) {
    for (int degree = 1; degree <= most_degree; ++degree) {
      Set pool;
      for (Index c = 0; c < static_cast<Index>(moments_.terms.size()); ++c)
        if (degree_of(c) <= degree) pool.push_back(c);
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
  int degree_of(Index term) const {
    int degree = 0;
    for (const int power : moments_.exponents[static_cast<std::size_t>(term)]) degree += power;
    return degree;
  }

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
    if (!c || !is_noise(moments_, set, *c, options_) ||
        !is_strong(moments_, set, *c, options_.strength))
      return;
    found_.push_back(relation_of(moments_, set, *c));
    leading_.push_back(set.back());
  }

  const MonomialMoments& moments_;
  const RelationOptions& options_;
  const RunContext& context_;
  std::vector<Relation> found_;
  std::vector<Index> leading_;
};

}  // namespace

std::vector<Relation> find_relations(const Dataset& data, const RelationOptions& options,
                                     const RunContext& context) {
  check_dataset(data);
  Index measured = 0;
  for (Index k = 0; k < data.state_count(); ++k)
    if (data.is_measured(k)) ++measured;
  if (measured == 0 || data.samples() < options.fewest_samples) return {};
  const int degree = measured > options.most_states ? 1 : 2;
  const MonomialMoments moments =
      monomial_moments(data, degree, options.resolution, context.threads);
  return RelationSearch(moments, options, context).run(degree);
}

}  // namespace lacuna
