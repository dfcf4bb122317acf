// SPDX-License-Identifier: MIT
// What the contract suites share: all registered parts, and what is installed for those of
// others.
#pragma once

#include <gtest/gtest.h>

#include <cctype>
#include <ostream>
#include <string>
#include <vector>

#include "cli/configuration/variants.hpp"
#include "lacuna/testing.hpp"

namespace lacuna {

/// Names of parameters in the output of the tests.
inline void PrintTo(const StageVariant& variant, std::ostream* out) { *out << variant.label; }
inline void PrintTo(const RegistryEntry& entry, std::ostream* out) {
  *out << entry.kind << " " << entry.info.name;
}

}  // namespace lacuna

namespace lacuna::contract {

/// Every variant of a kind that this build has.
inline std::vector<StageVariant> available(std::string_view kind) {
  std::vector<StageVariant> all;
  for (StageVariant& variant : variants(default_registry(), kind))
    if (variant.unavailable.empty()) all.push_back(std::move(variant));
  return all;
}

/// "irls_l1_ceres_" from "irls-l1[ceres]".
inline std::string test_name(const testing::TestParamInfo<StageVariant>& info) {
  std::string name = info.param.label;
  for (char& c : name)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
  return name;
}

/// The stage of a variant as its plug point.
template <class Interface>
Stage<Interface> stage_of(const StageVariant& variant) {
  return Stage<Interface>(std::dynamic_pointer_cast<const Interface>(variant.stage));
}

/// Every variant of a kind that this build has, as its plug point.
template <class Interface>
std::vector<Stage<Interface>> stages_of() {
  std::vector<Stage<Interface>> all;
  for (const StageVariant& variant : available(Interface::kKind))
    all.push_back(stage_of<Interface>(variant));
  return all;
}

}  // namespace lacuna::contract
