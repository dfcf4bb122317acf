// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "lacuna/core/base/types.hpp"
#include "lacuna/model/equations/adequacy.hpp"

namespace lacuna {

/// What a model is worth on samples that it was not fitted to.
enum class ValidationVerdict {
  FitsToNoise,    ///< predictions are off by no more than the noise of the samples
  Approximation,  ///< by more than the noise, and by a small fraction of the motion
  WrongLibrary,   ///< by a large fraction of the motion: the terms cannot describe the record
  Undecided,      ///< too few samples, no motion beyond the noise, or noise that is not known
  Incomplete,     ///< a limit cut a stage of the search that could change the verdict
};

/// "fits to noise", "approximation", "wrong library", "cannot tell", "incomplete".
std::string to_string(ValidationVerdict verdict);

/// Errors of the predictions of one state over many windows. In each window the initial state
/// is the one that fits best, of a map the sample; all three numbers are sqrt(sum r^2 /
/// freedom), state units.
struct PredictionError {
  std::string state;
  double error = 0.0;  ///< r: sample minus prediction of the model
  double noise = 0.0;  ///< of the measurement; what the error of a true model would be (of a
                       ///< map: of any function of the sample before)
  bool noise_estimated = false;  ///< false: none shows, `noise` is an upper bound
  double motion = 0.0;   ///< r with all rates 0 that have to be found: what is to be explained
  double freedom = 0.0;  ///< samples less what the initial states take of them

  /// Of neighbouring residuals in a window, where the noise is white; else 0.
  double correlation = 0.0;

  /// Error beyond the noise over motion beyond the noise.
  double fraction() const;
};

/// Predictions over windows of one length.
struct PredictionTest {
  double horizon = 0.0;  ///< length of a window, time units
  Index windows = 0;
  Index lost = 0;                       ///< windows in which the model has no finite solution
  std::vector<PredictionError> states = {};  ///< measured ones
  Index unstarted = 0;  ///< windows with solutions of which none that fits was found
};

/// How well a model predicts samples that it was not fitted to.
struct Validation {
  ValidationVerdict verdict = ValidationVerdict::Undecided;
  std::string sentence = {};              ///< the verdict with its numbers, for people
  std::vector<std::string> records = {};  ///< sources of the samples
  std::string time_unit = {};
  Index samples = 0;      ///< held out
  bool given = false;     ///< records of their own; false: parts of those that were fitted
  bool refitted = false;  ///< coefficients were fitted without the samples
  PredictionTest one_step = {};          ///< the shortest windows that leave a residual
  PredictionTest windows = {};           ///< windows of a mean period
  Adequacy adequacy = {};                ///< what they say of each measured state
  std::vector<std::string> advice = {};  ///< what to try, where the model does not fit
};

}  // namespace lacuna
