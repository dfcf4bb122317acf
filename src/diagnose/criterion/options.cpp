// SPDX-License-Identifier: MIT
#include "lacuna/diagnose/criterion/options.hpp"

namespace lacuna {

namespace {

/// How candidates are sought and fitted.
void describe_search(DecisionOptions& o, OptionVisitor& v) {
  v.field(
      {"worth_shaping", "",
           "No shapes are sought for candidates whose gain is below this fraction of the "
           "best one's.",
       0.0, 1.0},
      o.worth_shaping);
  v.field({"worth_fitting", "",
           "Candidates are not fitted where their gain is below this fraction of the best "
           "one's.", 0.0,
           1.0},
          o.worth_fitting);
  v.field({"possible", "standard deviations",
           "Candidates are not fitted where their gain is less significant than this.", 0.0},
          o.possible);
  v.field({"rough_fits", "",
           "In each round so many candidates are fitted in a few passes.", 1.0},
          o.rough_fits);
  v.field({"exact_fits", "",
           "So many of the best of these are then fitted exactly.", 1.0},
          o.exact_fits);
  v.field({"start_fits", "",
           "Where states are hidden, so many candidates are fitted on each further path, "
           "whatever their gain along it.",
           0.0},
          o.start_fits);
  v.field({"noise_inflation", "",
           "Noise with a memory is tried, and identities are doubted, where the noise of a "
           "channel is larger, by this factor, than that between neighbouring samples; names "
           "are an explanation only where the gap on other records is within this of its floor.",
           1.0},
          o.noise_inflation);
  v.field({"longest_memory", "",
           "Noise with a memory is sought up to this fraction of a record; where what is found "
           "exceeds it, it is not distinguished from structure, and no verdict rests on it.",
           0.0, 1.0},
          o.longest_memory);
  v.field({"long_window", "mean periods",
           "Where structure is left, coefficients have to hold over windows of this length, "
           "and over at least so many windows.",
           1.0},
          o.long_window);
}

/// How outliers and explanations are judged.
void describe_judgement(DecisionOptions& o, OptionVisitor& v) {
  v.field({"outlying", "standard deviations",
           "A sample that is farther off is an outlier; at 6 one in 5e8 samples of normal noise.",
           1.0},
          o.outlying);
  v.field({"pile_up", "",
           "A channel is clipped where its largest (or smallest) value occurs so many times "
           "as often as any value next to it.",
           1.0},
          o.pile_up);
  v.field({"explained_gap", "noise floors",
           "A model is called explained only where the gap on other records is at most this "
           "large, allowing for chance; beside names of effects 'noise_inflation' decides.",
           1.0},
          o.explained_gap);
  v.field({"open_gap", "noise floors",
           "A model with a larger gap there is not called explained, be it by chance or not.",
           1.0},
          o.open_gap);
  v.field({"least_closed", "",
           "Where a gap stays on records that were not used, names keep their place only if "
           "with them at least this fraction goes of the squared gap that fitted coefficients "
           "alone leave above the noise.",
           0.0, 1.0},
          o.least_closed);
  v.field({"diverging", "standard deviations",
           "A model that runs freely over records that were not used is no model yet where "
           "its rms error is more than so many standard deviations of the states: their "
           "means are nearer.",
           0.0},
          o.diverging);
  v.field({"input_noise", "",
           "The residual in an equation is the noise of an input where it is as much as the "
           "noise that samples of the input show makes, up to this factor or its inverse.",
           0.0, 1.0},
          o.input_noise);
  v.field({"cancelling", "",
           "Terms nearly cancel where their sum is below this fraction of the largest of "
           "them: their coefficients mean nothing one by one, and they do not pass as an "
           "explanation.",
           0.0, 1.0},
          o.cancelling);
  v.field({"out_of_scale", "",
           "A nominal coefficient that grows by more than this factor, or changes its sign, "
           "is no longer the one given; what needs that does not pass as an explanation.",
           1.0},
          o.out_of_scale);
  v.field({"rescaled", "",
           "Beside hidden states a nominal coefficient that changes by more than this factor, up "
           "or down, may have taken the part of what is missing: names beside it do not pass as "
           "an explanation, unless an effect stands in the place of its term.",
           1.0},
          o.rescaled);
  v.field({"acting", "",
           "An effect that acts in a smaller fraction of the samples is known from too few of "
           "them to pass as an explanation; it acts where it is more than this fraction of its "
           "largest value.",
           0.0, 1.0},
          o.acting);
}

/// How sensors and inputs are judged.
void describe_signals(DecisionOptions& o, OptionVisitor& v) {
  v.field(
      {"filter_gain", "",
       "A filter in front of a sensor passes on the whole of the state, up to this fraction.",
       0.0, 1.0},
      o.filter_gain);
  v.field({"dense_input", "",
           "An input is recorded densely where its slope changes from step to step by a "
           "smaller fraction of itself (rms): straight lines and curves through its samples "
           "are then the same, and no jump hides between two of them.",
           0.0},
          o.dense_input);
}

}  // namespace

void SmoothingOptions::describe(OptionVisitor& v) {
  v.field({"smoothing_widest", "samples",
           "Widest filter that records are asked for: a wider one leaves of the noise above "
           "half of the highest frequency too little to distinguish it from others.",
           2.0, 128.0},
          widest);
  v.field(
      {"smoothing_below", "",
       "A filter that is seen above half of the highest frequency is that of the records "
       "unless there is this many times of what it would pass in the octave below: a signal "
       "adds less there, and filters that only end like it pass thousands of times more.",
       1.0},
      below);
  v.field(
      {"smoothing_turns", "",
       "Turns in which a filter is undone: after 30 there is still missing a ten thousandth "
       "where it passes half.",
       0.0, 10000.0},
      turns);
  v.field({"smoothing_in_common", "",
           "Correlation of the noise of two samples up to which both are used; of samples that "
           "are closer to each other one is.",
           0.0, 1.0},
          in_common);
  v.field(
      {"smoothing_least_left", "samples",
       "Where undoing the filter leaves fewer samples with noise of their own, records stay "
       "as they are.",
       1.0},
      least_left);
}

void DecisionOptions::describe(OptionVisitor& v) {
  v.field({"significance", "standard deviations",
           "An effect counts only where it is at least this significant, after allowing for "
           "all that was tried.", 0.0},
          significance);
  v.field({"effect_size", "",
           "An effect or a residual counts only from this size on: its rms as a fraction of "
           "the rms of the state's rate. Below it may be the arithmetic that made or sampled "
           "the records.",
           0.0, 1.0},
          effect_size);
  v.field({"undecided", "",
           "Two explanations are not distinguished while the evidence between them is below "
           "this: 2 log B of Kass and Raftery, JASA 90 (1995), who call 10 very strong.",
           0.0},
          undecided);
  v.field({"max_effects", "",
           "At most so many effects are named.", 0.0, 20.0}, max_effects);
  v.field({"negligible", "",
           "A change by less than this fraction counts as no change: of a gap, of a "
           "disturbance, of what an input explains.",
           0.0, 1.0},
          negligible);
  v.field(
      {"minor", "",
           "A part below this fraction is minor: a further effect has to remove more of the "
           "residual, and an explanation that leaves less of the squared gap has found the "
           "motion.",
       0.0, 1.0},
      minor);
  v.field({"major", "",
           "A part above this fraction is most of the whole: of the variance of disturbances "
           "that an explanation removes, of the squared gap on other records, of samples "
           "that repeat.",
           0.0, 1.0},
          major);
  describe_search(*this, v);
  describe_judgement(*this, v);
  describe_signals(*this, v);
  gaps.describe(v);
  smoothing.describe(v);
  naming.describe(v);
  hints.describe(v);
}

}  // namespace lacuna
