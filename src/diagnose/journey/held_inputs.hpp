// SPDX-License-Identifier: MIT
// Composite models under what is assumed of the inputs between samples.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "journey.hpp"

namespace lacuna {

/// The best composite model, and the nominal model with the holds under which it is the best.
struct JudgedModel {
  std::shared_ptr<const OdeModel> model;
  Judged judged;
  std::vector<std::string> notes = {};
};

/// Whether one composite model names more effects than another that leaves no structure: what
/// it says better may be what a wrong assumption has to be patched with.
bool is_less_plain(const CompositeModel& one, const CompositeModel& other,
                   const DecisionOptions& decision);

/// Chooses how inputs go on between samples, then the composite model; where the effects that
/// are found speak for other holds (rival_holds()), these are judged too, and the criterion
/// decides among those that are not less plain.
/// @param problem with the nominal model as it was given.
JudgedModel judge_holds(const Problem& problem,
                        const std::vector<Stage<Hypothesis>>& hypotheses);

}  // namespace lacuna
