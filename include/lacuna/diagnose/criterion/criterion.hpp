// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/core/base/options.hpp"
#include "lacuna/core/base/types.hpp"

namespace lacuna {

/// What an explanation of records has to show for itself and what it took.
struct Evidence {
  double deviance = 0.0;    ///< -2 log likelihood
  double parameters = 0.0;  ///< that were fitted: coefficients, shapes, variances of its own
  double samples = 0.0;     ///< of all channels
  double log_choices =
      0.0;  ///< sum of log(number tried) over what was chosen as the best of many
};

/// Plug point: by what number explanations of the same records are compared; the least wins.
///
/// value = deviance + penalty(parameters, samples, choices). A diagnosis
/// computes the penalty for parameters nowhere else.
class Criterion : public StageInterface {
 public:
  static constexpr std::string_view kKind = "criterion";

  /// The number to be compared; infinite for a deviance that is not finite.
  double value(const Evidence& evidence) const;

  /// What parameters and choices cost. The deviance is not looked at.
  /// @throws ArgumentError when parameters, samples or choices are negative or not finite.
  double penalty(const Evidence& evidence) const;

 private:
  /// Never negative, and no less with more parameters or choices.
  virtual double do_penalty(const Evidence& evidence) const = 0;
};

/// Options of extended_bic().
struct ExtendedBicOptions {
  static constexpr StageInfo kInfo{
      "extended-bic",
      "Bayesian information criterion with a penalty for choosing the best of many",
      "Schwarz, Ann. Statist. 6 (1978); Chen and Chen, Biometrika 95 (2008)"};
  double choice = 1.0;  ///< gamma of Chen and Chen; 0: the plain criterion
  void describe(OptionVisitor& v);
};

/// deviance + parameters log n + 2 gamma sum log(tried): Chen and Chen (2008), eq. (1), with
/// the number of candidates that each chosen effect was the best of.
/// @throws ConfigError when an option is out of its range.
Stage<Criterion> extended_bic(const ExtendedBicOptions& options = {});

}  // namespace lacuna
