// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "diagnose/candidates/name_table.hpp"
#include "diagnose/candidates/screening.hpp"
#include "lacuna/diagnose/hypotheses/problem.hpp"

namespace lacuna {

/// Where effects are sought.
struct EffectSearch {
  const Problem& problem;
  const Baseline& base;
  const std::vector<Stage<Effect>>& effects;  ///< that are tried
  /// Forms that are not, nor what the same effects propose in their places that is no plainer.
  std::vector<Candidate> without = {};
  bool only_plain = false;  ///< forms without shapes and memory
  /// Where states are hidden: the first effect is sought among the functions of the arguments
  /// that this has, along its path; it has no memory.
  const Explanation* along = nullptr;

  /// What fitted forms are called.
  NameTable names() const { return {effects, base.scope, problem.options.decision.naming}; }

  /// Whether an explanation may have so many parameters more (Problem::most_parameters).
  bool has_room(const Explanation& current, Index more) const {
    return !problem.most_parameters || current.parameters() + more <= *problem.most_parameters;
  }
};

/// One more effect, fitted together with all that were there before.
struct RankedEffect {
  Explanation explanation;       ///< the new effect is the last
  std::vector<Name> names = {};  ///< of the new effect with its numbers, best first
  double criterion = 0.0;        ///< of the explanation, without the penalty for the choice
  double gain = 0.0;             ///< drop of the deviance against the explanation without it
  double sigma = 0.0;            ///< of the gain, for the number of candidates tried
  double contribution = 0.0;     ///< rms of coefficient x form over that of the state's rate
  /// Among all ranked and "none of them"; of all forms that have the leading name in this
  /// variable together.
  double probability = 0.0;

  const FittedEffect& effect() const { return explanation.effects.back(); }
};

/// What a search over all candidates found.
struct Ranking {
  std::vector<RankedEffect> effects;  ///< best first
  double none = 1.0;                  ///< probability of "none of them"
  Index tried = 0;                    ///< candidates and shapes that were tried
};

/// Probabilities of what is ranked and of "none of them", exp(-criterion / 2) each.
/// @param none_criterion of the explanation without another effect.
void set_probabilities(Ranking& ranking, double none_criterion);

/// Whether two effects are forms of one: functions of one argument in one place that have one
/// leading name (dry friction as sign(w) and as tanh(w/width)), or of which one has the other
/// as a special case.
bool are_forms_of_one(const FittedEffect& a, const std::string& name_of_a,
                      const FittedEffect& b, const std::string& name_of_b, const Scope& scope);

/// Ranks the candidates that may come next: score tests of all, then the best of each family
/// and equation is fitted exactly, with all coefficients, shapes and variances, and compared by
/// the criterion. "None of them" is the model with its disturbances as they are. A form that
/// has no name with its numbers is left out. Of those within the evidence that cannot
/// distinguish them (DecisionOptions::undecided) one whose terms do not nearly cancel leads,
/// and then one with fewer shape parameters.
/// @param current the explanation so far, where all fits start.
Ranking rank(const EffectSearch& search, const Explanation& current);

}  // namespace lacuna
