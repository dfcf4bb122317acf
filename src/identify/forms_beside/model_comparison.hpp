// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lacuna/data/records/noise.hpp"
#include "lacuna/identify/pipeline/pipeline.hpp"

namespace lacuna {

/// Whether no equation is known to leave more than noise.
bool reaches_the_noise(const IdentificationResult& result);

/// Whether all are known to leave no more: an equation that could not be judged is no success.
bool is_known_to_fit(const IdentificationResult& result);

/// Holds models of one record against each other by what they leave.
///
/// Where the samples of a state show no noise (unseen_noise()) a fit takes what it leaves for
/// noise, so that the misfits of two models have no unit in common: there the residuals of the
/// rates count.
class ModelComparison {
 public:
  /// @param noise of the states (analyse_noise()).
  ModelComparison(const Dataset& data, const std::vector<StateNoise>& noise);

  /// Sum over equations of ln(what one model leaves / what another does): of the misfits, or of
  /// the residuals where not both have a finite one, or none with a unit in common.
  double excess(const IdentificationResult& of, const IdentificationResult& over) const;

  /// Whether a model fits and another does not, in equations whose noise is seen, or by a
  /// fraction `same` less of the rates in the others.
  bool is_ahead(const IdentificationResult& one, const IdentificationResult& other,
                double same) const;

  /// Whether the samples of a state show the noise by which its equation is judged.
  bool sees_noise_of(std::size_t equation) const { return seen_[equation]; }

 private:
  double excess_in(std::size_t equation, const IdentificationResult& of,
                   const IdentificationResult& over) const;

  std::vector<bool> seen_;
};

}  // namespace lacuna
