// SPDX-License-Identifier: MIT
#include "regression/linear/forward_order.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/check.hpp"

namespace lacuna {
namespace {

/// A fact of doubles: keeps divisors that are not used from 0.
constexpr double kLeastDivisor = 1e-300;

/// The residuals of the columns and of the target beside an orthonormal basis of those taken.
class Deflation {
 public:
  Deflation(const Eigen::Ref<const Matrix>& columns, const Vector& target)
      : columns_(columns),
        rest_(target),
        products_(columns.transpose() * target),
        sizes_(columns.colwise().squaredNorm()),
        smallest_(kNewFraction * sizes_),
        basis_(columns.rows(), 0) {}

  double left() const { return rest_.squaredNorm(); }
  Vector& sizes() { return sizes_; }

  /// The column that is worth most; nothing new is left when its gain is 0.
  double best(Index& column) const {
    const auto is_new = sizes_.array() > smallest_.array();
    const Vector gains =
        is_new.select(products_.array().square() / sizes_.array().max(kLeastDivisor), 0.0);
    return gains.size() == 0 ? 0.0 : gains.maxCoeff(&column);
  }

  /// @return false when nothing of it is new.
  bool take(Index j) {
    Vector direction = columns_.col(j);
    for (int pass = 0; pass < 2; ++pass)  // twice is enough for full orthogonality
      direction -= basis_ * (basis_.transpose() * direction).eval();
    const double norm = direction.norm();
    sizes_[j] = 0.0;
    if (!(norm * norm > smallest_[j])) return false;
    direction /= norm;
    const Vector fractions = columns_.transpose() * direction;
    const double fraction = direction.dot(rest_);
    rest_ -= fraction * direction;
    products_ -= fraction * fractions;
    sizes_ -= fractions.cwiseAbs2();
    sizes_[j] = 0.0;
    basis_.conservativeResize(columns_.rows(), basis_.cols() + 1);
    basis_.rightCols(1) = direction;
    return true;
  }

 private:
  static constexpr double kNewFraction = 1e-12;  ///< squared, of a column: a fact of rounding

  const Eigen::Ref<const Matrix>& columns_;
  Vector rest_;
  Vector products_;  ///< of the columns with the rest
  Vector sizes_;     ///< squared norms of the residuals of the columns
  Vector smallest_;
  Matrix basis_;
};

/// The same in inner products.
class GramDeflation {
 public:
  GramDeflation(const Matrix& gram, Index q, Index target)
      : gram_(gram),
        left_(gram(target, target)),
        products_(gram.col(target).head(q)),
        sizes_(gram.diagonal().head(q)),
        smallest_(kNewFraction * sizes_),
        shares_(q, 0) {}

  double left() const { return std::max(left_, 0.0); }
  Vector& sizes() { return sizes_; }

  double best(Index& column) const {
    const auto is_new = sizes_.array() > smallest_.array();
    const Vector gains =
        is_new.select(products_.array().square() / sizes_.array().max(kLeastDivisor), 0.0);
    return gains.size() == 0 ? 0.0 : gains.maxCoeff(&column);
  }

  bool take(Index j) {
    const double size = sizes_[j];
    sizes_[j] = 0.0;
    if (!(size > smallest_[j])) return false;
    const Vector common = shares_ * shares_.row(j).transpose();
    const Vector fractions = (gram_.col(j).head(sizes_.size()) - common) / std::sqrt(size);
    const double fraction = products_[j] / std::sqrt(size);
    left_ -= fraction * fraction;
    products_ -= fraction * fractions;
    sizes_ -= fractions.cwiseAbs2();
    sizes_[j] = 0.0;
    shares_.conservativeResize(Eigen::NoChange, shares_.cols() + 1);
    shares_.rightCols(1) = fractions;
    return true;
  }

 private:
  static constexpr double kNewFraction = 1e-10;  ///< squared: a Gram matrix has half the digits

  const Matrix& gram_;
  double left_;
  Vector products_, sizes_, smallest_;
  Matrix shares_;  ///< of the columns in the directions that were taken
};

void check_named(const ForwardLimits& limits, Index columns) {
  for (const auto* named : {&limits.first, &limits.only})
    for (const Index j : *named) check_number(j, columns, "forward_order", "column");
}

/// Nothing of a column of size 0 is new.
void leave_out_others(const std::vector<Index>& only, Vector& sizes) {
  if (only.empty()) return;
  auto next = only.begin();
  for (Index j = 0; j < sizes.size(); ++j) {
    const bool stays = next != only.end() && *next == j;
    if (stays)
      ++next;
    else
      sizes[j] = 0.0;
  }
}

template <class Columns>
ForwardOrder ordered(Columns columns, const ForwardLimits& limits, const RunContext& context) {
  ForwardOrder order;
  const auto take = [&](Index j) {
    context.check_stop();
    if (columns.take(j)) order.columns.push_back(j);
  };
  for (const Index j : limits.first) take(j);
  leave_out_others(limits.only, columns.sizes());
  const auto wanted = [&] {
    return static_cast<Index>(order.columns.size()) < limits.fewest ||
           columns.left() > limits.enough;
  };
  for (Index next = 0; wanted() && columns.best(next) > 0.0;) take(next);
  order.left = columns.left();
  return order;
}

}  // namespace

ForwardOrder forward_order(const Eigen::Ref<const Matrix>& columns, const Vector& target,
                           const ForwardLimits& limits, const RunContext& context) {
  check_argument(columns.rows() == target.size(), "forward_order",
                 "columns and target differ in rows");
  check_named(limits, columns.cols());
  return ordered(Deflation(columns, target), limits, context);
}

ForwardOrder forward_order_in_gram(const Matrix& gram, Index q, Index target,
                                   const ForwardLimits& limits, const RunContext& context) {
  check_argument(gram.rows() == gram.cols(), "forward_order", "the Gram matrix is not square");
  check_number(target, gram.cols(), "forward_order", "target");
  check_argument(q >= 0 && q <= target, "forward_order", "the target is among the columns",
                 "give the columns first");
  check_named(limits, q);
  return ordered(GramDeflation(gram, q, target), limits, context);
}

}  // namespace lacuna
