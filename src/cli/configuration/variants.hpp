// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "lacuna/cli/configuration/registry.hpp"

namespace lacuna {

/// One way to have a part: its name, with the names of the stages inside it.
struct StageVariant {
  std::string label;  ///< "ols", "irls-l1[ceres]", "strong[savitzky-golay]"
  std::shared_ptr<const StageInterface> stage;  ///< empty when it is unavailable
  std::string unavailable;  ///< why: "built without Ceres"; empty: it is there
};

/// Every registered part of a kind with default options; where an option is itself a stage,
/// once for each registered stage of that kind, unless that is the part's own kind. In the order
/// of the registry.
/// @throws ConfigError when there is no such kind.
std::vector<StageVariant> variants(const Registry& registry, std::string_view kind);

}  // namespace lacuna
