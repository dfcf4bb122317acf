// SPDX-License-Identifier: MIT
// What a channel may add to the state that it measures, and composite models in which it does.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "lacuna/diagnose/hypotheses/composite_model.hpp"
#include "lacuna/forms/candidate/effect.hpp"

namespace lacuna {

/// What one channel may show beside its state, as candidates of place Channel: gain, offset,
/// drift, lag; a curve in place of a line; another quantity or a tone that it picks up.
std::vector<Candidate> channel_forms(const Scope& scope, Index state);

/// Whether a form of a channel stands for the whole of the state, so that its coefficient is 1:
/// what a filter or a curve with an end makes of it, less the state itself.
bool is_whole(const Candidate& candidate);

/// A channel that shows its state late: the value behind a filter of first order, and behind two
/// equal ones in series, less the state. With a coefficient c about 1 the value is late by c tau,
/// or 2 c tau; means of the last samples, speeds made of differences of positions and delays of
/// the sensor are among them up to the second power of their frequency. None where a record does
/// not show how late a state is.
std::vector<Candidate> late_channel_forms(const Scope& scope, Index state);

/// What such a form is called with its numbers, and the sentence for it.
struct ChannelName {
  std::string name, sentence;
};

/// @param effect of channel_forms() or late_channel_forms().
ChannelName channel_name(const FittedEffect& effect, const OdeModel& model);

/// What a composite model calls one of its effects.
const NamedEffect& name_in(const CompositeModel& composite, const FittedEffect& effect);

/// What sensors show in the place of effects of a composite model.
struct SensorFinding {
  std::string_view hypothesis;
  std::string cause;  ///< of what the sensors show
  /// Sensors first, with forms of channel_forms() or late_channel_forms(); then effects of the
  /// composite model before.
  Explanation explanation;
  std::size_t sensors = 0;
  Index tried = 0;
};

/// The composite model of a finding on the baseline of the one before.
CompositeModel composite_with(const Problem& problem, const CompositeModel& before,
                              const SensorFinding& finding);

}  // namespace lacuna
