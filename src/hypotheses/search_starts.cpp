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
  const Problem& problem = search.problem;
  if (search.base.fit_options.hidden.empty() || !current.effects.empty()) return starts;
  if (search.along) {
    starts.push_back(
        {std::nullopt, without_effects({search.base.records->data, problem.nominal,
                                        search.base.fit_options, problem.context},
                                       search.along->fit)});
  } else {
    starts.push_back({std::nullopt, undisturbed(problem, search.base)});
    for (Index k = 0; k < problem.nominal.dimension(); ++k)
      if (current.fit.noise.disturbance[k] > 0.0)
        starts.push_back({k, disturbed_alone(problem, search.base, k)});
  }
  std::erase_if(starts,
                [](const SearchStart& one) { return !std::isfinite(one.fit.deviance); });
  return starts;
}

}  // namespace lacuna
