// SPDX-License-Identifier: MIT
#include "hypotheses/coloured_noise.hpp"

#include <algorithm>
#include <cmath>

#include "lacuna/core/parallel.hpp"
#include "lacuna/core/text.hpp"
#include "lacuna/estimation/variance_fit.hpp"

namespace lacuna {
namespace {

/// A noise model and its deviance.
struct Tried {
  NoiseModel noise;
  double deviance = 0.0;
};

class ColouredFit {
 public:
  ColouredFit(const Assimilation& fit, const RunContext& context)
      : fit_(fit), context_(context) {}

  NoiseModel run() const {
    std::vector<NoiseModel> starts;
    for (double steps = 3.0; steps < longest(); steps *= 3.0)
      starts.push_back(common(steps * step()));
    Tried best = best_of(starts);
    for (std::size_t k = 0; k < best.noise.coloured.size(); ++k) {
      if (!best.noise.coloured[k]) continue;
      starts.clear();
      for (const double factor : {1.0 / 3.0, 1.0 / std::sqrt(3.0), std::sqrt(3.0), 3.0}) {
        starts.push_back(best.noise);
        starts.back().coloured[k]->time *= factor;
      }
      Tried next = best_of(starts);
      if (next.deviance < best.deviance) best = std::move(next);
    }
    return best.noise;
  }

 private:
  double step() const {
    const Vector& time = fit_.records.front().time;
    return (time[time.size() - 1] - time[0]) / static_cast<double>(time.size() - 1);
  }

  /// A third of the record, in steps: what is slower is an offset.
  double longest() const {
    return std::max(4.0, static_cast<double>(fit_.records.front().samples()) / 3.0);
  }

  /// Noise in the place of the disturbances: as large as what these do to a state in the
  /// correlation time. They start small, so that it is they who have to prove themselves.
  NoiseModel common(double time) const {
    NoiseModel noise = fit_.noise;
    for (std::size_t k = 0; k < noise.coloured.size(); ++k) {
      if (!noise.measurement[k]) continue;
      const double moved = noise.disturbance[static_cast<Index>(k)] * std::sqrt(time);
      noise.coloured[k] = ColouredNoise{std::hypot(*noise.measurement[k], moved), time};
    }
    noise.disturbance *= 0.1;
    return noise;
  }

  Tried best_of(const std::vector<NoiseModel>& starts) const {
    constexpr int kIterations = 12;
    std::vector<Tried> tried(starts.size());
    parallel_for(starts.size(), context_.threads, [&](std::size_t i) {
      context_.check_stop();
      SmoothedNoise found =
          VarianceFit(fit_.least_noise)
              .run({fit_.records, fit_.measured, fit_.omitted}, starts[i], kIterations);
      tried[i] = {std::move(found.noise), found.deviance};
    });
    std::size_t best = 0;
    for (std::size_t i = 1; i < tried.size(); ++i)
      if (tried[i].deviance < tried[best].deviance) best = i;
    return std::move(tried[best]);
  }

  const Assimilation& fit_;
  const RunContext& context_;
};

}  // namespace

NoiseModel with_coloured_noise(const Assimilation& fit, const RunContext& context) {
  return ColouredFit(fit, context).run();
}

std::string channels_with_memory(const NoiseModel& noise, const OdeModel& model) {
  constexpr double kOfWhite = 0.1;
  std::vector<std::string> channels;
  for (std::size_t k = 0; k < model.states().size(); ++k) {
    const auto& coloured = noise.coloured[k];
    if (!coloured || coloured->deviation < kOfWhite * *noise.measurement[k]) continue;
    const Quantity& state = model.states()[k];
    channels.push_back(state.name + " " + format_number(coloured->deviation, 2) +
                       (state.unit.empty() ? "" : " " + state.unit) + " over " +
                       format_number(coloured->time, 2) + " " + model.time_unit());
  }
  return join(channels, ", ");
}

}  // namespace lacuna
