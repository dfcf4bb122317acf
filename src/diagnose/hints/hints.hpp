// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lacuna/diagnose/criterion/options.hpp"
#include "lacuna/records/binding/bound_records.hpp"
#include "lacuna/records/channels/hint.hpp"

namespace lacuna {

/// The hint that nothing moves, where each measured channel is white noise
/// (HintOptions::significance) no larger than barely_moving of its noise, or never changes; it
/// needs no model.
std::optional<Hint> stillness(const BoundRecords& records, const HintOptions& options);

/// A look at records before a model is diagnosed on them.
///
/// Rates in short windows of the records are compared with those of the model as it is given.
/// With y_k measured and f_k of the model the misfit of equation k is
/// e_k^2 = <(y_k - f_k)^2> / <y_k^2 + f_k^2>: 0 where they agree, 1 where they have nothing to
/// do with one another (one minus the concordance of Lin, Biometrics 45:255, 1989, about 0).
/// Slips of the time, of units, signs and columns are undone one by one; the one that takes
/// nearly all of the misfit away, more than a missing effect could, is the hint.
/// @param records in the variables of the model.
/// @param unused the same records with columns that the model does not know as inputs.
std::vector<Hint> look_at(const OdeModel& model, const BoundRecords& records,
                          const Dataset& unused, const HintOptions& options);

/// A nominal coefficient and how large it is by the records.
struct EstimatedCoefficient {
  Index equation = 0;
  std::string term;
  double ratio = 1.0;      ///< estimated over nominal
  double deviation = 0.0;  ///< standard error of the ratio
};

/// The slip of a unit or sign that a coefficient gives away after it was fitted: by itself it
/// does what that slip would do, to HintOptions::round_factor of the logarithm (of 10 for a
/// sign). Nothing is withheld: the fit has made up for it.
std::optional<Hint> coefficient_hint(const OdeModel& model, const Dataset& data,
                                     const EstimatedCoefficient& said,
                                     const HintOptions& options);

/// A factor of time that all coefficients give away after they were fitted and that is no unit:
/// each is the nominal one times that factor to the power that time has in it, to
/// HintOptions::round_factor of its logarithm. Nothing below HintOptions::identity_factor, of a
/// single coefficient, or where an identity or a function of time has one.
/// @param said of all coefficients.
std::optional<Hint> clock_hint(const OdeModel& model, const Dataset& data,
                               const std::vector<EstimatedCoefficient>& said,
                               const HintOptions& options);

}  // namespace lacuna
