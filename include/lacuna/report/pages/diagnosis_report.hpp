// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "lacuna/diagnose/journey/diagnosis.hpp"
#include "lacuna/model/equations/system_model.hpp"

namespace lacuna {

/// The answer for people, three to ten lines: verdict, each effect with numbers and units, what
/// the coefficients say, the gap on records not used, the residual.
std::string format_text(const Diagnosis& diagnosis);

/// Every composite model that was judged with the number or the rule that decided, for people.
std::string format_trail(const Diagnosis& diagnosis);

/// JSON text of the format "lacuna.diagnosis/1".
std::string format_json(const Diagnosis& diagnosis);

/// The same with the augmented model in other words, as with_parameters_of() has it.
std::string format_json(const Diagnosis& diagnosis, const SystemModel& augmented);

}  // namespace lacuna
