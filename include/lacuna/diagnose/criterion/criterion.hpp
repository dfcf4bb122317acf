// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/core/base/stage.hpp"
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

}  // namespace lacuna
