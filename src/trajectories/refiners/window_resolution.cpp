// SPDX-License-Identifier: MIT
#include "window_resolution.hpp"

#include <algorithm>
#include <limits>

#include "core/base/parallel.hpp"
#include "data/records/state_statistics.hpp"
#include "window_iterations.hpp"

namespace lacuna {
namespace {

/// A fact: an error of a tenth of the noise is a hundredth of its square.
constexpr double kTruncationOverNoise = 0.1;

bool is_known(const SearchTask& task, Index state) {
  return task.noise[static_cast<std::size_t>(state)].kind != NoiseKind::None;
}

void scale_sigma(WindowSearch& search, const Vector& factors) {
  rescale(search.path, factors);
  search.sigma = search.sigma.cwiseProduct(factors);
}

/// Noise that is not known is taken to be no less than what the integration resolves.
void raise_floor(const SearchTask& task, WindowSearch& search, double factor) {
  if (!(factor > 1.0)) return;
  Vector factors = Vector::Ones(search.sigma.size());
  for (Index k = 0; k < factors.size(); ++k)
    if (!is_known(task, k)) factors[k] = factor;
  scale_sigma(search, factors);
  search.floor = search.floor.cwiseMax(search.sigma);
}

void set_substeps(const SearchTask& task, WindowSearch& search, Index substeps, int threads) {
  std::vector<PathRecord>& records = search.path.records;
  parallel_for(records.size(), threads, [&](std::size_t r) {
    set_substeps(records[r], substeps, task.equations.program);
  });
}

}  // namespace

Vector rounding_floor(const Dataset& data) {
  constexpr double kRounding = 1e-7;  // fraction of a state's spread
  return kRounding * state_spans(data).cwiseMax(1e-300);
}

bool learn_noise(const SearchTask& task, WindowSearch& search) {
  Vector factors = Vector::Ones(search.sigma.size());
  for (Index k = 0; k < factors.size(); ++k)
    if (!is_known(task, k))
      factors[k] =
          std::clamp(search.fit.rms[k], search.floor[k], search.sigma[k]) / search.sigma[k];
  scale_sigma(search, factors);
  return factors.minCoeff() < 0.5;
}

bool asks_for_a_step_test(const WindowSearch& search) {
  // A decision (docs/decisions/numbers.md).
  constexpr double kPassedByFar = 0.1;
  return search.steps.samples != search.fit.samples &&
         search.steps.moved > kPassedByFar * kTruncationOverNoise;
}

bool refine_steps(const SearchTask& task, WindowSearch& search, const RunContext& context) {
  // A fact of cost.
  constexpr Index kMostSubsteps = 8;
  // A fact: fourth order gives 1/16; where terms jump nothing is gained.
  constexpr double kMovedAgain = 0.25;
  const Index before = search.path.substeps();
  double last = std::numeric_limits<double>::infinity();
  while (search.path.substeps() < kMostSubsteps) {
    const Index coarse = search.path.substeps();
    set_substeps(task, search, 2 * coarse, context.threads);
    const double moved = settle(search, {.move = 0.0, .iterations = 1}, context);
    const bool gains = moved < kMovedAgain * last;
    last = moved;
    if (moved > kTruncationOverNoise && gains) continue;
    set_substeps(task, search, gains ? coarse : before, context.threads);
    settle(search, {.iterations = 1}, context);
    break;
  }
  search.steps = {last, search.fit.samples};
  // The finest steps leave a fifteenth of what the last halving moved.
  if (search.path.substeps() == kMostSubsteps && before < kMostSubsteps)
    raise_floor(task, search, last / 15.0 / kTruncationOverNoise);
  return search.path.substeps() > before;
}

}  // namespace lacuna
