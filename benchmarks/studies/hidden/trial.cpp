// SPDX-License-Identifier: MIT
#include "trial.hpp"

#include <atomic>
#include <chrono>
#include <exception>
#include <iostream>
#include <thread>

#include "hidden/support/records.hpp"
#include "lacuna/discrepancy/diagnose.hpp"

namespace lacuna::benchmarks {
namespace {

std::vector<Stage<Effect>> all_effects(const Registry& registry) {
  std::vector<Stage<Effect>> effects;
  for (const std::string& name : registry.names(Effect::kKind))
    effects.push_back(registry.make<Effect>(name));
  return effects;
}

}  // namespace

Outcome run_trial(const Trial& trial, const Registry& registry) {
  Outcome outcome;
  const auto start = std::chrono::steady_clock::now();
  try {
    const auto [find, check] = hidden::make_records(trial.hidden, trial.level, trial.seed);
    DiagnosisOptions options;
    options.effects = all_effects(registry);
    const Diagnosis diagnosis =
        diagnose(trial.hidden.nominal, find, check, options, RunContext{});
    const Dataset clean = hidden::clean_record(trial.hidden, 2 * trial.seed);
    outcome.score = hidden::score(trial.hidden, diagnosis, clean);
    if (diagnosis.gap) outcome.gap = diagnosis.gap->after;
  } catch (const std::exception& error) {
    outcome.failure = error.what();
  }
  const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
  outcome.seconds = time.count();
  return outcome;
}

std::vector<Outcome> run_trials(const std::vector<Trial>& trials, const Registry& registry) {
  std::vector<Outcome> outcomes(trials.size());
  std::atomic<std::size_t> next{0};
  const auto work = [&] {
    for (std::size_t i = next++; i < trials.size(); i = next++) {
      outcomes[i] = run_trial(trials[i], registry);
      std::cerr << i + 1 << '/' << trials.size() << ' ' << trials[i].hidden.name << ' '
                << trials[i].level << ": " << outcomes[i].score.answer << outcomes[i].failure
                << " (" << outcomes[i].seconds << " s)\n";
    }
  };
  std::vector<std::jthread> threads;
  for (unsigned k = 0; k < std::max(1u, std::thread::hardware_concurrency()); ++k)
    threads.emplace_back(work);
  threads.clear();  // joins
  return outcomes;
}

}  // namespace lacuna::benchmarks
