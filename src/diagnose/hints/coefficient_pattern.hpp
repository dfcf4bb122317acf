// SPDX-License-Identifier: MIT
#pragma once

#include "slip_search.hpp"

namespace lacuna {

/// What the records show of one coefficient, by least squares over windows.
struct CoefficientRatio {
  Index equation = 0;
  Index summand = 0;
  double ratio = 1.0;  ///< estimated over nominal
};

/// The coefficients that the records determine, each as a ratio to the nominal one.
/// @param significance standard errors from which on they do.
std::vector<CoefficientRatio> coefficient_ratios(const OdeModel& model, const Dataset& data,
                                                 const RateWindows& windows,
                                                 double significance);

/// The slip of a unit whose pattern the coefficients show, for records in which a large effect
/// hides it from find_slip(): effects bend coefficients, but do not make several of them wrong
/// by what one large factor of time or of a channel would.
///
/// With the ratios r_i and those p_i that a slip makes of the coefficients it has to leave
/// sum |log(r_i / p_i)| a small fraction of sum |log r_i|, and to change two of them or more,
/// by a large factor (HintOptions::slip_factor).
std::optional<FoundSlip> slip_of_coefficients(const OdeModel& model, const Dataset& data,
                                              const RateWindows& windows,
                                              const HintOptions& options);

}  // namespace lacuna
