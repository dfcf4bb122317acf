// SPDX-License-Identifier: MIT
#include "lacuna/identify/options.hpp"

namespace lacuna {
namespace {

/// Which samples are predicted.
void describe_samples(ValidationOptions& o, OptionVisitor& v) {
  v.field({"held_every", "blocks", "Of so many blocks of a record one is held out.", 2.0},
          o.held_every);
  v.field(
      {"blocks", "",
       "Blocks that a record is cut into, fewer where a block has no room for a window.", 1.0},
      o.blocks);
  v.field({"fewest_blocks", "", "And no fewer, whatever room they have.", 1.0},
          o.fewest_blocks);
  v.field({"most_samples", "samples",
           "Samples that are predicted at most, evenly spread, and for each of them held_every "
           "less one that coefficients are fitted to: what chance adds to an error is half of "
           "noise_slack then.",
           100.0},
          o.most_samples);
  v.field(
      {"least_windows", "",
       "But no fewer than so many windows of a mean period, where the records have them.", 1.0},
      o.least_windows);
  v.field({"noise_samples", "samples",
           "Records held out that have fewer do not determine their own noise; the records of "
           "the identification do.",
           4.0},
          o.noise_samples);
  v.field(
      {"correlated_samples", "samples",
       "Windows of fewer say nothing of the correlation of neighbours, which initial states "
       "take out.",
       2.0},
      o.correlated_samples);
}

}  // namespace

void ValidationOptions::describe(OptionVisitor& v) {
  v.field(
      {"noise_slack", "",
       "Errors may be above the noise by this fraction, as the noise is known no better.", 0.0},
      noise_slack);
  v.field({"scatter", "standard deviations",
           "And by so many of the rms of as many normal values; as many of the correlation of "
           "neighbouring residuals distinguish structure from white noise.",
           0.0},
          scatter);
  v.field({"structure", "standard deviations",
           "Correlated residuals are structure where the error is above the noise by so many.",
           0.0},
          structure);
  v.field(
      {"resolution", "",
       "Errors over a mean period below this fraction of the motion are those of the solver "
       "that made a record without noise, of its digits and of the interpolation of inputs.",
       0.0, 1.0},
      resolution);
  v.field({"small_fraction", "",
           "An error of a smaller fraction of the motion is what the model fits but for.", 0.0,
           1.0},
          small_fraction);
  v.field({"wrong_share", "",
           "An error of a larger fraction of the motion is no approximation.", 0.0, 1.0},
          wrong_fraction);
  v.field({"least_freedom", "", "Degrees of freedom below which a test says nothing.", 1.0},
          least_freedom);
  describe_samples(*this, v);
}

}  // namespace lacuna
