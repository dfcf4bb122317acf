// SPDX-License-Identifier: MIT
// The rounds of a diagnosis: one effect after another.
#pragma once

#include <optional>
#include <vector>

#include "lacuna/diagnosis/diagnose.hpp"

namespace lacuna {

/// What the rounds ended with.
struct SearchResult {
  Explanation explanation;
  std::vector<NamedEffect> named;  ///< one for each effect of the explanation
  std::vector<Round> rounds;
  std::vector<EquationStructure> left;
  std::optional<Explanation> refitted = {};  ///< with coefficients that hold over windows
};

/// Adds effects until none is significant and of substance, or there are enough; effects that
/// later ones make superfluous are taken out again.
SearchResult search_effects(const Dataset& data, const Assimilation& base, const Scope& scope,
                            const AssimilationOptions& fit_options,
                            const DiagnosisOptions& options, const RunContext& context);

/// The result with a free input as the only effect.
SearchResult name_free_input(const RankedEffect& input, const Assimilation& base,
                             const DiagnosisOptions& options, std::vector<Round> rounds,
                             const RunContext& context);

/// Numbers of a fit into the names of its effects.
void update_numbers(const Explanation& explanation, std::vector<NamedEffect>& named);

/// Whether structure is significant and of substance.
bool is_substantial(const EquationStructure& structure, const DiagnosisOptions& options);

/// BIC of an explanation.
double criterion_of(const Explanation& explanation);

}  // namespace lacuna
