// SPDX-License-Identifier: MIT
#include "diagnose/hypotheses/coloured_noise.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/parallel.hpp"
#include "core/base/text.hpp"
#include "trajectories/smoother/spectral_lines.hpp"
#include "trajectories/smoother/variance_fit.hpp"

namespace lacuna {
namespace {

/// A noise model and its deviance.
struct Tried {
  NoiseModel noise;
  double deviance = 0.0;
};

double mean_step(const Assimilation& fit) {
  const Vector& time = fit.records.front().time;
  return (time[time.size() - 1] - time[0]) / static_cast<double>(time.size() - 1);
}

/// In steps: what is slower is an offset.
/// @param fraction of the record.
double most_steps(const Assimilation& fit, double fraction) {
  return std::max(4.0, fraction * static_cast<double>(fit.records.front().samples()));
}

/// Noise in the place of the disturbances: as large as what these do to a state in the
/// correlation time. They start small, so that it is they who have to prove themselves.
NoiseModel coloured_start(const Assimilation& fit, double time) {
  constexpr double kFractionOfDisturbance = 0.1;  // a fact of the search: a start, no bound
  NoiseModel noise = fit.noise;
  for (std::size_t k = 0; k < noise.coloured.size(); ++k) {
    if (!noise.measurement[k]) continue;
    const double moved = noise.disturbance[static_cast<Index>(k)] * std::sqrt(time);
    noise.coloured[k] = ColouredNoise{std::hypot(*noise.measurement[k], moved), time};
  }
  noise.disturbance *= kFractionOfDisturbance;
  return noise;
}

/// The most likely of fits from several starts.
Tried best_of(const Assimilation& fit, const std::vector<NoiseModel>& starts,
              const RunContext& context) {
  // A fact of the search: enough to rank starts.
  constexpr int kIterations = 12;
  std::vector<Tried> tried(starts.size());
  parallel_for(starts.size(), context.threads, [&](std::size_t i) {
    context.check_stop();
    SmoothedNoise found =
        VarianceFit(fit.least_noise)
            .run({fit.records, fit.measured, fit.omitted}, starts[i], kIterations);
    tried[i] = {std::move(found.noise), found.deviance};
  });
  std::size_t best = 0;
  for (std::size_t i = 1; i < tried.size(); ++i)
    if (tried[i].deviance < tried[best].deviance) best = i;
  return std::move(tried[best]);
}

/// Correlation times from a grid, the same for all channels first, then each by itself;
/// deviations are those of the largest likelihood on the linearisation as it is.
NoiseModel with_coloured_noise(const Assimilation& fit, double fraction,
                               const RunContext& context) {
  constexpr double kRatioOfNeighbours = 3.0;  // on the grid; refined below
  std::vector<NoiseModel> starts;
  for (double steps = kRatioOfNeighbours; steps < most_steps(fit, fraction);
       steps *= kRatioOfNeighbours)
    starts.push_back(coloured_start(fit, steps * mean_step(fit)));
  Tried best = best_of(fit, starts, context);
  for (std::size_t k = 0; k < best.noise.coloured.size(); ++k) {
    if (!best.noise.coloured[k]) continue;
    starts.clear();
    for (const double factor : {1.0 / kRatioOfNeighbours, 1.0 / std::sqrt(kRatioOfNeighbours),
                                std::sqrt(kRatioOfNeighbours), kRatioOfNeighbours}) {
      starts.push_back(best.noise);
      starts.back().coloured[k]->time *= factor;
    }
    Tried next = best_of(fit, starts, context);
    if (next.deviance < best.deviance) best = std::move(next);
  }
  return best.noise;
}

/// The baseline with coloured noise; its nominal coefficients are brought onto the records
/// anew.
Baseline coloured_baseline(const Problem& problem, const Baseline& base,
                           Assimilation coloured) {
  Baseline next = base;
  Assimilation start = base.given;
  start.noise = coloured.noise;
  next.given = assimilate_from(problem.nominal, base.records->data, start,
                               AssimilationOptions{}, problem.context);
  next.parameters += 2.0 * static_cast<double>(coloured.noise.measured());
  next.fitted = std::move(coloured);
  next.scope.lines = spectral_lines(next.fitted, kSpectralLines);
  return next;
}

}  // namespace

double noise_inflation(const NoiseModel& noise, const Assimilation& exact) {
  constexpr double kResolutions = 10.0;  // a fact of arithmetic: less noise is rounding
  const Vector seen = exact.estimated_noise.cwiseMax(kResolutions * exact.least_noise);
  double largest = 0.0;
  for (std::size_t k = 0; k < noise.measurement.size(); ++k) {
    if (!noise.measurement[k]) continue;
    const double slow = noise.coloured[k] ? noise.coloured[k]->deviation : 0.0;
    const double whole = std::hypot(*noise.measurement[k], slow);
    largest = std::max(largest, whole / seen[static_cast<Index>(k)]);
  }
  return largest;
}

Proposals ColouredNoiseHypothesis::do_propose(const Problem& problem,
                                              const CompositeModel& best) const {
  const DecisionOptions& decision = problem.options.decision;
  const bool is_inflated = noise_inflation(best.explanation.fit.noise, best.base->given) >
                           decision.noise_inflation;
  if (best.named.empty() && !is_inflated && !leaves_structure(best, decision)) return {};
  problem.context.report("fitting noise with a memory", 0.0);
  const Assimilation& fitted = best.base->fitted;
  Assimilation start = fitted;
  start.noise = with_coloured_noise(fitted, decision.longest_memory, problem.context);
  Assimilation coloured = assimilate_from(fitted.model, best.base->records->data, start,
                                          best.base->fit_options, problem.context);
  const std::string says = "noise with a memory";
  const double value = problem.options.criterion->value(
      {coloured.deviance,
       static_cast<double>(coloured.free.size()) + best.base->parameters +
           2.0 * static_cast<double>(coloured.noise.measured()),
       static_cast<double>(coloured.used), 0.0});
  const double least = problem.options.criterion->value(evidence_of(best));
  if (!(value < least))
    return {{},
            {{std::string(info().name), says, value, false,
              std::string(problem.options.criterion->info().name), value, least}}};
  auto base = std::make_shared<const Baseline>(
      coloured_baseline(problem, *best.base, std::move(coloured)));
  CompositeModel composite = bare_composite(problem, std::string(info().name), std::move(base));
  composite.findings = best.findings;
  return {{{std::move(composite)}}, {}};
}

double longest_memory(const NoiseModel& noise, double least) {
  double longest = 0.0;
  for (std::size_t k = 0; k < noise.coloured.size(); ++k) {
    const auto& coloured = noise.coloured[k];
    if (coloured && coloured->deviation >= least * noise.measurement[k].value_or(0.0))
      longest = std::max(longest, coloured->time);
  }
  return longest;
}

std::string channels_with_memory(const NoiseModel& noise, const OdeModel& model, double least) {
  std::vector<std::string> channels;
  for (std::size_t k = 0; k < model.states().size(); ++k) {
    const auto& coloured = noise.coloured[k];
    if (!coloured || coloured->deviation < least * *noise.measurement[k]) continue;
    const Quantity& state = model.states()[k];
    channels.push_back(state.name + " " + format_number(coloured->deviation, 2) +
                       (state.unit.empty() ? "" : " " + state.unit) + " over " +
                       format_number(coloured->time, 2) + " " + model.time_unit());
  }
  return join(channels, ", ");
}

}  // namespace lacuna
