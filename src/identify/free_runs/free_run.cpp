// SPDX-License-Identifier: MIT
#include "free_run.hpp"

#include <algorithm>
#include <vector>

#include "core/statistics/information.hpp"
#include "identify/validation/held_blocks.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/trajectories/fit/fit.hpp"

namespace lacuna {
namespace {

/// Of how many samples of white noise the residuals of a run are worth, all channels together.
double independent_samples(const Fit& run) {
  double squares = 0.0, products = 0.0, count = 0.0;
  for (const FitRun& record : run.runs) {
    const Matrix residual = record.measured - record.model;
    for (Index k = 0; k < residual.cols(); ++k) {
      std::vector<double> values;
      for (const double value : residual.col(k))
        if (std::isfinite(value)) values.push_back(value);
      const double scale = run.quality[static_cast<std::size_t>(k)].rmse;
      if (values.empty() || !(scale > 0.0)) continue;
      count += static_cast<double>(values.size());
      for (std::size_t i = 0; i < values.size(); ++i) {
        squares += values[i] * values[i] / (scale * scale);
        if (i > 0) products += values[i] * values[i - 1] / (scale * scale);
      }
    }
  }
  const double rho = squares > 0.0 ? std::max(0.0, products / squares) : 0.0;
  constexpr double kFewest = 3.0;  // below, ln n is no penalty
  return std::max(kFewest, count * (1.0 - rho) / (1.0 + rho));
}

/// The residual of each channel over its noise, the largest; infinite where one is not known.
double residual_over_noise(const Fit& run) {
  double largest = 0.0;
  for (const FitQuality& channel : run.quality)
    if (channel.samples > 0) largest = std::max(largest, channel.rmse / channel.noise);
  return largest;
}

}  // namespace

FreeRun free_run(const SystemModel& system, const Dataset& data, const KnownNoise& noise,
                 const RunContext& context, bool rough) {
  constexpr Index kSamples = 4000;  // a bound of the work
  constexpr Index kPieces = 4;      // a long record may begin at rest, or with one motion
  const Dataset records = thinned(data, kSamples, kPieces);
  try {
    const Fit run = fit(system, records, {},
                        {.restarts = 0,
                         .starts = 0,
                         .effort = Thoroughness::Quick,
                         .rough = rough,
                         .noise = noise},
                        context);
    FreeRun result{run.model, -2.0 * run.log_likelihood, independent_samples(run),
                   run.numbers.size()};
    for (const FittedParameter& number : run.numbers)
      result.significance.push_back(
          number.standard_error ? std::abs(number.value / *number.standard_error) : 0.0);
    result.samples = static_cast<double>(records.samples());
    result.independent /= result.samples;
    result.over_noise = residual_over_noise(run);
    return result;
  } catch (const DataError&) {
    return {system};
  }
}

bool is_worth(const FreeRun& more, const FreeRun& fewer, double least) {
  if (!fewer.is_finite()) return more.is_finite();
  const double numbers = static_cast<double>(more.numbers) - static_cast<double>(fewer.numbers);
  const double gain = fewer.deviance - more.deviance;
  return fewer.independent * gain >
             parameter_penalty(fewer.independent * fewer.samples) * numbers &&
         gain >= -2.0 * fewer.samples * std::log1p(-least) * numbers;
}

bool is_better(const FreeRun& one, const FreeRun& other, double least) {
  if (one.numbers > other.numbers) return is_worth(one, other, least);
  if (one.numbers < other.numbers) return !is_worth(other, one, least);
  return one.deviance < other.deviance;
}

}  // namespace lacuna
