// SPDX-License-Identifier: MIT
#include "core/base/finite.hpp"

#include <algorithm>
#include <atomic>

#include "core/base/parallel.hpp"
#include "core/numerics/column_kernels.hpp"

namespace lacuna {

bool all_finite(const Eigen::Ref<const Matrix>& values) {
  for (Index column = 0; column < values.cols(); ++column)
    if (!is_finite(values.col(column).data(), values.rows())) return false;
  return true;
}

bool all_finite(const Eigen::Ref<const Matrix>& values, int threads) {
  constexpr Index kRows = Index{1} << 16;  // a fact of cost: what makes up for a thread
  const Index parts = (values.rows() + kRows - 1) / kRows;
  std::atomic<bool> finite{true};
  parallel_for(static_cast<std::size_t>(parts), threads, [&](std::size_t part) {
    const Index first = static_cast<Index>(part) * kRows;
    if (!all_finite(values.middleRows(first, std::min(kRows, values.rows() - first))))
      finite = false;
  });
  return finite;
}

}  // namespace lacuna
