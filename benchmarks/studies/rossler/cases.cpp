// SPDX-License-Identifier: MIT
#include "cases.hpp"

#include "cli/configuration/variants.hpp"
#include "lacuna/bases/bases.hpp"
#include "lacuna/dynamics/integration/integrators.hpp"
#include "lacuna/dynamics/integration/simulate.hpp"
#include "lacuna/dynamics/test_systems/test_systems.hpp"
#include "lacuna/identify/bench/bench.hpp"
#include "lacuna/trajectories/refiners.hpp"

namespace lacuna::benchmarks {
namespace {

constexpr double kStep = 0.05;  // Rossler time units; an orbit takes about 6

template <class Interface>
struct Named {
  std::string label;
  Stage<Interface> stage;
};

template <class Interface>
std::vector<Named<Interface>> available(const Registry& registry) {
  std::vector<Named<Interface>> stages;
  for (const StageVariant& variant : variants(registry, Interface::kKind))
    if (variant.unavailable.empty())
      stages.push_back(
          {variant.label,
           Stage<Interface>(std::dynamic_pointer_cast<const Interface>(variant.stage))});
  return stages;
}

}  // namespace

std::vector<Composition> all_compositions(const Registry& registry) {
  const auto formulations = available<Formulation>(registry);
  std::vector<Composition> all;
  const auto compose = [&](const std::string& derivative,
                           const Stage<Formulation>& formulation) {
    for (const auto& filter : available<TermFilter>(registry))
      for (const auto& regressor : available<Regressor>(registry))
        for (const auto& pruner : available<TermPruner>(registry))
          all.push_back({filter.label, regressor.label, pruner.label, derivative,
                         Pipeline{.basis = monomials({.max_degree = 3}),
                                  .formulation = formulation,
                                  .filter = filter.stage,
                                  .regressor = regressor.stage,
                                  .pruner = pruner.stage,
                                  .refiner = no_refiner()}});
  };
  compose("exact", formulations.front().stage);
  for (const auto& formulation : formulations)
    if (formulation.stage->evolution() == Evolution::Flow)
      compose(formulation.label, formulation.stage);
  return all;
}

std::vector<Condition> all_conditions() {
  return {{1000, 0.0, 1}, {1000, 0.001, 3}, {1000, 0.01, 3},
          {4000, 0.0, 1}, {4000, 0.001, 1}, {4000, 0.01, 1}};
}

Dataset noisy_record(const Condition& condition, std::uint64_t seed) {
  const TestSystem& rossler = test_system("rossler");
  const Vector times = sample_times(0.0, kStep, condition.samples);
  const Solution orbit = simulate(rossler.model, dopri87(), rossler.start, times);

  Trajectory trajectory{"rossler", times, orbit.states, Matrix(times.size(), 0), orbit.states};
  CompiledModel model = rossler.model.compile();
  for (Index i = 0; i < times.size(); ++i) {
    const Vector x = orbit.states.row(i);
    Vector rate(x.size());
    model.evaluate(times[i], x.data(), nullptr, nullptr, rate.data());
    trajectory.derivatives.row(i) = rate;
  }
  Dataset record;
  record.states = rossler.model.states();
  record.trajectories.push_back(std::move(trajectory));
  return add_relative_noise(record, condition.noise, seed, NoisyRates::Kept);
}

Dataset without_derivatives(Dataset record) {
  for (Trajectory& trajectory : record.trajectories) trajectory.derivatives.resize(0, 0);
  return record;
}

}  // namespace lacuna::benchmarks
