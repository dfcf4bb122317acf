// SPDX-License-Identifier: MIT
#include "data/derivatives/uniform_spline.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/base/check.hpp"

namespace lacuna {
namespace {

using SplineTriplets = std::vector<Eigen::Triplet<double, Index>>;

/// The degree + 1 functions at u in [0, 1] of their interval, intervals of length 1: Cox's
/// recursion.
Vector values_in_interval(double u, int degree) {
  Vector values = Vector::Zero(degree + 1);
  values[0] = 1.0;
  for (int d = 1; d <= degree; ++d) {
    double saved = 0.0;
    for (int r = 0; r < d; ++r) {
      const double part = values[r] / static_cast<double>(d);
      values[r] = saved + (static_cast<double>(r + 1) - u) * part;
      saved = (u + static_cast<double>(d - 1 - r)) * part;
    }
    values[d] = saved;
  }
  return values;
}

/// Their k-th derivatives: differences of functions of degree p - k.
Vector derivatives_in_interval(double u, int degree, int order) {
  Vector result = Vector::Zero(degree + 1);
  if (order > degree) return result;
  result.head(degree - order + 1) = values_in_interval(u, degree - order);
  for (int k = 1; k <= order; ++k)
    for (int j = degree - order + k; j >= 0; --j)
      result[j] = (j > 0 ? result[j - 1] : 0.0) - result[j];
  return result;
}

}  // namespace

UniformSpline spline_over(const Vector& time, int degree) {
  check_argument(degree >= 1 && time.size() >= 2, "spline_over", "there are no two times");
  check_times(time, 2, "spline_over");
  const Index intervals = time.size() - 1;
  const double length = time[intervals] - time[0];
  return {time[0], length / static_cast<double>(intervals), intervals, degree};
}

SparseRows spline_rows(const UniformSpline& spline, const Vector& time, int order) {
  check_argument(order >= 0 && spline.spacing > 0.0 && spline.intervals > 0, "spline_rows",
                 "the order is negative or the spline has no intervals");
  const double scale = std::pow(spline.spacing, -order);
  SplineTriplets entries;
  for (Index i = 0; i < time.size(); ++i) {
    const double place = (time[i] - spline.first) / spline.spacing;
    const Index interval =
        std::clamp(static_cast<Index>(std::floor(place)), Index{0}, spline.intervals - 1);
    const Vector row = derivatives_in_interval(place - static_cast<double>(interval),
                                               spline.degree, order);
    for (Index j = 0; j < row.size(); ++j)
      entries.emplace_back(i, interval + j, scale * row[j]);
  }
  SparseRows rows(time.size(), spline.functions());
  rows.setFromTriplets(entries.begin(), entries.end());
  return rows;
}

SparseRows spline_penalty(const UniformSpline& spline, int order) {
  check_argument(order >= 0 && order <= spline.degree, "spline_penalty",
                 "the spline has no derivative of that order");
  // Four Gauss points integrate squares of cubic pieces exactly.
  constexpr double kPoints[4] = {0.06943184420297371, 0.33000947820757187, 0.6699905217924281,
                                 0.9305681557970262};
  constexpr double kWeights[4] = {0.17392742256872692, 0.32607257743127305, 0.32607257743127305,
                                  0.17392742256872692};
  check_argument(spline.degree - order <= 3, "spline_penalty",
                 "the derivative has pieces of more than the third degree");
  Matrix block = Matrix::Zero(spline.degree + 1, spline.degree + 1);
  for (int g = 0; g < 4; ++g) {
    const Vector row = derivatives_in_interval(kPoints[g], spline.degree, order);
    block += kWeights[g] * row * row.transpose();
  }
  block *= std::pow(spline.spacing, 1 - 2 * order);
  SplineTriplets entries;
  for (Index interval = 0; interval < spline.intervals; ++interval)
    for (Index a = 0; a < block.rows(); ++a)
      for (Index b = 0; b < block.cols(); ++b)
        entries.emplace_back(interval + a, interval + b, block(a, b));
  SparseRows penalty(spline.functions(), spline.functions());
  penalty.setFromTriplets(entries.begin(), entries.end());
  return penalty;
}

}  // namespace lacuna
