// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/core/base/run_context.hpp"
#include "lacuna/data/records/dataset.hpp"
#include "lacuna/diagnose/criterion/options.hpp"
#include "lacuna/diagnose/diagnosis.hpp"

namespace lacuna {

/// Finds what a nominal model lacks: brings it onto the records, lets hypotheses propose
/// composite models of the disagreement (effects one after another, an input that was not
/// measured, noise with a memory, identities that do not hold), judges all by one criterion,
/// and measures the gap that the best one leaves on records that were not used. These may lower
/// the verdict or withdraw a name, and never choose one. Before that the records are looked at
/// (look_at()): where a slip of units, signs or columns is the likelier cause, no effect is
/// named, and where it keeps the model from the records the hint is all of the answer.
/// Past the deadline of the context, and with DiagnosisOptions::effort quick, the answer is the
/// best composite model that was judged by then; `stages` names those that were left out, and
/// what is named is not "explained" where something that may stand in its place was not judged.
/// @code
///   const OdeModel nominal = read_model("pendulum.ode");
///   const Diagnosis found = diagnose(nominal, read_dataset({"run.csv"}));
///   std::cout << format_text(found);
/// @endcode
/// @param nominal a flow of m states and p inputs.
/// @param data records to find effects in, n x m and n x p, in their units. Where their first
///   states and inputs are those of the model, inputs behind those are columns that it does not
///   know; else they are put into its variables by name (model_view()).
/// @param held_out records to gauge on; when empty the last quarter of each record in `data` is
///   kept back.
/// @throws DataError, ArgumentError when the records do not fit the model; Cancelled.
Diagnosis diagnose(const OdeModel& nominal, const Dataset& data, const Dataset& held_out = {},
                   const DiagnosisOptions& options = {}, const RunContext& context = {});

}  // namespace lacuna
