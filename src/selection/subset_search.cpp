// SPDX-License-Identifier: MIT
#include "lacuna/selection/subset_search.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <numeric>

namespace lacuna {
namespace {

/// Share of a column that is not rounding.
constexpr double kNew = 1e-9;

std::vector<Index> sorted(std::vector<Index> columns) {
  std::sort(columns.begin(), columns.end());
  return columns;
}

}  // namespace

/// Least squares in a subset.
struct SubsetSearch::Fit {
  Matrix inverse;  ///< of the triangle of the subset
  Vector solution;
  double residual = 0.0;
};

/// All columns without what the subset explains.
struct SubsetSearch::Deflated {
  Matrix columns;  ///< the last one is the target
  Vector sizes;    ///< squared norms, q

  /// Takes column j out of all others.
  void take(Index j) {
    const Vector direction = columns.col(j) / std::sqrt(sizes[j]);
    const Eigen::RowVectorXd shares = direction.transpose() * columns;
    columns.noalias() -= direction * shares;
    sizes = columns.leftCols(sizes.size()).colwise().squaredNorm();
    sizes[j] = 0.0;
  }

  double residual() const { return columns.col(sizes.size()).squaredNorm(); }

  Vector gains() const {
    const Index q = sizes.size();
    const Vector shares = columns.leftCols(q).transpose() * columns.col(q);
    Vector result = Vector::Zero(q);
    for (Index j = 0; j < q; ++j)
      if (sizes[j] > kNew * kNew) result[j] = shares[j] * shares[j] / sizes[j];
    return result;
  }
};

SubsetSearch::SubsetSearch(const Matrix& triangle, double price)
    : scaled_(triangle), price_(price) {
  const Index q = columns();
  norms_ = triangle.leftCols(q).colwise().norm();
  for (Index j = 0; j < q; ++j)
    if (norms_[j] > 0.0) scaled_.col(j) /= norms_[j];
  sizes_ = scaled_.leftCols(q).colwise().squaredNorm();
}

SubsetSearch::Fit SubsetSearch::fit(const std::vector<Index>& subset) const {
  const auto k = static_cast<Index>(subset.size());
  Matrix part(scaled_.rows(), k + 1);
  for (Index i = 0; i < k; ++i) part.col(i) = scaled_.col(subset[static_cast<std::size_t>(i)]);
  part.col(k) = scaled_.col(columns());
  const Matrix r = Eigen::HouseholderQR<Matrix>(part).matrixQR();
  Fit fit;
  const auto triangle = r.topLeftCorner(k, k).triangularView<Eigen::Upper>();
  fit.inverse = triangle.solve(Matrix::Identity(k, k));
  fit.solution = fit.inverse * r.col(k).head(k);
  fit.residual = k < r.rows() ? r(k, k) * r(k, k) : 0.0;
  return fit;
}

SubsetSearch::Deflated SubsetSearch::deflate(const std::vector<Index>& subset) const {
  Deflated deflated{scaled_, sizes_};
  for (const Index j : subset)
    if (deflated.sizes[j] > kNew * kNew) deflated.take(j);
  return deflated;
}

Vector SubsetSearch::gains(const std::vector<Index>& subset) const {
  Vector result = deflate(subset).gains();
  for (const Index j : subset) result[j] = 0.0;
  return result;
}

Vector SubsetSearch::losses(const std::vector<Index>& subset) const {
  const Fit found = fit(subset);
  return found.solution.array().square() / found.inverse.rowwise().squaredNorm().array();
}

Vector SubsetSearch::solve(const std::vector<Index>& subset) const {
  Vector h = fit(subset).solution;
  for (Index i = 0; i < h.size(); ++i) h[i] /= norms_[subset[static_cast<std::size_t>(i)]];
  return h;
}

double SubsetSearch::residual(const std::vector<Index>& subset) const {
  return fit(subset).residual;
}

Vector SubsetSearch::variances(const std::vector<Index>& subset) const {
  Vector variances = fit(subset).inverse.rowwise().squaredNorm();
  for (Index i = 0; i < variances.size(); ++i) {
    const double norm = norms_[subset[static_cast<std::size_t>(i)]];
    variances[i] /= norm * norm;
  }
  return variances;
}

/// Takes members away while the worst is worth less than the price.
void SubsetSearch::shrink(std::vector<Index>& subset) const {
  while (!subset.empty()) {
    Index worst = 0;
    if (!(losses(subset).minCoeff(&worst) < price_)) return;
    subset.erase(subset.begin() + worst);
  }
}

/// Takes columns in while the best is worth more than the price.
void SubsetSearch::extend(std::vector<Index>& subset) const {
  Deflated deflated = deflate(subset);
  Index best = 0;
  for (Vector gain = deflated.gains(); gain.maxCoeff(&best) > price_ * (1.0 + 1e-9);
       gain = deflated.gains()) {
    if (std::find(subset.begin(), subset.end(), best) != subset.end()) return;
    subset.push_back(best);
    deflated.take(best);
  }
}

/// Scores that differ by less are equal: a thousandth of a term, or rounding.
double SubsetSearch::equality(double score) const {
  return 1e-9 * std::abs(score) + 1e-3 * price_;
}

double SubsetSearch::score(const std::vector<Index>& subset) const {
  return residual(subset) + price_ * static_cast<double>(subset.size());
}

Subset SubsetSearch::stepwise(std::vector<Index> subset) const {
  shrink(subset);
  Subset best{sorted(subset), score(subset)};
  // A round that does not lower the score has met rounding: columns that nearly depend on each
  // other would go and come for ever.
  for (;;) {
    const std::size_t before = subset.size();
    extend(subset);
    if (subset.size() == before) return best;
    shrink(subset);
    const double now = score(subset);
    if (!(now < best.score - equality(best.score))) return best;
    best = {sorted(subset), now};
  }
}

/// What taking members out of a subset gives back to all other columns: directions d_i in the
/// span of the subset that are orthogonal to all its other members.
struct SubsetSearch::Exchanges {
  Deflated deflated;
  Matrix shares;      ///< k x (q + 1): of each direction in every column; the target last
  Matrix directions;  ///< (q + 1) x k, unit
  Vector products;    ///< q: of the deflated columns with the deflated target
  double residual = 0.0;

  /// Shares of an orthonormal basis of what members i and (when it is another one) j release.
  Matrix released(Index i, Index j) const {
    Matrix result(i == j ? 1 : 2, shares.cols());
    result.row(0) = shares.row(i);
    if (i == j) return result;
    const double common = directions.col(i).dot(directions.col(j));
    const double rest = std::sqrt(std::max(kNew * kNew, 1.0 - common * common));
    result.row(1) = (shares.row(j) - common * shares.row(i)) / rest;
    return result;
  }
};

SubsetSearch::Exchanges SubsetSearch::exchanges(const std::vector<Index>& subset) const {
  const Index q = columns();
  const Fit found = fit(subset);
  Exchanges result{deflate(subset), {}, {}, {}, 0.0};
  result.directions = scaled_(Eigen::all, subset) * (found.inverse * found.inverse.transpose());
  result.directions.colwise().normalize();
  result.shares = result.directions.transpose() * scaled_;
  const auto target = result.deflated.columns.col(q);
  result.products = result.deflated.columns.leftCols(q).transpose() * target;
  result.residual = target.squaredNorm();
  return result;
}

/// The best column to take in when members i and j (the same one: only that) leave, if that
/// lowers the sum of squares below a limit.
std::optional<Index> SubsetSearch::replacement(const Exchanges& all, Index i, Index j,
                                               double limit) const {
  const Index q = columns();
  const Matrix released = all.released(i, j);
  double least = all.residual + released.col(q).squaredNorm();
  const double before = least;
  std::optional<Index> best;
  for (Index c = 0; c < q; ++c) {
    if (!(all.deflated.sizes[c] > kNew * kNew)) continue;
    const double size = all.deflated.sizes[c] + released.col(c).squaredNorm();
    const double product = all.products[c] + released.col(c).dot(released.col(q));
    const double left = before - product * product / size;
    if (!(left < std::min(least, limit))) continue;
    least = left;
    best = c;
  }
  return best;
}

/// Exchanges one member, or two of them, for the best other column. @return whether it helped.
bool SubsetSearch::exchange(Subset& subset, Index together) const {
  const double least = equality(subset.score);
  const auto k = static_cast<Index>(subset.columns.size());
  if (k < together) return false;
  const Exchanges all = exchanges(subset.columns);
  const double limit = subset.score - least - price_ * static_cast<double>(k - together + 1);
  for (Index i = 0; i < k; ++i)
    for (Index j = together == 1 ? i : 0; j < (together == 1 ? i + 1 : i); ++j) {
      const std::optional<Index> in = replacement(all, i, j, limit);
      if (!in) continue;
      std::vector<Index> changed = subset.columns;
      changed.erase(changed.begin() + i);
      if (j != i) changed.erase(changed.begin() + j);
      changed.push_back(*in);
      // Among columns that nearly depend on each other the gain may be rounding.
      if (!(score(changed) < subset.score - least)) continue;
      Subset next = stepwise(std::move(changed));
      if (!(next.score < subset.score - least)) continue;
      subset = std::move(next);
      return true;
    }
  return false;
}

/// All columns, the worst taken out one by one as long as it is worth less than the price. The
/// inverse of A'A is downdated, which needs well separated columns.
std::vector<Index> SubsetSearch::eliminated() const {
  std::vector<Index> left(static_cast<std::size_t>(columns()));
  std::iota(left.begin(), left.end(), Index{0});
  const Index q = columns();
  const Matrix root =
      scaled_.topLeftCorner(q, q).triangularView<Eigen::Upper>().solve(Matrix::Identity(q, q));
  Matrix inverse = root * root.transpose();
  Vector h = root * scaled_.col(q).head(q);
  if (!inverse.allFinite() || inverse.diagonal().maxCoeff() > 1e12) return {};
  for (Index size = q; size > 0; --size) {
    Index worst = 0;
    const double least = (h.head(size).array().square() / inverse.diagonal().head(size).array())
                             .minCoeff(&worst);
    if (!(least < price_)) break;
    const Vector column = inverse.col(worst).head(size);
    h.head(size) -= column * (h[worst] / column[worst]);
    inverse.topLeftCorner(size, size) -= column * (column / column[worst]).transpose();
    // The last one takes the place of the one that leaves.
    const Index last = size - 1;
    h[worst] = h[last];
    inverse.row(worst).head(size) = inverse.row(last).head(size).eval();
    inverse.col(worst).head(size) = inverse.col(last).head(size).eval();
    left[static_cast<std::size_t>(worst)] = left.back();
    left.pop_back();
  }
  return left;
}

Subset SubsetSearch::best(const std::vector<std::vector<Index>>& starts, bool thorough) const {
  // Exchanges of pairs among more members than this cost more than they bring.
  constexpr std::size_t kMostMembers = 40;
  Subset best = stepwise({});
  std::vector<std::vector<Index>> seen;
  const auto consider = [&](Subset found) {
    if (std::find(seen.begin(), seen.end(), found.columns) != seen.end()) return;
    seen.push_back(found.columns);
    while (exchange(found, 1)) {
    }
    if (found.score < best.score) best = std::move(found);
  };
  consider(best);
  consider(stepwise(eliminated()));
  for (const std::vector<Index>& start : starts) consider(stepwise(start));
  while (thorough && best.columns.size() <= kMostMembers &&
         (exchange(best, 2) || exchange(best, 1))) {
  }
  return best;
}

}  // namespace lacuna
