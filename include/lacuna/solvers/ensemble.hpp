// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/core/base/options.hpp"
#include "lacuna/regression/stages/regressor.hpp"

namespace lacuna {

/// Options of Ensemble.
struct EnsembleOptions {
  static constexpr StageInfo kInfo{
      "ensemble", "Thresholded least squares on many resamples; terms that most of them keep.",
      "Fasel, Kutz, Brunton & Brunton, Proc. R. Soc. A 478 (2022) 20210904; Breiman, Machine "
      "Learning 24 (1996) 123; Kuensch, Ann. Statist. 17 (1989) 1217"};

  int bags = 50;
  int blocks = 20;
  int left_out = 0;
  double threshold = 0.01;
  double inclusion = 0.6;

  void describe(OptionVisitor& v) {
    v.field({"bags", "", "Resamples.", 1.0, 1e6}, bags);
    v.field({"blocks", "",
             "Blocks of successive rows that are drawn with replacement; rows near each other "
             "are alike.",
             2.0, 1e6},
            blocks);
    v.field(
        {"left_out", "", "Terms that each resample does not offer, drawn at random.", 0.0, 1e6},
        left_out);
    v.field({"threshold", "", "|h_j theta_j| / |y| below which a resample drops a term.", 0.0},
            threshold);
    v.field({"inclusion", "", "Fraction of the resamples that have to keep a term.", 0.0, 1.0},
            inclusion);
  }
};

/// Bagging of rows and terms: each resample draws blocks of rows with replacement and leaves
/// terms out at random, and is fitted by sequentially thresholded least squares. Terms whose
/// inclusion probability (fraction of the resamples that kept them among those that offered
/// them) is at least `inclusion` get the coefficients of least squares on all rows. Random
/// numbers come from the seed of the run.
class Ensemble final : public Configured<Regressor, EnsembleOptions> {
 public:
  using Configured::Configured;

 private:
  Regression do_fit(const LeastSquaresSystem& system, const Subproblem& problem, Effort effort,
                    const RunContext& context) const override;
};

}  // namespace lacuna
