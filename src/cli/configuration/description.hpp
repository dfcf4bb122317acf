// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "lacuna/cli/configuration/registry.hpp"

namespace lacuna {

/// One option in words.
struct OptionDescription {
  std::string name;
  std::string type;   ///< "number", "whole number", "true or false", "text", "one of a, b", ...
  std::string unit;   ///< empty for a pure number or text
  std::string range;  ///< "0 .. 1", ">= 0"; empty when there is none
  std::string value;  ///< default; "none" for an optional one that is not set
  std::string text;   ///< one sentence
};

/// All options of a registered part with their defaults, in order of declaration.
std::vector<OptionDescription> describe_options(const RegistryEntry& entry);

/// All options of a stage with their present values.
std::vector<OptionDescription> describe_options(const StageInterface& stage);

/// A part for people: name, kind, summary, source and a block for each option.
std::string format_description(const RegistryEntry& entry);

}  // namespace lacuna
