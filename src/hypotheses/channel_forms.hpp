// SPDX-License-Identifier: MIT
// What a channel may add to the state that it measures.
#pragma once

#include <string>
#include <vector>

#include "lacuna/candidates/explanation.hpp"
#include "lacuna/candidates/scope.hpp"

namespace lacuna {

/// Gain, offset, drift and lag of one channel as candidates of place Channel.
std::vector<Candidate> channel_forms(const Scope& scope, Index state);

/// What such a form is called with its numbers, and the sentence for it.
struct ChannelName {
  std::string name, sentence;
};

/// @param effect of channel_forms().
ChannelName channel_name(const FittedEffect& effect, const OdeModel& model);

}  // namespace lacuna
