// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "hidden/support/records.hpp"
#include "hidden/support/score.hpp"
#include "lacuna/hypotheses/problem.hpp"

namespace lacuna::benchmarks {

/// One diagnosis that is to be made.
struct Trial {
  hidden::HiddenCase hidden;
  double strength = 1.0;
  double level = 0.01;  ///< of the noise, relative to the states
  std::uint64_t seed = 1;
};

/// What came of it.
struct Outcome {
  hidden::Score score;
  double gap = 0.0;                     ///< after, on the record that was held out
  std::optional<double> true_gap = {};  ///< of the true model there, where it can be run
  std::optional<double> real_gap = {};  ///< recomputed from clean data, where it can be
  double seconds = 0.0;                 ///< of one processor
  std::string failure;                  ///< message of an exception; empty when there was none
};

/// Diagnoses records and holds the answer against the truth. @param clean the same without
/// noise.
Outcome judge(const hidden::HiddenCase& hidden, const hidden::Records& records,
              const hidden::Records& clean, const DiagnosisOptions& options);

/// Makes the records of a trial, diagnoses them and holds the answer against the truth.
Outcome run_trial(const Trial& trial, const DiagnosisOptions& options);

/// One line about a trial on standard error.
void report_progress(const Trial& trial, const Outcome& outcome);

/// All trials, spread over the processor's cores; outcomes in the order of the trials. Progress
/// goes to standard error.
std::vector<Outcome> run_trials(const std::vector<Trial>& trials,
                                const DiagnosisOptions& options);

}  // namespace lacuna::benchmarks
