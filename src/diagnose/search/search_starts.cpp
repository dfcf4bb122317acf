// SPDX-License-Identifier: MIT
#include "search_starts.hpp"

#include <cmath>

#include "disturbed_alone.hpp"

namespace lacuna {

Assimilation undisturbed(const Problem& problem, const Baseline& base) {
  Assimilation start = base.given;
  start.noise.disturbance.setZero();
  return assimilate_from(problem.nominal, base.records->data, start, base.fit_options,
                         problem.context);
}

std::vector<SearchStart> search_starts(const EffectSearch& search, const Explanation& current) {
  std::vector<SearchStart> starts;
  if (search.base.fit_options.hidden.empty() || !current.effects.empty()) return starts;
  starts.push_back({std::nullopt, undisturbed(search.problem, search.base)});
  for (Index k = 0; k < search.problem.nominal.dimension(); ++k)
    if (current.fit.noise.disturbance[k] > 0.0)
      starts.push_back({k, disturbed_alone(search.problem, search.base, k)});
  std::erase_if(starts,
                [](const SearchStart& one) { return !std::isfinite(one.fit.deviance); });
  return starts;
}

}  // namespace lacuna
