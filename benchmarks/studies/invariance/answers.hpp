// SPDX-License-Identifier: MIT
// The answer of `lacuna identify` on a record, as a user has it.
#pragma once

#include <filesystem>
#include <optional>

#include "variants.hpp"

namespace lacuna::benchmarks {

/// What `identify` said.
struct Answer {
  int status = 0;
  std::optional<OdeModel> model = {};
  Structure structure = {};
  std::string verdict = {};  ///< "fits to noise", ...
  std::string error = {};    ///< where there is no answer
  std::string json = {};
};

/// Runs `lacuna identify FILE --degree D --json -` in this process.
Answer identified(const Dataset& data, int degree, const std::filesystem::path& file);

/// How an answer in other units compares with the one in the units of the record.
enum class Outcome {
  Same,      ///< structure and verdict
  Refused,   ///< an error that says why
  Doubtful,  ///< another structure, or none, and no claim that it fits to the noise
  Other,     ///< another structure that is said to fit, or another verdict on the same one
};

std::string to_string(Outcome outcome);

/// Whether the terms are those that are expected; where they are powers of x - c, whether they
/// are those of the base but for a shift.
bool has_structure(const Answer& answer, const Answer& base, const Structure& expected);

/// Verdicts that say less than the one in the units of the record count as doubt.
Outcome compared(const Answer& answer, const Answer& base, const Structure& expected);

}  // namespace lacuna::benchmarks
