// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/core/base/options.hpp"
#include "lacuna/regression/stages/regressor.hpp"

namespace lacuna {

/// Options of Entropic.
struct EntropicOptions {
  static constexpr StageInfo kInfo{
      "entropic",
      "Forward and backward selection by conditional mutual information: outliers do not lead it.",
      "Almomani, Sun & Bollt, Chaos 30 (2020) 013107; Ince et al., Hum. Brain Mapp. 38 (2017) "
      "1541"};

  int samples = 1000;
  int shuffles = 50;
  double significance = 0.01;
  int max_terms = 50;

  void describe(OptionVisitor& v) {
    v.field({"samples", "", "Rows that terms are chosen from, drawn at random; all of fewer.",
             20.0, 1e6},
            samples);
    v.field({"shuffles", "", "Shuffles of the rows that show what information chance makes.",
             10.0, 1e5},
            shuffles);
    v.field({"significance", "",
             "Probability that one of the terms is taken though none explains anything.",
             1e-300, 1.0},
            significance);
    v.field({"max_terms", "", "Most terms.", 1.0, 1e6}, max_terms);
  }
};

/// Entropic regression. For the terms S that are taken let z_S be their fit to the target y and
/// r_S = y - z_S. The next term is the one that has most information on the target beside the
/// fit,
///
///   max_j I(y; z_{S+j} | z_S) = max_j I(r_S; z_{S+j} - z_S | z_S),
///
/// as long as a shuffle test shows it (chance would make as much with the probability
/// `significance`); then terms j without significant I(y; z_S | z_{S-j}) go, the least first.
/// Differences from the publication: fits minimise the Huber function of the residuals (Irls),
/// not squares, so that outliers do not bend them. Information is that of normal scores, which
/// depends on ranks alone, without their means over ten rows of nearly the same z_S, among which
/// rows are shuffled; a thousand rows cost less than the neighbours of two hundred. The tail
/// of the test is that of chi-squared with one degree of freedom, scaled to the mean of the
/// shuffles, by Bonferroni's bound for all terms that could be next. A constant has no
/// information: the same number of scores of sizes with signs stands for it. Random numbers come
/// from the seed of the run.
class Entropic final : public Configured<Regressor, EntropicOptions> {
 public:
  using Configured::Configured;

 private:
  Regression do_fit(const LeastSquaresSystem& system, const Subproblem& problem, Effort effort,
                    const RunContext& context) const override;
};

}  // namespace lacuna
