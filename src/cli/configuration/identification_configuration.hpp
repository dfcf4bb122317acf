// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/cli/configuration/configuration.hpp"
#include "lacuna/identify/options.hpp"

namespace lacuna {

/// Carrier of options that belong to no stage, where parts are looked up by name: kind, name
/// and key of the configuration are one word (`lacuna describe validation`).
template <class OptionsType>
class RulesOf : public StageInterface {
 public:
  static constexpr std::string_view kKind = OptionsType::kInfo.name;
};

/// Such options as a registered part.
template <class OptionsType>
class Rules final : public Configured<RulesOf<OptionsType>, OptionsType> {
 public:
  using Configured<RulesOf<OptionsType>, OptionsType>::Configured;
};

/// These options from a configuration with the keys `forms`, `validation`, `relations`,
/// `advice`, `map` and `sync`, an object of numbers by name each: {"validation": {"resolution":
/// 1e-4}}.
/// @throws ConfigError naming the JSON path: an unknown name (with the nearest known one), a
///   value of the wrong type or out of range.
IdentificationOptions identification_options(const Configuration& configuration,
                                             const Registry& registry);

}  // namespace lacuna
