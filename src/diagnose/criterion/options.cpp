// SPDX-License-Identifier: MIT
#include "lacuna/diagnose/criterion/options.hpp"

namespace lacuna {

namespace {

/// How candidates are sought and fitted.
void describe_search(DecisionOptions& o, OptionVisitor& v) {
  v.field(
      {"worth_shaping", "",
       "Candidates whose gain is a smaller fraction of the best one's get no search of shapes.",
       0.0, 1.0},
      o.worth_shaping);
  v.field({"worth_fitting", "",
           "Candidates whose gain is a smaller fraction of the best one's are not fitted.", 0.0,
           1.0},
          o.worth_fitting);
  v.field({"possible", "standard deviations",
           "Candidates whose gain is less significant are not fitted.", 0.0},
          o.possible);
  v.field({"rough_fits", "", "Candidates of a round that are fitted in few passes.", 1.0},
          o.rough_fits);
  v.field({"exact_fits", "", "Of these the best, which are fitted exactly.", 1.0},
          o.exact_fits);
  v.field({"start_fits", "",
           "Where states are hidden, candidates of each further path that are fitted whatever "
           "they gain along it.",
           0.0},
          o.start_fits);
  v.field({"noise_inflation", "",
           "Identities are doubted where the noise of a channel comes out larger than its "
           "samples show against their neighbours, by this factor.",
           1.0},
          o.noise_inflation);
  v.field({"long_window", "mean periods",
           "Length, and least number, of windows over which coefficients have to hold where "
           "structure is left.",
           1.0},
          o.long_window);
}

/// How channels and explanations are judged.
void describe_judgement(DecisionOptions& o, OptionVisitor& v) {
  v.field(
      {"outlying", "standard deviations",
       "Samples are outliers of the measurement where they are farther off; 6 leaves out one "
       "of 5e8 samples of normal noise.",
       1.0},
      o.outlying);
  v.field({"pile_up", "",
           "A channel is clipped where its largest (or least) value has so many times as many "
           "samples as any value next to it.",
           1.0},
          o.pile_up);
  v.field(
      {"explained_gap", "noise floors",
       "What leaves a larger gap on records that were not used, by more than chance, is not "
       "called explained.",
       1.0},
      o.explained_gap);
  v.field({"open_gap", "noise floors",
           "What leaves a larger gap there is not called explained, be it by chance or not.",
           1.0},
          o.open_gap);
  v.field({"diverging", "standard deviations",
           "A model that runs freely over whole records that were not used and is farther off "
           "(rms) than this many deviations of the states is none yet: their means are nearer.",
           0.0},
          o.diverging);
  v.field({"input_noise", "",
           "The residual in an equation is the noise of an input where it is as much as the "
           "noise that samples of the input show makes, up to this factor or its inverse.",
           0.0, 1.0},
          o.input_noise);
  v.field({"cancelling", "",
           "Terms whose sum is a smaller fraction of the largest of them nearly cancel: their "
           "numbers say nothing each, and they do not pass as an explanation.",
           0.0, 1.0},
          o.cancelling);
  v.field({"out_of_scale", "",
           "A nominal coefficient that grows by more than this factor, or changes its sign, is "
           "not the one that was given; what needs it does not pass as an explanation.",
           1.0},
          o.out_of_scale);
  v.field({"acting", "",
           "An effect that acts in a smaller fraction of the samples is known from too few of "
           "them to pass as an explanation; it acts where it is more than this fraction of its "
           "largest value.",
           0.0, 1.0},
          o.acting);
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
           "What is less significant, after allowing for all that was tried, is chance.", 0.0},
          significance);
  v.field({"effect_size", "",
           "Least rms of an effect or of the residual, as a fraction of the rms of the state's "
           "rate; what is less may come from the arithmetic that made or sampled the records.",
           0.0, 1.0},
          effect_size);
  v.field({"undecided", "",
           "Evidence up to which two explanations are not distinguished: 2 log B of Kass and "
           "Raftery, JASA 90 (1995), from where on it is very strong.",
           0.0},
          undecided);
  v.field({"max_effects", "", "Effects that are named at most.", 0.0, 20.0}, max_effects);
  v.field({"negligible", "",
           "A difference of this fraction (of a gap, of a disturbance, of what an input "
           "explains) is none.",
           0.0, 1.0},
          negligible);
  v.field(
      {"minor", "",
       "A part of this fraction is a minor one: a further effect takes away more of the "
       "residual; an explanation that leaves less of the square of the gap shows the motion.",
       0.0, 1.0},
      minor);
  v.field({"major", "",
           "More than this fraction is most: of the variance of the disturbances that an "
           "explanation takes away, of the square of the gap on other records, of samples that "
           "repeat.",
           0.0, 1.0},
          major);
  describe_search(*this, v);
  describe_judgement(*this, v);
  gaps.describe(v);
  smoothing.describe(v);
  naming.describe(v);
  hints.describe(v);
}

}  // namespace lacuna
