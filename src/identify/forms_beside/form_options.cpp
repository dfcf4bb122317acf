// SPDX-License-Identifier: MIT
#include "lacuna/identify/options.hpp"

namespace lacuna {
namespace {

/// How far the search looks.
void describe_search(FormOptions& o, OptionVisitor& v) {
  v.field({"rough_fits", "",
           "Forms of a round that are fitted roughly, the best by their starting points.", 1.0},
          o.rough_fits);
  v.field({"exact_fits", "", "Of these the best, which are fitted to the last digits.", 1.0},
          o.exact_fits);
  v.field(
      {"thinned", "",
       "Forms beside which it is tried how many terms may leave, for each of the three sets "
       "of terms where that begins.",
       1.0},
      o.thinned);
  v.field({"takes", "",
           "A form is fitted in the place of terms if at one of its starting points it takes "
           "this fraction of the residual beyond the limit without these terms.",
           0.0, 1.0},
          o.takes);
  v.field(
      {"denominators", "",
       "Denominators in several variables that go on from the implicit form of an equation.",
       0.0},
      o.denominators);
}

/// When a form takes the place of another.
void describe_plainness(FormOptions& o, OptionVisitor& v) {
  v.field({"alike", "",
           "Correlation over the samples from which on a form without numbers of its own is "
           "tried in the place of another.",
           0.0, 1.0},
          o.alike);
  v.field({"jump_samples", "",
           "A jump takes the place of a slope that a smaller fraction of the samples sees.",
           0.0, 1.0},
          o.jump_samples);
  v.field({"jump_far", "",
           "A sample sees a slope where slope and jump differ by more than this fraction of "
           "their rms.",
           0.0, 1.0},
          o.jump_far);
  v.field({"jump_varies", "",
           "Only for slopes whose standard deviation is a larger fraction of their rms: what "
           "has one sign all along is no jump.",
           0.0, 1.0},
          o.jump_varies);
}

}  // namespace

void FormOptions::describe(OptionVisitor& v) {
  v.field({"worth_asking", "",
           "Residual as a fraction of the rate (rms) below which no form is sought: errors of "
           "solvers.",
           0.0, 1.0},
          worth_asking);
  v.field({"most_forms", "", "Forms that an equation takes in beside the library at most.", 0.0,
           20.0},
          most_forms);
  v.field({"fewest_numbers", "",
           "An equation of fewer parameters that fits is not said by forms.", 2.0},
          fewest_parameters);
  v.field({"same", "",
           "Residuals that are no noise are the same where they (rms) differ by a smaller "
           "fraction.",
           0.0, 1.0},
          same);
  v.field(
      {"mostly_noise", "",
       "Residuals are noise up to so many times the sum of squares that noise leaves.", 1.0},
      mostly_noise);
  v.field(
      {"significance", "standard deviations",
       "By how much a sum of squares has to be above that of noise for a form to be sought.",
       0.0},
      significance);
  describe_search(*this, v);
  describe_plainness(*this, v);
}

}  // namespace lacuna
