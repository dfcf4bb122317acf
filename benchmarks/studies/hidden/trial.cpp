// SPDX-License-Identifier: MIT
#include "trial.hpp"

#include <algorithm>
#include <exception>
#include <iostream>
#include <sstream>
#include <utility>

#include "core/base/text.hpp"
#include "hidden/support/reality.hpp"
#include "lacuna/diagnose/diagnose.hpp"
#include "support/parallel.hpp"

namespace lacuna::benchmarks {
namespace {

/// Whether an effect is one of the measurement, which the augmented model does not have.
bool is_of_measurement(const NamedEffect& effect) { return effect.name == "channel-skew"; }

void gauge_trial(const hidden::HiddenCase& hidden, const Diagnosis& diagnosis,
                 const hidden::Records& records, const hidden::Records& clean,
                 Outcome& outcome) {
  outcome.gap = diagnosis.gap->after;
  outcome.floor = diagnosis.gap->noise_floor;
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

/// One line about a trial on standard error.
void report_progress(const Trial& trial, const Outcome& outcome) {
  std::ostringstream line;
  line << trial.hidden.name << ' ' << trial.level << ' ' << flags_of(outcome) << ": "
       << outcome.score.answer << outcome.failure << " (" << outcome.seconds << " s)\n";
  std::cerr << line.str();
}

}  // namespace

Outcome judge(const hidden::HiddenCase& hidden, const hidden::Records& records,
              const hidden::Records& clean, const DiagnosisOptions& options) {
  Outcome outcome;
  const double start = thread_seconds();
  try {
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

Outcome run_trial(const Trial& trial, const DiagnosisOptions& options) {
  const std::uint64_t seed = 2 * trial.seed;
  return judge(
      trial.hidden, hidden::make_records(trial.hidden, trial.level, trial.seed),
      {hidden::clean_record(trial.hidden, seed), hidden::clean_record(trial.hidden, seed + 1)},
      options);
}

std::string name_of(const Trial& trial) {
  return trial.hidden.name + " " + to_string(trial.hidden.noise) + " " +
         format_number(trial.level) + " x " + format_number(trial.strength) + " seed " +
         std::to_string(trial.seed);
}

void add_reported(Cells<Outcome>& cells, const Trial& trial,
                  const std::function<Outcome()>& run, const std::string& ending) {
  cells.add(name_of(trial) + ending, [=] {
    Outcome outcome = run();
    report_progress(trial, outcome);
    return outcome;
  });
}

}  // namespace lacuna::benchmarks
