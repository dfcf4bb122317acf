// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lacuna/diagnose/hypotheses/composite_model.hpp"

namespace lacuna {

/// An input of which nobody said how it goes on between samples, or of which the samples
/// contradict what was said: held, but on lines between others.
struct OpenInput {
  Index input = 0;
  Hold second = Hold::Smooth;  ///< the hold that is next to the chosen one
  double lead = 0.0;           ///< of the chosen one, in deviance of the nominal model
};

/// The nominal model with inputs of which it is known how they go on between samples.
struct ChosenHolds {
  OdeModel model;
  std::vector<OpenInput> open = {};
  std::vector<Rival> trail = {};  ///< what was compared
};

/// Decides for each input of which nobody said it how it goes on between samples, by the
/// likelihood of the nominal model with fitted coefficients under each Hold. What the samples
/// show by themselves (zero where most of them repeat the one before, else smooth) stays unless
/// another is more likely by more than DecisionOptions::undecided; so does what the model says of
/// an input that its samples contradict, which is compared with lines.
///
/// The choice is made before effects are sought: a half step of delay between a held and a
/// smooth input looks like an effect of the dynamics.
ChosenHolds choose_holds(const Problem& problem);

/// The same by what the samples show by themselves, without comparing.
ChosenHolds shown_holds(const Problem& problem);

/// Models that may explain records better than the best so far.
struct RivalHolds {
  std::vector<OdeModel> models = {};
  /// Where the best needs no disturbance others do not take its place with more parameters than
  /// its effects have.
  std::optional<Index> most_parameters = {};
};

/// Models with another hold of an open input under which effects should be sought anew. None
/// without effects; else those under which the effects that were found fit decidedly better. A
/// wrong hold makes effects necessary that the right one does without, so also
/// - those under which the effects do not fit decidedly worse, where there are several, where
///   one is of that input (half a step of delay may be all there is to it) or where structure
///   is left, and where nothing disturbs the model with the effects;
/// - the second one, where the lead of the first is less than what the effects explain: a model
///   that lacks so much is no judge of half a step. Not so where the model with the effects
///   follows the records from their first samples on and needs no disturbance, and none of them
///   is of that input: no other hold has anything left to explain;
/// - the second one of an input that is taken for held though no sample repeats the one before:
///   the hold may stand for a part of an effect.
/// None of an input with the hold that its samples show, where it is recorded late (InputSkew).
/// @param problem its model has the chosen holds.
RivalHolds rival_holds(const Problem& problem, const OpenInput& open,
                       const CompositeModel& best);

/// What is assumed of inputs that are not smooth, for people: "u is held from sample to
/// sample".
/// @param open the inputs of which nobody said it.
std::vector<std::string> notes_on_holds(const OdeModel& model,
                                        const std::vector<OpenInput>& open);

}  // namespace lacuna
