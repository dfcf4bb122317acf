// SPDX-License-Identifier: MIT
// The search for the best design in a unit cube.
#pragma once

#include <functional>
#include <vector>

#include "input_signals.hpp"
#include "lacuna/core/base/types.hpp"

namespace lacuna {

/// A design and what it is worth.
struct ScoredDesign {
  std::size_t space = 0;  ///< of design_spaces()
  Vector design;
  double score = 0.0;  ///< the larger the better
};

/// Scores designs; made once for each lane of work, so that lanes share nothing.
using Score = std::function<double(std::size_t space, const Vector& design)>;

/// How designs are sought.
struct DesignSearch {
  int candidates = 64;    ///< random ones of each space
  int searches = 4;       ///< of them, the best, that are improved
  int evaluations = 150;  ///< most of each search
};

/// What a search has found.
struct SearchedDesigns {
  std::vector<ScoredDesign> best;  ///< the best first, not empty
  bool in_time = true;             ///< false: those of a search that the deadline ended
};

/// The best designs, the best first: as many as searches. Candidates are seeded: half of them
/// uniform, half of them with most numbers at an end of their range, for many best designs
/// change between ends. The result does not depend on the number of threads.
/// @param sizes of the spaces; @param known designs that are improved beside the candidates.
/// @throws OutOfTime where the deadline passes before a design with a finite score.
SearchedDesigns best_designs(const std::vector<Index>& sizes,
                             const std::function<Score()>& make_score,
                             const std::vector<ScoredDesign>& known, const DesignSearch& search,
                             const RunContext& context);

/// The design with each number in turn at the ends and in the middle of its range, as long as
/// that is better (Meyer and Nachtsheim, Technometrics 37:60-69, 1995).
/// @param evaluations at most so many.
ScoredDesign exchanged(ScoredDesign start, const Score& score, int evaluations);

}  // namespace lacuna
