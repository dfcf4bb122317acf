// SPDX-License-Identifier: MIT
#include "trajectories/sensitivities/linear_step.hpp"

#include "trajectories/sensitivities/fixed_size.hpp"

namespace lacuna {
namespace {

/// left * jacobian; few entries of the Jacobian of many states are not 0.
template <int M, class Jacobian>
Square<M> times(const Square<M>& left, const Jacobian& jacobian) {
  if constexpr (M != Eigen::Dynamic) return left.lazyProduct(jacobian);
  Square<M> result = Square<M>::Zero(left.rows(), left.cols());
  for (Index c = 0; c < result.cols(); ++c)
    for (Index j = 0; j < left.cols(); ++j)
      if (jacobian(j, c) != 0.0) result.col(c) += jacobian(j, c) * left.col(j);
  return result;
}

/// With L_4 = h/6, L_3 = h/3 + h L_4 J_1, L_2 = h/3 + h/2 L_3 J_m, L_1 = h/6 + h/2 L_2 J_m:
/// first = L_1, middle = L_2 + L_3, whole = 1 + L_1 J_0 + (L_2 + L_3) J_m + L_4 J_1.
template <int M>
void compute_maps(const Eigen::Ref<const Matrix>& jacobians, Index m, double h,
                  LinearStep& step) {
  using View = Eigen::Map<const Square<M>>;
  const View j0(jacobians.col(0).data(), m, m), jm(jacobians.col(1).data(), m, m),
      j1(jacobians.col(2).data(), m, m);
  Square<M> third = (h * h / 6.0) * j1;
  third.diagonal().array() += h / 3.0;
  Square<M> second = (0.5 * h) * times<M>(third, jm);
  second.diagonal().array() += h / 3.0;
  Square<M> first = (0.5 * h) * times<M>(second, jm);
  first.diagonal().array() += h / 6.0;
  const Square<M> middle = second + third;
  Square<M> whole = times<M>(first, j0) + times<M>(middle, jm) + (h / 6.0) * j1;
  whole.diagonal().array() += 1.0;
  step.whole = whole;
  step.first = first;
  step.middle = middle;
  step.last = h / 6.0;
}

}  // namespace

void LinearStep::compute(const Eigen::Ref<const Matrix>& jacobians, Index dimension,
                         double length) {
  with_size(dimension, [&](auto size) {
    // g++ 12 warns of the bounds of a matrix of one entry.
    constexpr int kSize = size() == 1 ? Eigen::Dynamic : size();
    compute_maps<kSize>(jacobians, dimension, length, *this);
  });
}

}  // namespace lacuna
