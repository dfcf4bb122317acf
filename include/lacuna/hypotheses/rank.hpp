// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lacuna/candidates/name_table.hpp"
#include "lacuna/candidates/screening.hpp"
#include "lacuna/core/run_context.hpp"

namespace lacuna {

/// One more effect, fitted together with all that were there before.
struct RankedEffect {
  Explanation explanation;       ///< the new effect is the last
  std::vector<Name> names = {};  ///< of the new effect with its numbers, best first
  double criterion = 0.0;        ///< deviance + parameters x log n (BIC)
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

/// What ranking needs to know besides data.
struct RankOptions {
  Index refits = 10;  ///< candidates that are fitted in few passes with their shapes fixed
  Index exact = 4;    ///< of these the best, which are fitted exactly
  NamingOptions naming = {};
};

/// Evidence up to which two explanations are not told apart: 2 log B of Kass and Raftery, JASA
/// 90 (1995), from where on it is very strong.
inline constexpr double kUndecided = 10.0;

/// Whether two effects are forms of one: functions of one argument in one place that have one
/// leading name (dry friction as sign(w) and as tanh(w/width)), or of which one has the other
/// as a special case.
bool are_forms_of_one(const FittedEffect& a, const std::string& name_of_a,
                      const FittedEffect& b, const std::string& name_of_b, const Scope& scope);

/// Ranks the candidates that may come next: score tests of all, then the best of each family
/// and equation is fitted exactly, with all coefficients, shapes and variances, and compared by
/// BIC = deviance + parameters x log n. "None of them" is the model with its disturbances as
/// they are. A form that has no name with its numbers is left out. Where a form with fewer
/// shape parameters is within the evidence that cannot tell them apart (kUndecided), it leads.
/// @param current the explanation so far, where all fits start; @param scope of the nominal
///   model.
Ranking rank(const Dataset& data, const Explanation& current,
             const std::vector<Stage<Effect>>& effects, const Scope& scope,
             const AssimilationOptions& options, const RankOptions& rank_options,
             const RunContext& context);

}  // namespace lacuna
