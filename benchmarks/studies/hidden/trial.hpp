// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "hidden/support/records.hpp"
#include "hidden/support/score.hpp"
#include "lacuna/diagnose/hypotheses/problem.hpp"
#include "support/cells.hpp"

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
  std::optional<double> floor = {};     ///< of noise there, where the gap was measured
  std::optional<double> true_gap = {};  ///< of the true model there, where it can be run
  std::optional<double> real_gap = {};  ///< recomputed from clean data, where it can be
  double seconds = 0.0;                 ///< of one processor
  std::string failure;                  ///< message of an exception; empty when there was none

  auto fields() {
    return std::tie(score.verdict, score.equation, score.name, score.listed, score.spurious,
                    score.size, score.answer, gap, floor, true_gap, real_gap, seconds, failure);
  }
};

/// Diagnoses records and holds the answer against the truth. @param clean the same without
/// noise.
Outcome judge(const hidden::HiddenCase& hidden, const hidden::Records& records,
              const hidden::Records& clean, const DiagnosisOptions& options);

/// Makes the records of a trial, diagnoses them and holds the answer against the truth.
Outcome run_trial(const Trial& trial, const DiagnosisOptions& options);

/// "pendulum-dry-friction white 0.01 x 1 seed 1": all by which trials differ.
std::string name_of(const Trial& trial);

/// Adds a trial as a cell, which is told on standard error when it is run.
/// @param ending of its name, where trials do not differ else.
void add_reported(Cells<Outcome>& cells, const Trial& trial,
                  const std::function<Outcome()>& run, const std::string& ending = "");

}  // namespace lacuna::benchmarks
