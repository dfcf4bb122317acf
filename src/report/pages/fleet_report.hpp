// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "lacuna/diagnose/diagnosis.hpp"

namespace lacuna {

/// What became of one record of a fleet.
struct FleetAnswer {
  std::string record;
  std::optional<std::string> error = {};  ///< why it could not be diagnosed; then nothing else
  std::string headline = {};
  std::string verdict = {};
  std::vector<std::string> effects = {};          ///< "coulomb-friction in w" of each
  std::optional<std::array<double, 2>> gap = {};  ///< of the model, and with the effects
  std::string diagnosis = {};                     ///< JSON text, "lacuna.diagnosis/1"
};

/// A record that was diagnosed.
FleetAnswer fleet_answer(const std::string& record, const Diagnosis& diagnosis);

/// A record that could not be. @param error as a command would say it.
FleetAnswer fleet_failure(const std::string& record, const std::string& error);

/// An answer as text in which one process gives it to another, and back.
/// @throws ArgumentError for a text that is none.
std::string packed(const FleetAnswer& answer);
FleetAnswer unpacked(const std::string& text);

/// For people: the answers in a table, and in how many records each effect was named.
std::string format_text(const std::vector<FleetAnswer>& fleet);

/// JSON text of the format "lacuna.fleet/1".
std::string format_json(const std::vector<FleetAnswer>& fleet);

}  // namespace lacuna
