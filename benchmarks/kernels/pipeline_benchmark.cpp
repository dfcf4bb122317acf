// SPDX-License-Identifier: MIT
// Algorithm 1 whole, from a dataset to a model: Rossler, n = 1e4, degree 3 (20 terms). The
// stages of the paper, without refinement.
#include <benchmark/benchmark.h>

#include <utility>

#include "lacuna/identify/pipeline/presets.hpp"
#include "lacuna/trajectories/refiners.hpp"
#include "support/rossler_data.hpp"

namespace lacuna {
namespace {

Dataset rossler_record(bool with_derivatives) {
  testing::RosslerData data = testing::make_rossler_data(10000, 0.1);
  Dataset record;
  record.states = {{"x", ""}, {"y", ""}, {"z", ""}};
  Matrix derivatives = with_derivatives ? data.derivatives : Matrix();
  record.trajectories.push_back(
      {"rossler", data.time, data.states, Matrix(data.time.size(), 0), std::move(derivatives)});
  return record;
}

void algorithm1_on(benchmark::State& state, bool with_derivatives) {
  const Dataset record = rossler_record(with_derivatives);
  Pipeline pipeline = algorithm1();
  pipeline.refiner = no_refiner();
  for (auto _ : state) benchmark::DoNotOptimize(identify(record, pipeline).fit.size());
}

BENCHMARK_CAPTURE(algorithm1_on, exact_derivatives, true)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(algorithm1_on, differences, false)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace lacuna
