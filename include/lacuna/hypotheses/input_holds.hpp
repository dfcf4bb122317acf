// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "lacuna/hypotheses/account.hpp"

namespace lacuna {

/// The nominal model with inputs of which it is known how they go on between samples.
struct ChosenHolds {
  OdeModel model;
  std::vector<Rival> trail;  ///< what was compared
  std::vector<std::string> notes;
};

/// Decides for each input of which nobody said it how it goes on between samples, by the
/// likelihood of the nominal model with fitted coefficients under each Hold. What the samples
/// show by themselves (zero where most of them repeat the one before, else smooth) stays unless
/// another is more likely by more than DecisionOptions::undecided.
///
/// The choice is made before effects are sought: a half step of delay between a held and a
/// smooth input looks like an effect of the dynamics.
ChosenHolds choose_holds(const Problem& problem);

}  // namespace lacuna
