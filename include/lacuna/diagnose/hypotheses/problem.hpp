// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "lacuna/core/base/run_context.hpp"
#include "lacuna/diagnose/candidates/explanation.hpp"
#include "lacuna/diagnose/criterion/options.hpp"
#include "lacuna/records/binding/bound_records.hpp"

namespace lacuna {

/// What searches have come to, so that no other one does the same again.
struct SearchMemory;

/// A memory in which nothing is yet.
std::shared_ptr<SearchMemory> new_search_memory();

/// What a diagnosis is about. Everything outlives it.
struct Problem {
  const OdeModel& nominal;
  const BoundRecords& records;  ///< to explain
  const DiagnosisOptions& options;
  const RunContext& context;
  std::shared_ptr<SearchMemory> memory = new_search_memory();
  /// Effects are sought that have no more parameters (coefficients and shapes) together: with
  /// more they do not take the place of what is known already. Nothing: whatever they have.
  std::optional<Index> most_parameters = {};
};

/// The same problem in another context: on one thread, for fits side by side.
Problem alone(const Problem& problem, const RunContext& quiet);

/// What is assumed of the records before any effect is sought, and the nominal model brought
/// onto them under these assumptions.
struct Baseline {
  std::shared_ptr<const BoundRecords> records;  ///< as the assumptions correct them
  Assimilation given;                           ///< with the nominal coefficients
  Assimilation fitted;                          ///< with the free coefficients fitted
  AssimilationOptions fit_options;              ///< which are free, and what is known of them
  Scope scope;                                  ///< of the nominal model, for effects
  /// Parameters that the assumptions themselves took, beside the free coefficients.
  double parameters = 0.0;
  std::vector<std::string> notes = {};  ///< the assumptions, for people
  /// The same correction for other records of the system; empty where there is none.
  std::function<Dataset(const Dataset&)> correct = {};
};

/// Lines of the spectrum in each equation from which periodic effects start.
inline constexpr Index kSpectralLines = 3;

/// The nominal model on its records as they are: outliers are left out and noted.
/// @throws DataError where the model has no finite solution from one sample to the next.
Baseline plain_baseline(const Problem& problem);

/// A baseline whose free coefficients are fitted, from a model that is on the records with its
/// nominal ones. Where the records do not determine the coefficients they are kept and that is
/// noted.
/// @param free coefficients that are fitted.
Baseline fitted_baseline(const Problem& problem, Assimilation given,
                         std::vector<CoefficientPlace> free);

/// Value of an explanation by the criterion, with all parameters and without the penalty for
/// choosing its effects.
double criterion_of(const Problem& problem, const Baseline& base,
                    const Explanation& explanation);

/// Effects fitted jointly with the nominal model on the records of a baseline: explain().
Explanation explain_on(const Problem& problem, const Baseline& base, const Assimilation& start,
                       const std::vector<FittedEffect>& effects);

/// explain() of an explanation's own effects, from where its fit has come.
Explanation explain_further_on(const Problem& problem, const Baseline& base,
                               const Explanation& start);

/// explain_on() in few passes: explain_roughly().
Explanation explain_roughly_on(const Problem& problem, const Baseline& base,
                               const Assimilation& start,
                               const std::vector<FittedEffect>& effects);

/// with_joint_errors() of an explanation on a baseline.
Explanation with_joint_errors(const Problem& problem, const Baseline& base,
                              Explanation explanation);

}  // namespace lacuna
