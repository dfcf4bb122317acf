// SPDX-License-Identifier: MIT
#include "core/finite.hpp"

#include <algorithm>
#include <atomic>

#include "lacuna/core/parallel.hpp"

namespace lacuna {

bool all_finite(const Eigen::Ref<const Matrix>& values) {
  return (values.array() * 0.0).sum() == 0.0;
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
