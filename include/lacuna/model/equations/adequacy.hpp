// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "lacuna/core/base/types.hpp"

namespace lacuna {

/// Whether a model fits samples to their noise.
enum class Adequate {
  Yes,           ///< nothing but noise is left
  No,            ///< more is left
  Undetermined,  ///< too few samples, no motion, or noise of which they show nothing
};

/// "yes", "no", "untold".
std::string to_string(Adequate adequate);

/// What was compared of one equation or channel, and what that says.
struct AdequacyPart {
  std::string name;
  Adequate fits = Adequate::Undetermined;
  Index samples = 0;         ///< compared
  bool noise_known = false;  ///< the samples show their noise
};

/// Does a model fit to the noise, in its parts and as a whole, and on what evidence? Computed
/// once for an answer; headline, verdict and sentences are made of it, so that none of them can
/// say what another one denies.
struct Adequacy {
  Adequate fits = Adequate::Undetermined;  ///< as a whole
  std::vector<AdequacyPart> parts = {};

  Index samples() const;  ///< compared, of all parts
};

/// The whole of parts: it fits where one does and none does not; it does not where one does
/// not.
Adequacy adequacy_of(std::vector<AdequacyPart> parts);

}  // namespace lacuna
