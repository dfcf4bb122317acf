// SPDX-License-Identifier: MIT
// Small matrices with their size known to the compiler, where it is one of the usual ones.
#pragma once

#include <Eigen/Core>
#include <type_traits>
#include <utility>

#include "lacuna/core/base/types.hpp"

namespace lacuna {

template <int Size>
using Square = Eigen::Matrix<double, Size, Size>;
template <int Size>
using Column = Eigen::Matrix<double, Size, 1>;

/// Calls `work(std::integral_constant<int, Size>)` with the size, or with Eigen::Dynamic when
/// it is not one of the usual ones.
template <class Work>
decltype(auto) with_size(Index size, Work&& work) {
  switch (size) {
    case 1:
      return work(std::integral_constant<int, 1>{});
    case 2:
      return work(std::integral_constant<int, 2>{});
    case 3:
      return work(std::integral_constant<int, 3>{});
    case 4:
      return work(std::integral_constant<int, 4>{});
    case 5:
      return work(std::integral_constant<int, 5>{});
    case 6:
      return work(std::integral_constant<int, 6>{});
    case 7:
      return work(std::integral_constant<int, 7>{});
    case 8:
      return work(std::integral_constant<int, 8>{});
    default:
      return work(std::integral_constant<int, Eigen::Dynamic>{});
  }
}

}  // namespace lacuna
