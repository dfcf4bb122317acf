// SPDX-License-Identifier: MIT
#include <algorithm>

#include "identify/pipeline/refined_result.hpp"
#include "identify/validation/validate.hpp"

namespace lacuna {
namespace {

void withdraw(EquationFit& fit, std::vector<std::string>& warnings) {
  if (!fit.doubt.empty()) std::erase(warnings, fit.doubt);
  fit.doubt.clear();
}

/// What predictions of the state that tests an equation say of it.
void take_part(const AdequacyPart& part, Adequate whole, EquationFit& fit,
               std::vector<std::string>& warnings) {
  const bool said = fit.fits_to_noise.has_value();
  if (part.fits != Adequate::Undetermined)
    fit.fits_to_noise = part.fits == Adequate::Yes;
  else if (said && (*fit.fits_to_noise ? !part.noise_known || whole == Adequate::No
                                       : whole == Adequate::Yes))
    fit.fits_to_noise.reset();
  if (fit.fits_to_noise.value_or(true)) withdraw(fit, warnings);
}

}  // namespace

void take_in(Validation validation, const Dataset& data, IdentificationResult& result) {
  for (std::size_t k = 0; k < result.fit.size(); ++k) {
    EquationFit& fit = result.fit[k];
    const std::optional<Index> tested = tested_by(data, static_cast<Index>(k));
    if (fit.identity || !tested) continue;
    const std::string& name = data.states[static_cast<std::size_t>(*tested)].name;
    for (const AdequacyPart& part : validation.adequacy.parts)
      if (part.name == name) take_part(part, validation.adequacy.fits, fit, result.warnings);
  }
  result.adequacy = adequacy_of_equations(result.fit);
  result.adequacy.fits = validation.adequacy.fits;
  result.validation = std::move(validation);
}

}  // namespace lacuna
