// SPDX-License-Identifier: MIT
#include "data/derivatives/stencil.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/base/check.hpp"
#include "core/numerics/qr.hpp"

namespace lacuna {
namespace {

/// Samples from `first` on take part in a row of their own weights.
void apply_row(const StencilRule& rule, const Vector& weights, Index first, Index row,
               const Eigen::Ref<const Matrix>& values, Matrix& result) {
  const auto samples = values.middleRows(first, weights.size());
  if (rule.order == 0)
    result.row(row) = weights.transpose() * samples;
  else
    result.row(row) = weights.transpose() * (samples.rowwise() - values.row(row));
}

void apply_own_weights(const StencilRule& rule, const Vector& time, Index row,
                       const Eigen::Ref<const Matrix>& values, Matrix& result) {
  const Index last_first = time.size() - rule.width;
  const Index first = std::clamp<Index>(row - rule.width / 2, 0, last_first);
  const Vector nodes = time.segment(first, rule.width).array() - time[row];
  apply_row(rule, rule.weights(nodes, 0.0), first, row, values, result);
}

/// Rows radius..n-radius-1 with one set of weights; weights left and right of the middle are
/// equal or opposite, so that samples are paired.
void apply_inside(const StencilRule& rule, double step, const Eigen::Ref<const Matrix>& values,
                  Matrix& result) {
  const Index r = rule.radius;
  const Index count = values.rows() - 2 * r;
  const double edge = static_cast<double>(r) * step;
  const Vector weights = rule.weights(Vector::LinSpaced(2 * r + 1, -edge, edge), 0.0);
  const auto at = [&](Index shift) { return values.middleRows(r + shift, count); };
  auto inside = result.middleRows(r, count);
  inside.setZero();
  if (rule.order == 0) inside = weights[r] * at(0);
  for (Index j = r; j >= 1; --j) {
    const double w = weights[r + j];
    if (rule.order == 0)
      inside += w * (at(j) + at(-j));
    else if (rule.order % 2 == 1)
      inside += w * (at(j) - at(-j));
    else
      inside += w * ((at(j) - at(0)) - (at(0) - at(-j)));
  }
}

/// Table of Fornberg's recursion: weights(j, d) of derivative d at node j.
class FornbergTable {
 public:
  FornbergTable(const Vector& nodes, double at, int order)
      : nodes_(nodes), at_(at), weights_(Matrix::Zero(nodes.size(), order + 1)) {
    weights_(0, 0) = 1.0;
    for (Index i = 1; i < nodes.size(); ++i) add_node(i);
  }

  Vector column(int order) const { return weights_.col(order); }

 private:
  void add_node(Index i) {
    const Index top = std::min(i, weights_.cols() - 1);
    const double offset = nodes_[i] - at_;
    double product = 1.0;
    for (Index j = 0; j < i; ++j) {
      const double gap = nodes_[i] - nodes_[j];
      product *= gap;
      if (j == i - 1) start_node(i, top, product);
      for (Index d = top; d >= 0; --d)
        weights_(j, d) = (offset * weights_(j, d) - lower(j, d)) / gap;
    }
    previous_product_ = product;
  }

  void start_node(Index i, Index top, double product) {
    const double scale = previous_product_ / product;
    const double offset = nodes_[i - 1] - at_;
    for (Index d = top; d >= 0; --d)
      weights_(i, d) = scale * (lower(i - 1, d) - offset * weights_(i - 1, d));
  }

  double lower(Index j, Index d) const {
    return d == 0 ? 0.0 : static_cast<double>(d) * weights_(j, d - 1);
  }

  const Vector& nodes_;
  double at_;
  Matrix weights_;
  double previous_product_ = 1.0;
};

Vector finite_weights(Vector weights, const char* where) {
  check_argument(weights.allFinite(), where, "the weights are not finite",
                 "give nodes that are finite, distinct and not too near to each other");
  return weights;
}

void check_rule(const StencilRule& rule, Index times, Index rows, Index margin) {
  const char* where = "apply_stencil";
  check_argument(
      rule.weights && rule.order >= 0 && rule.radius >= 0 && rule.width > 2 * rule.radius,
      where, "the rule has no weights or no width");
  check_argument(times == rows, where, "times and values differ in number",
                 "give one row of values for each time");
  check_argument(margin >= 0 && margin <= times / 2, where, "the margin leaves no samples");
}

}  // namespace

std::optional<double> common_step(const Vector& time) {
  // A fact of the files: steps whose times have few digits are one step.
  constexpr double kTolerance = 1e-3;
  const Index last = time.size() - 1;
  if (last < 1) return std::nullopt;
  const double step = (time[last] - time[0]) / static_cast<double>(last);
  for (Index i = 1; i < last; ++i)
    if (!(std::abs(time[i] - time[0] - static_cast<double>(i) * step) <= kTolerance * step))
      return std::nullopt;
  if (!(step > 0.0) || !std::isfinite(step)) return std::nullopt;
  return step;
}

Vector power_derivatives(double s, int degree, int order) {
  Vector result = Vector::Zero(degree + 1);
  for (int p = order; p <= degree; ++p) {
    double factor = std::pow(s, p - order);
    for (int q = p - order + 1; q <= p; ++q) factor *= q;
    result[p] = factor;
  }
  return result;
}

Vector interpolation_weights(const Vector& nodes, double at, int order) {
  constexpr const char* kWhere = "interpolation_weights";
  check_argument(order >= 0 && nodes.size() > order, kWhere,
                 "the order is negative or has not more nodes than it", "give order + 1 nodes");
  return finite_weights(FornbergTable(nodes, at, order).column(order), kWhere);
}

Vector fit_weights(const Vector& nodes, double at, int degree, int order) {
  constexpr const char* kWhere = "fit_weights";
  check_argument(degree >= 0 && order >= 0 && nodes.size() > degree, kWhere,
                 "degree or order is negative, or the degree has not more nodes than it",
                 "give degree + 1 nodes");
  check_times(nodes, 1, kWhere);
  if (order > degree) return Vector::Zero(nodes.size());
  if (nodes.size() == 1) return Vector::Ones(1);
  const double centre = 0.5 * (nodes[0] + nodes[nodes.size() - 1]);
  const double scale = 0.5 * (nodes[nodes.size() - 1] - nodes[0]);
  const Vector s = (nodes.array() - centre) / scale;
  Matrix powers(nodes.size(), degree + 1);
  powers.col(0).setOnes();
  for (int p = 1; p <= degree; ++p) powers.col(p) = powers.col(p - 1).cwiseProduct(s);
  // With V = QR the fit has coefficients R^-1 Q'x; its derivative is d'R^-1 Q'x.
  const Qr qr(powers);
  Vector weights = Vector::Zero(nodes.size());
  weights.head(degree + 1) = qr.triangle().triangularView<Eigen::Upper>().transpose().solve(
      power_derivatives((at - centre) / scale, degree, order));
  return finite_weights(qr.times(weights) / std::pow(scale, order), kWhere);
}

Matrix apply_stencil(const StencilRule& rule, const Vector& time,
                     const Eigen::Ref<const Matrix>& values, Index margin) {
  const Index n = time.size();
  check_rule(rule, n, values.rows(), margin);
  if (n < rule.width)
    throw DataError(rule.name,
                    "needs at least " + std::to_string(rule.width) + " samples and has " +
                        std::to_string(n),
                    "give a longer record or use a shorter stencil");
  Matrix result(n, values.cols());
  const std::optional<double> step = common_step(time);
  const Index border = step ? rule.radius : n;
  if (step) apply_inside(rule, *step, values, result);
  for (Index row = margin; row < n - margin; ++row)
    if (row < border || row >= n - border) apply_own_weights(rule, time, row, values, result);
  return result.middleRows(margin, n - 2 * margin);
}

}  // namespace lacuna
