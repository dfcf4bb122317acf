// SPDX-License-Identifier: MIT
#include "linear_steps.hpp"

namespace lacuna {
namespace {

/// With L_4 = h/6, L_3 = h/3 + h L_4 J_1, L_2 = h/3 + h/2 L_3 J_m, L_1 = h/6 + h/2 L_2 J_m:
/// first = L_1, middle = L_2 + L_3, whole = 1 + L_1 J_0 + (L_2 + L_3) J_m + L_4 J_1.
template <int M>
void compute_maps(const Eigen::Ref<const Matrix>& jacobians, Index m, double h,
                  LinearStep& step) {
  using Square = Eigen::Matrix<double, M, M>;
  using View = Eigen::Map<const Square>;
  const View j0(jacobians.col(0).data(), m, m), jm(jacobians.col(1).data(), m, m),
      j1(jacobians.col(2).data(), m, m);
  Square third = (h * h / 6.0) * j1;
  third.diagonal().array() += h / 3.0;
  Square second = (0.5 * h) * third.lazyProduct(jm);
  second.diagonal().array() += h / 3.0;
  Square first = (0.5 * h) * second.lazyProduct(jm);
  first.diagonal().array() += h / 6.0;
  const Square middle = second + third;
  Square whole = first.lazyProduct(j0) + middle.lazyProduct(jm) + (h / 6.0) * j1;
  whole.diagonal().array() += 1.0;
  step.whole = whole;
  step.first = first;
  step.middle = middle;
  step.last = h / 6.0;
}

}  // namespace

void LinearStep::compute(const Eigen::Ref<const Matrix>& jacobians, Index dimension,
                         double length) {
  switch (dimension) {
    case 2:
      return compute_maps<2>(jacobians, dimension, length, *this);
    case 3:
      return compute_maps<3>(jacobians, dimension, length, *this);
    case 4:
      return compute_maps<4>(jacobians, dimension, length, *this);
    default:
      return compute_maps<Eigen::Dynamic>(jacobians, dimension, length, *this);
  }
}

}  // namespace lacuna
