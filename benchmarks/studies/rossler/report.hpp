// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "cases.hpp"
#include "support/cells.hpp"

namespace lacuna::benchmarks {

/// One fit compared with the truth.
struct Score {
  bool exact_structure = false;    ///< exactly the true terms in every equation
  double coefficient_error = 0.0;  ///< max |h - h_true| / max |h_true|
  std::optional<double> sync;      ///< relative mean synchronisation error; nothing: diverged
  double seconds = 0.0;

  auto fields() { return std::tie(exact_structure, coefficient_error, sync, seconds); }
};

/// All draws of one composition under one condition.
struct Cell {
  const Composition* composition = nullptr;
  Condition condition;
  std::vector<Score> scores;
};

/// Writes rossler.csv (every cell), rossler.md (summary with machine and date), and
/// rossler.gp/.dat/.svg (picture; needs gnuplot).
void write_report(const std::filesystem::path& folder, const std::vector<Cell>& cells,
                  const Origin& origin);

}  // namespace lacuna::benchmarks
