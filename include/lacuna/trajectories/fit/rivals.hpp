// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lacuna/trajectories/fit/fit.hpp"

namespace lacuna {

/// A fitted structure under its name.
struct NamedFit {
  std::string name;
  Fit fit;
};

/// How well one structure describes the records, beside the others.
struct FitRival {
  std::string name;
  double unknowns = 0.0;        ///< numbers, initial values and deviations of noise
  double log_likelihood = 0.0;  ///< of normal noise with one deviation for each channel
  double aicc = 0.0;            ///< Hurvich and Tsai, Biometrika 76:297-307 (1989)
  double bic = 0.0;             ///< Schwarz, Annals of Statistics 6:461-464 (1978)
  std::optional<double> held_out = {};  ///< FitGap::after
  Adequate fits = Adequate::Undetermined;
  bool converged = true;
  /// How much better the best one is by Vuong's test, in standard deviations; 0 for the best.
  double behind = 0.0;
  bool is_tied = true;  ///< whether the records do not distinguish it from the best
};

/// Structures that were fitted to the same records, the best (least AICc) first.
struct RivalComparison {
  std::vector<FitRival> rivals;
  double values = 0.0;  ///< that each was compared with, n
  /// What was noted at each of the fits, of the records then and no model.
  std::vector<std::string> notes = {};
};

/// Compares structures by the likelihood. With l_i the log-likelihood of a value, Vuong's
/// statistic is the sum of d = l_1 - l_2 over its deviation (Vuong, Econometrica 57:307-333,
/// 1989; that of Newey and West, Econometrica 55:703-708, 1987, because residuals of wrong
/// structures are correlated). Where parameters of one vary over records, l_i is that of a record
/// instead, and records are independent. Unknowns count in AICc, by which structures are sorted:
/// one with a term more that the records do not need has the same likelihood, and is tied. A
/// rival is tied with the best where AICc differs by no more than 2 (Burnham and Anderson, Model
/// Selection and Multimodel Inference (2002), Sect. 2.6), or Vuong's statistic is below 1.96.
/// @throws ArgumentError for none; DataError where two have not the same values to meet.
RivalComparison compare_fits(const std::vector<NamedFit>& fits);

}  // namespace lacuna
