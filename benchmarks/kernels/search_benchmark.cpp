// SPDX-License-Identifier: MIT
// The search for shape parameters by NLopt beside the own method: profiles of one to three
// parameters from many starts. "evaluations" and "missed" (value above the least one) are means
// over the searches.
#include <benchmark/benchmark.h>

#include <cmath>

#include "core/base/random.hpp"
#include "forms/candidate/shape_search.hpp"

namespace lacuna {
namespace {

using Search = Vector (*)(FunctionRef<double(const Vector&)>, const Vector&,
                          const SimplexSettings&);

void shapes(benchmark::State& state, Search search, double power) {
  const auto size = static_cast<Index>(state.range(0));
  const SimplexSettings settings{
      .reach = 0.05, .unnoticed = 0.01, .evaluations = static_cast<int>(40 * size)};
  Random random(1);
  double evaluations = 0.0, missed = 0.0, searches = 0.0;
  for (auto _ : state) {
    Vector centre(size), start(size);
    Matrix curvature(size, size);
    for (double& value : centre) value = 0.1 + 0.8 * random.uniform();
    for (double& value : start) value = random.uniform();
    for (double& value : curvature.reshaped()) value = random.normal();
    const auto profile = [&](const Vector& at) {
      evaluations += 1.0;
      return 1e3 * (curvature * (at - centre)).array().abs().pow(power).sum();
    };
    const Vector found = search(profile, start, settings);
    missed += profile(found);
    searches += 1.0;
  }
  state.counters["evaluations"] = evaluations / searches - 1.0;
  state.counters["missed"] = missed / searches;
}

BENCHMARK_CAPTURE(shapes, own_smooth, nelder_mead, 2.0)->Arg(1)->Arg(2)->Arg(3);
BENCHMARK_CAPTURE(shapes, search_smooth, least_in_cube, 2.0)->Arg(1)->Arg(2)->Arg(3);
BENCHMARK_CAPTURE(shapes, own_bent, nelder_mead, 1.0)->Arg(1)->Arg(2)->Arg(3);
BENCHMARK_CAPTURE(shapes, search_bent, least_in_cube, 1.0)->Arg(1)->Arg(2)->Arg(3);

}  // namespace
}  // namespace lacuna
