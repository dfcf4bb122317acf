// SPDX-License-Identifier: MIT
#include "dynamics/attractor/density_distance.hpp"

#include <cmath>
#include <map>
#include <vector>

#include "core/base/check.hpp"

namespace lacuna {
namespace {

using Cell = std::vector<long>;
using Histogram = std::map<Cell, double>;

/// Edge lengths of a cell; 1 for a state that does not move.
Vector cell_edges(const Matrix& a, const Matrix& b) {
  const double n = static_cast<double>(a.rows() + b.rows());
  const double shorter = static_cast<double>(std::min(a.rows(), b.rows()));
  const double fraction =
      3.49 * std::pow(shorter, -1.0 / (static_cast<double>(a.cols()) + 2.0));
  Vector edges(a.cols());
  for (Index k = 0; k < a.cols(); ++k) {
    const double mean = (a.col(k).sum() + b.col(k).sum()) / n;
    const double squares =
        (a.col(k).array() - mean).square().sum() + (b.col(k).array() - mean).square().sum();
    edges[k] = squares > 0.0 ? fraction * std::sqrt(squares / n) : 1.0;
  }
  return edges;
}

/// Fraction of the samples in each cell.
Histogram histogram(const Matrix& points, const Vector& edges) {
  Histogram fractions;
  const double weight = 1.0 / static_cast<double>(points.rows());
  Cell cell(static_cast<std::size_t>(points.cols()));
  for (Index i = 0; i < points.rows(); ++i) {
    for (Index k = 0; k < points.cols(); ++k)
      cell[static_cast<std::size_t>(k)] = std::lround(std::floor(points(i, k) / edges[k]));
    fractions[cell] += weight;
  }
  return fractions;
}

}  // namespace

double density_distance(const Matrix& a, const Matrix& b) {
  if (a.cols() != b.cols() || a.rows() == 0 || b.rows() == 0)
    throw ArgumentError("density_distance", "the records differ in states or are empty", "");
  check_argument(a.allFinite() && b.allFinite(), "density_distance", "a sample is not finite");
  const Vector edges = cell_edges(a, b);
  check_argument(edges.allFinite(), "density_distance",
                 "the samples are too large to be squared", "use larger units");
  const Histogram p = histogram(a, edges);
  const Histogram q = histogram(b, edges);
  double overlap = 0.0;
  for (const auto& [cell, fraction] : p)
    if (const auto other = q.find(cell); other != q.end())
      overlap += std::sqrt(fraction * other->second);
  return std::sqrt(std::max(0.0, 1.0 - overlap));
}

}  // namespace lacuna
