// SPDX-License-Identifier: MIT
// Parts compared: the same data through many compositions of stages.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "lacuna/identify/pipeline/pipeline.hpp"

namespace lacuna {

/// One composition of stages, with the names of those that differ.
struct BenchComposition {
  std::vector<std::string> parts;  ///< one for each entry of BenchTask::kinds
  Pipeline pipeline;
};

/// What is to be compared on which data.
struct BenchTask {
  Dataset data = {};                       ///< to which noise is added
  std::optional<OdeModel> truth = {};      ///< where it is known
  std::vector<std::string> kinds = {};     ///< of the parts that differ: "regressor", "filter"
  std::vector<BenchComposition> compositions = {};
  std::vector<double> noise = {0.0};  ///< standard deviations as fractions of each state's own
  int draws = 1;                      ///< noisy copies for each deviation above 0
};

/// One identification compared with the truth and the data.
struct BenchScore {
  std::optional<bool> exact_structure = {};      ///< exactly the true terms in every equation
  std::optional<double> coefficient_error = {};  ///< max |h - h_true| / max |h_true|
  Index terms = 0;                               ///< of all equations
  std::optional<double> sync = {};  ///< relative mean synchronisation error; nothing: diverged
  double seconds = 0.0;        ///< of the identification alone
};

/// All draws of one composition at one noise.
struct BenchCell {
  std::size_t composition = 0;  ///< in BenchTask::compositions
  double noise = 0.0;
  std::vector<BenchScore> scores;
  std::vector<std::string> failures;  ///< of draws that gave no model: what was wrong
  bool done = true;                   ///< false: the deadline came before its last draw
};

/// Cells by composition, then by noise.
struct BenchResult {
  std::vector<std::string> kinds;
  std::vector<std::vector<std::string>> parts;  ///< of each composition
  std::vector<double> noise;
  std::vector<BenchCell> cells;
  bool truth_known = false;

  /// Whether no deadline left out a draw.
  bool complete() const;

  /// The cell of a composition and an entry of `noise`. @throws ArgumentError when there is none.
  const BenchCell& cell(std::size_t composition, std::size_t level) const;
};

/// Medians and fractions over the draws of a cell; nothing where no draw has a number.
struct BenchSummary {
  std::optional<double> exact_rate = {}, coefficient_error = {}, terms = {}, sync = {},
                        seconds = {};
};

/// A sync error of a draw that diverged counts as infinite; failed draws count as not exact.
BenchSummary summary_of(const BenchCell& cell);

/// One identification of noisy data, its model driven by the clean ones (RK4).
/// @throws what identify() throws; ArgumentError when the truth has other states than the data;
///   OutOfTime past the deadline: what it cuts is no score.
BenchScore bench_score(const Pipeline& pipeline, const Dataset& noisy, const Dataset& clean,
                       const std::optional<OdeModel>& truth, const RunContext& context = {});

/// Every composition at every noise. A draw that fails is a line of its cell, and the others go
/// on. Draw d has the seed context.seed + d, the same for all compositions; data without noise
/// have one draw. Progress counts cells.
/// @throws ArgumentError for no compositions, parts that do not fit the kinds, noise that is
///   negative or no draws; DataError as check_dataset(); Cancelled on a stop request; OutOfTime
///   where the deadline passes before the first score, else it leaves draws out.
BenchResult bench(const BenchTask& task, const RunContext& context = {});

}  // namespace lacuna
