// SPDX-License-Identifier: MIT
#include "lacuna/linear/forward_order.hpp"

#include <algorithm>

namespace lacuna {
namespace {

/// What is left of the columns and of the target beside an orthonormal basis of those taken.
class Deflation {
 public:
  Deflation(const Eigen::Ref<const Matrix>& columns, const Vector& target)
      : columns_(columns),
        rest_(target),
        products_(columns.transpose() * target),
        sizes_(columns.colwise().squaredNorm()),
        smallest_(kNew * sizes_),
        basis_(columns.rows(), 0) {}

  double left() const { return rest_.squaredNorm(); }

  /// The column that is worth most; nothing new is left when its gain is 0.
  double best(Index& column) const {
    const auto is_new = sizes_.array() > smallest_.array();
    const Vector gains =
        is_new.select(products_.array().square() / sizes_.array().max(kTiny), 0.0);
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
    const Vector shares = columns_.transpose() * direction;
    const double share = direction.dot(rest_);
    rest_ -= share * direction;
    products_ -= share * shares;
    sizes_ -= shares.cwiseAbs2();
    sizes_[j] = 0.0;
    basis_.conservativeResize(columns_.rows(), basis_.cols() + 1);
    basis_.rightCols(1) = direction;
    return true;
  }

 private:
  static constexpr double kNew = 1e-12;  ///< squared share of a column
  static constexpr double kTiny = 1e-300;

  const Eigen::Ref<const Matrix>& columns_;
  Vector rest_;
  Vector products_;  ///< of the columns with the rest
  Vector sizes_;     ///< squared norms of what is left of the columns
  Vector smallest_;
  Matrix basis_;
};

}  // namespace

ForwardOrder forward_order(const Eigen::Ref<const Matrix>& columns, const Vector& target,
                           const ForwardLimits& limits, const RunContext& context) {
  Deflation deflation(columns, target);
  ForwardOrder order;
  const auto take = [&](Index j) {
    context.check_stop();
    if (deflation.take(j)) order.columns.push_back(j);
  };
  for (const Index j : limits.first) take(j);
  const auto wanted = [&] {
    return static_cast<Index>(order.columns.size()) < limits.fewest ||
           deflation.left() > limits.enough;
  };
  for (Index next = 0; wanted() && deflation.best(next) > 0.0;) take(next);
  order.left = deflation.left();
  return order;
}

}  // namespace lacuna
