// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

namespace lacuna {

/// How measured values are spread about the value y of the model. Numbers a and b are > 0.
enum class NoiseForm {
  Constant,      ///< normal, deviation a
  Proportional,  ///< normal, deviation b |y|
  Both,          ///< normal, deviation sqrt(a^2 + b^2 y^2)
  LogNormal,     ///< the logarithm is normal about log y, deviation b
  Poisson,       ///< as of counts: normal, variance a y
  Student        ///< y + a times Student's distribution: rare large errors
};

/// The law of the noise of an output.
struct NoiseLaw {
  NoiseForm form = NoiseForm::Constant;
  std::optional<double> constant = {};  ///< a where it is known; nothing: it is estimated
  std::optional<double> fraction = {};  ///< b where it is known; nothing: it is estimated
  double freedom = 4.0;                 ///< degrees of freedom of Student's distribution, > 2
  /// Limit of quantification, in the unit of the output: a value at it or below says that the
  /// measured one was not above it.
  std::optional<double> below = {};
  std::optional<double> above = {};  ///< the same at the other end: values are clipped there
  /// Values beyond the limits are never recorded, in the place of being known to lie there: the
  /// density of a value is that of the law over the probability of what is between the limits.
  bool truncated = false;

  bool operator==(const NoiseLaw&) const = default;
};

/// "constant", "proportional", "both", "lognormal", "poisson", "student".
std::string to_string(NoiseForm form);

/// The law of such a name; nothing for another word.
std::optional<NoiseForm> noise_form_named(const std::string& name);

/// Whether the law has a number a.
bool has_constant(NoiseForm form);

/// Whether the law has a number b.
bool has_fraction(NoiseForm form);

/// What is wrong with a law; empty where nothing is.
std::string law_problem(const NoiseLaw& law);

/// As it is written behind an output: "noise both 0.1 0.05 below 0.2".
std::string to_text(const NoiseLaw& law);

}  // namespace lacuna
