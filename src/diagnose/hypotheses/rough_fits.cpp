// SPDX-License-Identifier: MIT
#include "rough_fits.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "core/base/parallel.hpp"

namespace lacuna {

std::vector<Explanation> rough_fits(const Problem& problem, const Baseline& base,
                                    const std::vector<FitStart>& starts) {
  const RunContext quiet = problem.context.beside_others();
  const Problem each = alone(problem, quiet);
  std::vector<std::optional<Explanation>> fits(starts.size());
  parallel_for(starts.size(), problem.context.threads, [&](std::size_t i) {
    fits[i] = explain_roughly_on(each, base, *starts[i].from, starts[i].effects);
  });
  std::vector<Explanation> found;
  for (std::optional<Explanation>& fit : fits)
    if (std::isfinite(fit->fit.deviance)) found.push_back(*std::move(fit));
  std::stable_sort(found.begin(), found.end(), [&](const auto& a, const auto& b) {
    return criterion_of(problem, base, a) < criterion_of(problem, base, b);
  });
  return found;
}

}  // namespace lacuna
