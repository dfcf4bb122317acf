// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <optional>

#include "lacuna/core/base/options.hpp"
#include "lacuna/core/numerics/negligible.hpp"
#include "lacuna/regression/stages/refiner.hpp"
#include "lacuna/trajectories/refiners/growing_noise.hpp"

namespace lacuna {

/// Options of TrajectorySelection.
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
    v.field({"refit", "",
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
class TrajectorySelection final : public Configured<Refiner, TrajectorySelectionOptions> {
 public:
  using Configured::Configured;

 private:
  RefinedModel do_refine(const RefinerTask& task, const RunContext& context) const override;
};

}  // namespace lacuna
