// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "lacuna/diagnose/diagnosis.hpp"
#include "lacuna/diagnose/hypotheses/problem.hpp"
#include "lacuna/trajectories/smoother/disturbance_test.hpp"

namespace lacuna {

/// One explanation of the records as a whole: what is assumed of them, the effects on top, and
/// the residual structure.
struct CompositeModel {
  std::string hypothesis;  ///< that proposed it
  std::shared_ptr<const Baseline> base;
  Explanation explanation;         ///< effects on top of the baseline
  std::vector<NamedEffect> named;  ///< one for each effect of the explanation, or none
  std::vector<Round> rounds = {};  ///< how they were found
  std::vector<EquationStructure> left = {};  ///< their residual structure
  std::optional<Explanation> refitted = {};  ///< with coefficients that hold over windows
  std::vector<NamedEffect> findings = {};    ///< what the assumptions themselves are called
  std::optional<Unnamed> unnamed = {};       ///< what can be said of what has no name
  std::vector<std::string> notes = {};       ///< for people
  std::vector<Twin> twins = {};              ///< what explains the records as well elsewhere
};

/// Where an effect acts: " in dw/dt", " of i" of a channel.
std::string place_of(const NamedEffect& effect, const OdeModel& nominal);

/// Names and places of effects that act together: "constant-offset in dw/dt with constant-offset
/// in di/dt", "sensor-offset of i".
std::string names_in_places(const std::vector<NamedEffect>& effects, const OdeModel& nominal);

/// Effects, all together, in the place of what was taken: none of them alone is a twin.
/// @param sentence empty: that the records do not distinguish the two.
Twin twin_of(const std::vector<NamedEffect>& effects, const OdeModel& nominal,
             std::string sentence = {});

/// The composite model of a baseline that nothing is missing.
CompositeModel bare_composite(const Problem& problem, std::string hypothesis,
                              std::shared_ptr<const Baseline> base);

/// What a composite model shows for itself and took: free coefficients, parameters of the
/// baseline, of the effects, and the number of candidates each effect was the best of.
Evidence evidence_of(const CompositeModel& composite);

/// Whether the residual of an equation is significant and of the size of an effect.
bool is_substantial(const EquationStructure& structure, const DecisionOptions& decision);

/// Whether an equation has substantial structure left; any, where none is given.
bool is_left_in(const std::vector<EquationStructure>& left, const DecisionOptions& decision,
                std::optional<Index> equation = {});

/// Whether some equation has substantial structure left.
bool leaves_structure(const CompositeModel& composite, const DecisionOptions& decision);

/// Whether anything significant is left in an equation, or in any, be it a minor part of an
/// effect: forms that stand for another thing leave that much.
bool has_residual_structure(const std::vector<EquationStructure>& left,
                            const DecisionOptions& decision,
                            std::optional<Index> equation = {});

/// Whether the effects take away most of the variance of the disturbances, or show the motion;
/// less is no explanation.
bool closes_most(const CompositeModel& composite, const Problem& problem);

/// Whether the effects leave no more than a minor part of the square of the gap in windows:
/// what lasts is theirs, whatever happens within a step.
bool shows_the_motion(const CompositeModel& composite, const Problem& problem);

/// Numbers of a fit into the names of its effects.
void update_numbers(const Explanation& explanation, std::vector<NamedEffect>& named);

}  // namespace lacuna
