// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lacuna/identify/options.hpp"
#include "lacuna/identify/pipeline/pipeline.hpp"

namespace lacuna {

/// Name in IdentificationResult::stages of find_alternatives(), where it was asked for.
inline constexpr const char* kAlternativesStage = "alternatives";

/// Which models are listed beside the best.
struct AlternativeOptions {
  std::size_t count = 10;  ///< at most

  /// Models are distinguished from the best where their criterion is larger by more: 6 is a
  /// Bayes factor of 20 (Kass & Raftery, J. Am. Stat. Assoc. 90 (1995) 773). At 3 the list has
  /// what is nearly as likely, at 12 what is one in 400.
  double difference = 6.0;

  /// Structures that are fitted to the trajectories for each that is asked for, the best by
  /// the rows of the weak form.
  std::size_t fitted = 3;

  ValidationOptions validation = {};  ///< of the error on samples held out
};

/// A model of another structure that the records cannot distinguish from the best.
struct AlternativeModel {
  OdeModel model;

  /// Schwarz' criterion less that of the best model, 2 n sum ln(misfit ratio) + ln(n m) for each
  /// coefficient more; below 0 where this model is ahead by it.
  double criterion = 0.0;

  /// exp(-criterion/2) over the sum of these, the best model included: how likely each is if
  /// one of them is true.
  double weight = 0.0;

  /// Error of predictions of samples held out, a fraction of the motion, of the worst state.
  std::optional<double> held_out = {};

  std::vector<std::string> without = {};  ///< terms that it lacks: "dx/dt: x*y"
  std::vector<std::string> with = {};     ///< terms that it has instead
};

/// Models that a term less, a term more or one term for another makes of an identified one, each
/// fitted anew to the records, as far as their criterion does not distinguish them from it; the
/// best first, with distinct structures.
///
/// Structures are ranked in the rows of the weak form, rows ln |y - Theta h|^2 + ln(rows) for
/// each term; the first of them are fitted to the trajectories as the model was.
/// @param result of identify_records(): candidate terms are those of its trail.
/// @return none for a map.
/// @throws DataError, ArgumentError as identify() and validate(); Cancelled.
std::vector<AlternativeModel> find_alternatives(const RecordStream& records,
                                                const IdentificationResult& result,
                                                const Pipeline& pipeline,
                                                const AlternativeOptions& options = {},
                                                const RunContext& context = {});

}  // namespace lacuna
