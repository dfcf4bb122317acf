// SPDX-License-Identifier: MIT
// The refiners of lacuna. Each function makes one from its options;
// Registry has the same by name.
#pragma once

#include <array>
#include <optional>

#include "lacuna/core/base/options.hpp"
#include "lacuna/core/numerics/negligible.hpp"
#include "lacuna/regression/stages/refiner.hpp"

namespace lacuna {

/// Options of no_refiner(): none.
struct NoRefinerOptions {
  static constexpr StageInfo kInfo{"none", "Leaves the model as the regression gives it", ""};
  void describe(OptionVisitor&) {}
};

/// Leaves the model as it is.
Stage<Refiner> no_refiner(const NoRefinerOptions& options = {});

/// When noise is said to grow with the signal, sqrt(floor^2 + (fraction x)^2), and to weigh
/// samples.
struct GrowingNoise {
  double significance = 5.0;     ///< standard deviations by which growth beats equal noise
  double unit_variance = 1.2;    ///< most rms of differences in units of the noise so described
  double least_fraction = 1e-4;  ///< less of a value is the error of a solver or a digit

  void describe(OptionVisitor& v) {
    v.field({"growth_significance", "standard deviations",
             "By how much noise that grows with the signal has to explain the differences of a "
             "record better than equal noise.",
             0.0},
            significance);
    v.field({"growth_misfit", "",
             "Largest rms of differences in units of growing noise; errors of solvers come in "
             "bursts that no level describes.",
             1.0},
            unit_variance);
    v.field({"least_growth", "",
             "Least fraction of a value that is noise of a measurement; what is less is taken "
             "for the error of a solver or of printed digits.",
             0.0, 1.0},
            least_fraction);
  }
};

/// Options of trajectory_selection().
struct TrajectorySelectionOptions {
  /// Where the search for the structure begins.
  enum class Start {
    Model,    ///< at the model of the stages before
    Nothing,  ///< without a model
  };
  static constexpr StageInfo kInfo{
      "trajectory",
      "Chooses terms and fits coefficients on the trajectories themselves, by windows",
      "Bellman & Kalaba, Quasilinearization (1965); Chen & Chen, Biometrika 95 (2008) 759"};
  static constexpr std::array<std::string_view, 2> kStarts{"model", "nothing"};

  Start start = Start::Nothing;
  bool second_opinion = false;
  std::optional<double> penalty = {};
  double relation_strength = 3.0;
  bool refit = true;
  NegligibleTerms negligible = {};
  GrowingNoise growing_noise = {};

  void describe(OptionVisitor& v) {
    v.field({"start", "",
             "Where the search begins: 'model', at what the stages before found; 'nothing'."},
            kStarts, start);
    v.field({"second_opinion", "",
             "Whether the search is done from nothing too, and terms in dispute are named."},
            second_opinion);
    v.field(
        {"price", "",
         "Decrease of chi squared that a term must bring; ln(rows) + ln(candidates) when not "
         "given (extended information criterion, gamma = 1/2).",
         0.0},
        penalty);
    v.field(
        {"relation_strength", "",
         "Relations of the record whose summands vary by so many times their scatter put off "
         "the terms that they write in lower ones.",
         0.0},
        relation_strength);
    v.field(
        {"refit", "",
         "Whether coefficients of a model that does not fit to the noise are fitted again by "
         "multiple shooting, which does not change how well it fits."},
        refit);
    negligible.describe(v);
    growing_noise.describe(v);
  }
};

/// Structure and coefficients from the trajectories: the sparse regression
///
///   min over S, h, initial states   sum ((y - x(t; h)) / sigma)^2 + penalty |S|
///
/// by quasilinearisation in windows (see the architecture page). Windows begin at the time
/// scale at which the signals sink into their noise and are doubled as long as the fit stays as
/// good as it was and coefficients become better known. In each round all candidates of all
/// equations are columns of one white least-squares problem, in which best_subset() chooses;
/// the path about which it is linearised is then moved to the solution. The noise is estimated
/// from the record; where it cannot be distinguished from the signal it is what the fit leaves.
/// Outliers are left out; short gaps are bridged; states that were not measured (`--embed`)
/// follow from the others. Where a polynomial of the states is constant on the record
/// (find_relations()), as on one orbit of an oscillator, the search is first done without
/// multiples of its highest summands, which are other parametrisations of lower terms, and then
/// in all terms from there. A model that does not fit to the noise and breaks down in longer
/// windows is an approximation, which any term improves a little: terms leave it, the least
/// valuable first, as long as the rms of the residuals grows by no more than a tenth, unless a
/// penalty is given. Terms that are significant and negligible (NegligibleTerms) leave before
/// that. Models that do not fit to the noise are refitted by refine(), unless `refit` is false.
/// Past the deadline the model is that of the longest windows by then. Does nothing with
/// records that bring measured derivatives, nor, starting from a model, with records without
/// noise of which it explains the derivatives to 1e-5 of them.
Stage<Refiner> trajectory_selection(const TrajectorySelectionOptions& options = {});

}  // namespace lacuna
