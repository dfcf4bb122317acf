// SPDX-License-Identifier: MIT
// The way from first guesses to the best fit.
#pragma once

#include <functional>
#include <optional>

#include "fit_solver.hpp"
#include "lacuna/trajectories/fit/fit.hpp"
#include "starts/fit_windows.hpp"

namespace lacuna {

/// What a search came to.
struct FitSearch {
  FitMinimum best;
  int starts = 1;    ///< from how many starts it was looked for
  int agreeing = 1;  ///< how many came to the best
  bool in_time = true;  ///< whether no deadline came before the last other start
  bool ran_freely = false;  ///< whether the free run from the given start was fitted, too
  /// Whether filters meet the noise with next to no disturbance and no free run does: the model
  /// is chaotic over so long a record, and other starts come to no more.
  bool departs = false;
  bool met_noise = false;  ///< whether it came to the noise by the steps of the search
  /// Where the model meets the records in windows and no free run does: the windows. Nothing
  /// else is of use then.
  std::optional<FitInWindows> windows = {};
};

/// Minima whose deviances differ by less for each value are taken for one: 1 % of the sum of
/// squares.
constexpr double kAlike = 0.01;

/// How the search is made.
struct FitSearchOptions {
  int restarts = 8;             ///< at most so many other starts
  double spread = 3.0;          ///< by which factor they differ from the first, or its square
  double good = 1.5;            ///< residuals over noise that need no other start
  int most_iterations = 60;     ///< of each minimisation
  std::size_t first_level = 0;  ///< of the falling disturbances, from which it begins
  bool only_given = false;      ///< whether no other start is tried
  /// Whether the minimum of the search does, as it was found; a deadline throws OutOfTime then.
  bool rough = false;
  int range_starts = 0;         ///< at most so many anywhere in the ranges
  bool always_ranges = false;   ///< whether these are tried wherever the first fit ends
  /// A fit in windows of the records, for where the first one leaves more than noise.
  std::function<std::optional<FitInWindows>()> in_windows = {};
};

/// Finds the least sum of squares of a free run.
///
/// A free run from wrong parameters is far from the record, and its sum of squares has many
/// minima. A filter keeps the model on the record: with a large disturbance its errors of
/// prediction are nearly linear in the parameters, with none they are those of the free run.
/// Gains are held while parameters are fitted, and the disturbance is taken away step by step
/// (continuation in the gain of an observer: Ljung, System Identification (1999), Sect. 7.2;
/// Abarbanel et al., SIAM J. Appl. Dyn. Syst. 8:1341, 2009). The free run from the guess itself
/// is tried too, first where the model is stiff; where residuals stay above the noise, numbers
/// from windows of the records, and where these meet the records and no free run does, windows
/// are what is found; then seeded other starts. Past a deadline the best run so far is the
/// answer, its minimum not `in_time` where the fit from the given start was cut.
FitSearch search_fit(FitEngine& engine, const FitUnknowns& unknowns, const FitPoint& start,
                     const FitSearchOptions& options, const RunContext& context);

/// The context for what belongs to an answer whose search a deadline ended: a second more.
RunContext with_last_second(const RunContext& context);

/// Starts over the ranges, as they are asked for; else fewer where each takes long.
int range_starts(const FitEngine& engine, const FitOptions& options);

/// Steps so fine that halving them changes the residuals by little beside their deviations:
/// `small` in all samples together. Implicit steps choose themselves.
/// @return whether steps are others than before.
bool choose_substeps(FitEngine& engine, const FitPoint& point, const Gains& gains,
                     double small);

/// Whether explicit steps were wrong at a minimum, however alike halves of them are: residuals by
/// implicit steps, whose error is controlled, differ by `small` deviations or more in all samples
/// together. Then these are taken from now on, and the path is that by them.
bool check_by_implicit_steps(FitEngine& engine, FitMinimum& minimum, double small);

/// Whether the sizes of some law that are estimated depend on where the model is: those of a law
/// with limits. Without limits the information of location and size is that of independent
/// numbers, exactly or (a deviation b in proportion to the value) to 2 b^2 of it.
bool sizes_move(const FitEngine& engine);

/// Gives the laws of channels their sizes of the largest likelihood, with the degrees of freedom
/// of the fit where sizes do not move. @return the largest change of a logarithm.
double estimate_laws(FitEngine& engine, const FitUnknowns& unknowns, const FitPath& path);

/// Gives channels and laws the sizes that the residuals of a path have. @return the largest change
/// of a logarithm.
double take_sizes(FitEngine& engine, const FitUnknowns& unknowns, const FitPath& path);

/// What minima are compared by: -2 log-likelihood less a constant, with the sizes of the noise that
/// are the best for each. Guesses of the noise, with which they were found, may weigh channels so
/// that the wrong one is lower. Infinite where no run is.
double deviance_of(const FitEngine& engine, const FitUnknowns& unknowns,
                   const FitMinimum& minimum);

/// The minimum where each channel counts by the size of its residuals; laws alike. The engine has
/// these sizes then. Past a deadline it is what it was, or on its way.
FitMinimum reweighted(FitEngine& engine, const FitUnknowns& unknowns, FitMinimum found,
                      const FitSearchOptions& options, const RunContext& context);

/// Root mean square of the residuals of each channel, with degrees of freedom taken evenly.
Vector residual_rms(const FitEngine& engine, const FitUnknowns& unknowns, const FitPath& path);

/// Disturbances for a filter along a path. @param share see Disturbances.
Disturbances disturbances_of(const FitEngine& engine, const FitPath& path, double fraction);

}  // namespace lacuna
