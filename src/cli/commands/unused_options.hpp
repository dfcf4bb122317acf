// SPDX-License-Identifier: MIT
// What was asked for and decided nothing, as far as the stages of a run show it.
#pragma once

#include <functional>
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

/// The assignments ("decision.major=0.3") without each of which the answer is the same to the
/// letter, as a run without it shows.
/// @param answer     the text of the answer with all of them
/// @param answer_to  the text of the answer with those that it gets; what it throws is an answer
///     of its own
std::vector<AskedOption> without_effect(
    const std::vector<std::string>& assignments, const std::string& answer,
    const std::function<std::string(const std::vector<std::string>&)>& answer_to);

/// For people, a line for each that was not used; empty where all were.
std::string unused_text(const std::vector<AskedOption>& asked);

}  // namespace lacuna::cli
