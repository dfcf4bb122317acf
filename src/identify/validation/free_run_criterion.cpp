// SPDX-License-Identifier: MIT
#include "free_run_criterion.hpp"

#include <cmath>

#include "core/statistics/information.hpp"
#include "held_blocks.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/trajectories/fit/fit.hpp"

namespace lacuna {

double free_run_criterion(const OdeModel& model, const Dataset& data, const RunContext& context) {
  constexpr Index kSamples = 10000;  // a bound of the work
  const Dataset records = thinned(data, kSamples);
  try {
    const Fit run = fit(SystemModel(model), records, {},
                        {.restarts = 0, .starts = 0, .effort = Thoroughness::Quick, .rough = true},
                        context);
    return -2.0 * run.log_likelihood +
           parameter_penalty(static_cast<double>(records.samples())) *
               static_cast<double>(run.numbers.size());
  } catch (const DataError&) {
    return INFINITY;
  }
}

}  // namespace lacuna
