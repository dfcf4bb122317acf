// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "lacuna/report/reports.hpp"

namespace lacuna {

/// How an identification came about, for people: coefficients one by one, fits, relations, noise,
/// which terms were removed by what number, synchronisation, stages left out, all warnings.
std::string details_text(const IdentificationReport& report, const Digits& digits);

}  // namespace lacuna
