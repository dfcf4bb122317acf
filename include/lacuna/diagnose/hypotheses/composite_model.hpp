// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "lacuna/core/statistics/interval.hpp"
#include "lacuna/diagnose/hypotheses/problem.hpp"
#include "lacuna/trajectories/smoother/disturbance_test.hpp"

namespace lacuna {

/// Another effect that might be it.
struct Alternative {
  std::string name;
  std::string term;
  double probability = 0.0;
};

/// A shape parameter with its value.
struct NamedParameter {
  std::string name;
  std::string unit;
  double value = 0.0;
  std::optional<double> deviation = {};  ///< its standard error, where there is one
};

/// An effect that the nominal model lacks.
struct NamedEffect {
  Index equation = 0;
  Place place = Place::Rate;  ///< in the equation of the state, or in its measured value
  std::string name = {};
  std::string description = {};
  std::string cause = {};  ///< what usually causes it
  std::string term = {};
  double coefficient = 0.0;  ///< state unit (in an equation per time unit) per unit of the term
  double deviation = 0.0;    ///< standard error of the coefficient
  std::vector<NamedParameter> parameters = {};
  double sigma = 0.0;
  double gap_closed = 0.0;    ///< fraction of the disturbance's variance that goes with it
  double contribution = 0.0;  ///< rms of its rate over that of the state's rate
  double probability = 0.0;
  Index tried = 1;  ///< candidates and shapes that it was the best of
  std::vector<Alternative> alternatives = {};

  /// 95 % confidence interval of the coefficient.
  std::array<double, 2> ci95() const { return interval95(coefficient, deviation); }
};

/// One round of the search: what was tried and what came of it.
struct Round {
  Index tried = 0;
  std::string best;  ///< "coulomb-friction: sign(w) in dw/dt"; empty when nothing was found
  double sigma = 0.0;
  bool accepted = false;
};

/// What can be said of structure that no effect explains.
struct Unnamed {
  Index equation = 0;
  std::vector<std::string> variables;  ///< of which it is a function, as far as one is found
  double explained = 0.0;  ///< fraction of the disturbance's variance that goes with the curve
  bool memory = false;     ///< earlier values of the variables determine more than present ones
  bool periodic = false;   ///< a few lines of the spectrum make up most of it
  bool filled = false;     ///< a black-box function stands in the augmented model
  std::string formula = {};  ///< that says as much as the curve, where one does: "-12*sin(th)"
};

/// A composite model that was judged and what became of it: an entry of the trail.
struct Rival {
  std::string hypothesis;                ///< registered name: "coloured-noise"
  std::string composite;                 ///< what it says: "dw/dt: sign(w)"
  std::optional<double> criterion = {};  ///< its number; nothing where it was not fitted
  bool taken = false;
  std::string quantity = {};  ///< what was looked at: "extended-bic", "inflation of the noise"
  double value = 0.0;         ///< what it was
  double threshold = 0.0;     ///< what it was compared with
  std::string rule = {};      ///< what decided whatever the number; empty: the number did
};

/// Another explanation of the same records, which they do not distinguish from the one that was
/// taken.
struct Twin {
  std::string what;                     ///< names and places of its effects: twin_of()
  std::string sentence;                 ///< for people
  std::vector<std::string> names = {};  ///< of its effects
  bool measurement = false;             ///< whether a fault of a channel is among these
  std::string instead_of = {};          ///< the one effect in whose place it may be; empty: all
};

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
