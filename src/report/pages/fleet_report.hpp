// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "lacuna/diagnose/journey/diagnosis.hpp"

namespace lacuna {

/// What became of one record of a fleet, as JSON text, so that processes can pass it on.
struct FleetAnswer {
  std::string json;
};

/// A record that was diagnosed.
FleetAnswer fleet_answer(const std::string& record, const Diagnosis& diagnosis);

/// A record that could not be. @param error as a command would say it.
FleetAnswer fleet_failure(const std::string& record, const std::string& error);

/// For people: the answers in a table, and in how many records each effect was named.
std::string format_text(const std::vector<FleetAnswer>& fleet);

/// JSON text of the format "lacuna.fleet/1".
std::string format_json(const std::vector<FleetAnswer>& fleet);

}  // namespace lacuna
