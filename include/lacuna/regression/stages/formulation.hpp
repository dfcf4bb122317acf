// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>

#include "lacuna/core/base/options.hpp"
#include "lacuna/core/base/run_context.hpp"
#include "lacuna/data/long_records.hpp"
#include "lacuna/model/equations/ode_model.hpp"
#include "lacuna/model/equations/term.hpp"
#include "lacuna/regression/linear/least_squares_system.hpp"

namespace lacuna {

/// Plug point: turns records and candidate terms into a linear problem. In the strong form a
/// row is a sample and the target its derivative; other forms have other rows, and the target
/// of a map is the next sample. All that comes after sees rows only.
class Formulation : public StageInterface {
 public:
  static constexpr std::string_view kKind = "formulation";

  /// The system Theta h_k ~ y_k with one target per state.
  /// @throws DataError when the dataset is not usable (check_dataset), when there are fewer
  /// rows
  ///   than terms, when a state is constant, when a derivative is zero throughout, or when a
  ///   term is not finite on the data: names the place and the remedy; ConfigError when
  ///   the form needs records in memory that are not. A map always does: it is lost where
  ///   samples are left out.
  LeastSquaresSystem assemble(const RecordStream& records, const TermLibrary& library,
                              const RunContext& context = {}) const;

  /// What the equations are that the targets make.
  Evolution evolution() const { return do_evolution(); }

  /// rms of each target that measurement noise alone causes.
  ///
  /// The noise is white, of standard deviation sigma_k in state k, and enters the target
  /// through a linear operator: rms_k = gain sigma_k, where gain is the root of the sum of
  /// squared responses to a unit impulse. Noise in Theta is not counted.
  /// @param state_noise sigma, one per state, in state units.
  /// @return target units, one per state; nothing when the dataset brings derivatives, whose
  ///   noise nobody knows.
  /// @throws ArgumentError unless there is one finite number >= 0 per state; DataError as
  ///   assemble().
  std::optional<Vector> target_noise(const Dataset& data, const Vector& state_noise) const;

 private:
  friend Stage<Formulation> fitted_to(const Stage<Formulation>& form, const Dataset& data,
                                      const std::optional<Vector>& noise);

  virtual LeastSquaresSystem do_assemble(const Dataset& data, const TermLibrary& library,
                                         const RunContext& context) const = 0;

  /// The same for records that are longer than an excerpt; of those in memory check_form() is
  /// done, check_finite() is not. Without it they have to be in memory.
  virtual LeastSquaresSystem do_assemble_long(const RecordStream& records,
                                              const TermLibrary& library,
                                              const RunContext& context) const;

  virtual Evolution do_evolution() const { return Evolution::Flow; }

  /// Called with a checked dataset of which no record brings derivatives.
  virtual std::optional<Vector> do_target_noise(const Dataset& data,
                                                const Vector& state_noise) const = 0;

  /// The form with what it leaves open chosen for these records; null when nothing is open.
  virtual std::shared_ptr<const Formulation> do_fit(const Dataset&,
                                                    const std::optional<Vector>&) const {
    return nullptr;
  }
};

/// The form with those of its parameters that were left open chosen for these records, so that
/// they are chosen once; the form itself when none is. @param data checked (check_dataset).
/// @param noise of the states (estimate_noise) where it is known already.
/// @throws ArgumentError when noise is not one number per state; DataError as check_form().
Stage<Formulation> fitted_to(const Stage<Formulation>& form, const Dataset& data,
                             const std::optional<Vector>& noise = {});

}  // namespace lacuna
