// SPDX-License-Identifier: MIT
#pragma once

#include <limits>

#include "trajectories/subset_selection/subset_problem.hpp"
#include "window_search.hpp"

namespace lacuna {

/// Moves of the path below this fraction of sigma do not change any test.
inline constexpr double kSmallMove = 0.3;

/// Where Newton's iteration for one structure ends; more iterations do not help where these do
/// not.
struct NewtonLimits {
  double move = kSmallMove;  ///< of the path, in units of sigma
  int iterations = 4;
};

/// What a choice has changed.
struct Change {
  bool terms = false;
  double path = 0.0;  ///< by how much it moved, in units of sigma; infinite where it has none

  bool is_none() const { return !terms && path < kSmallMove; }
};

/// Whether a path is still on its way. Where windows are so long that chaos makes more of a step
/// than the step mends, its moves go up and down without end.
class Approach {
 public:
  /// @return false where the terms stay and no move was half the least before for two rounds.
  bool goes_on(const Change& change);

 private:
  double least_ = std::numeric_limits<double>::infinity();
  int without_gain_ = 0;
};

/// The columns of a fit that have a coefficient.
std::vector<Index> present_columns(const WindowFit& fit);

/// The problem of a fit's triangle with rows of unit variance.
SubsetProblem problem_of(const WindowFit& fit);

/// Whether a constraint names a coefficient.
bool is_constrained(const WindowSearch& search, const Coefficient& column);

/// Gives a fit the coefficients of its subset. @return them as values of all candidates.
Vector solve_subset(const SubsetProblem& problem, WindowSearch& search);

/// Newton's iteration for the structure as it is: few columns, cheap. @return the last move.
double settle(WindowSearch& search, const NewtonLimits& limits, const RunContext& context);

/// Rounds of converge(): a fact of the search, bounds the work where subsets take turns.
inline constexpr int kRoundsOfChoices = 12;

/// Chooses among all candidates and settles, in turn, until nothing changes.
/// @param rounds at most.
void converge(const SearchTask& task, WindowSearch& search, const RunContext& context,
              int rounds = kRoundsOfChoices);

/// Takes down how well the path fits.
void summarise(WindowSearch& search);

}  // namespace lacuna
