// SPDX-License-Identifier: MIT
#include "trial.hpp"

#include <algorithm>
#include <exception>
#include <iostream>
#include <sstream>
#include <utility>

#include "hidden/support/reality.hpp"
#include "lacuna/core/text.hpp"
#include "lacuna/diagnosis/diagnose.hpp"
#include "support/parallel.hpp"

namespace lacuna::benchmarks {
namespace {

/// Whether an effect is one of the measurement, which the augmented model does not have.
bool is_of_measurement(const NamedEffect& effect) { return effect.name == "channel-skew"; }

void gauge_trial(const hidden::HiddenCase& hidden, const Diagnosis& diagnosis,
                 const hidden::Records& records, const hidden::Records& clean,
                 Outcome& outcome) {
  outcome.gap = diagnosis.gap->after;
  outcome.true_gap = hidden::true_gap(hidden, records.check);
  if (std::none_of(diagnosis.effects.begin(), diagnosis.effects.end(), is_of_measurement))
    outcome.real_gap =
        hidden::real_gap(diagnosis.augmented, clean.check, records.check, *diagnosis.gap);
}

std::string flags_of(const Outcome& outcome) {
  const hidden::Score& score = outcome.score;
  std::string flags;
  for (const auto& [letter, right] : {std::pair{'V', score.verdict},
                                      {'E', score.equation},
                                      {'N', score.name},
                                      {'L', score.listed}})
    flags += right ? letter : '-';
  return flags + (score.size ? " size " + format_number(*score.size, 3) : "");
}

}  // namespace

Outcome judge(const hidden::HiddenCase& hidden, const hidden::Records& records,
              const hidden::Records& clean, const Registry& registry) {
  Outcome outcome;
  const double start = thread_seconds();
  try {
    DiagnosisOptions options;
    options.effects = registry.make_all<Effect>();
    const Diagnosis diagnosis =
        diagnose(hidden.nominal, records.find, records.check, options, RunContext{});
    outcome.score = hidden::score(hidden, diagnosis, clean.find);
    if (diagnosis.gap) gauge_trial(hidden, diagnosis, records, clean, outcome);
  } catch (const std::exception& error) {
    outcome.failure = error.what();
  }
  outcome.seconds = thread_seconds() - start;
  return outcome;
}

Outcome run_trial(const Trial& trial, const Registry& registry) {
  const std::uint64_t seed = 2 * trial.seed;
  return judge(
      trial.hidden, hidden::make_records(trial.hidden, trial.level, trial.seed),
      {hidden::clean_record(trial.hidden, seed), hidden::clean_record(trial.hidden, seed + 1)},
      registry);
}

void report_progress(const Trial& trial, const Outcome& outcome) {
  std::ostringstream line;
  line << trial.hidden.name << ' ' << trial.level << ' ' << flags_of(outcome) << ": "
       << outcome.score.answer << outcome.failure << " (" << outcome.seconds << " s)\n";
  std::cerr << line.str();
}

std::vector<Outcome> run_trials(const std::vector<Trial>& trials, const Registry& registry) {
  std::vector<Outcome> outcomes(trials.size());
  for_all(trials.size(), [&](std::size_t i) {
    outcomes[i] = run_trial(trials[i], registry);
    report_progress(trials[i], outcomes[i]);
  });
  return outcomes;
}

}  // namespace lacuna::benchmarks
