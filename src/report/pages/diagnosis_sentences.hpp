// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "lacuna/diagnose/diagnosis.hpp"

namespace lacuna {

/// The answer in sentences that can be pasted into a letter.
struct DiagnosisSentences {
  std::vector<std::string> hints;
  std::string headline;
  std::vector<std::string> findings;  ///< effects, coefficients, the residual, the gap
  std::vector<std::string> notes;
};

/// Name of the state of an equation.
const std::string& state_name(const Diagnosis& diagnosis, Index equation);

DiagnosisSentences sentences_of(const Diagnosis& diagnosis);

/// A formula with its numbers for people; all digits are in the JSON. A parameter's number has
/// the digits that its error allows.
std::string readable_formula(const std::string& formula,
                             const std::vector<NamedParameter>& parameters);

}  // namespace lacuna
