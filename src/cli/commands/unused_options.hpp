// SPDX-License-Identifier: MIT
// What was asked for and decided nothing, as far as the stages of a run show it.
#pragma once

#include <string>
#include <vector>

#include "lacuna/core/base/stages_done.hpp"

namespace lacuna::cli {

/// An option that was given, and why the run did not use it; empty where it may have.
struct AskedOption {
  std::string option;
  std::string unused;
};

/// Why a stage decided nothing: "the stage `advice` was not reached"; empty where it was done.
std::string why_not(const std::string& stage, const std::vector<StageDone>& stages);

/// For people, a line for each that was not used; empty where all were.
std::string unused_text(const std::vector<AskedOption>& asked);

}  // namespace lacuna::cli
