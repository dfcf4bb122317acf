// SPDX-License-Identifier: MIT
// A model with a state that was not measured, fitted to what was.
#pragma once

#include <string>

#include "lacuna/core/base/run_context.hpp"
#include "lacuna/data/records/dataset.hpp"
#include "lacuna/model/equations/ode_model.hpp"
#include "lacuna/model/equations/term.hpp"
#include "trajectories/shooting/refine.hpp"

namespace lacuna {

/// Residuals below this fraction of a state's deviation are those of digits and steps.
inline constexpr double kDigitsAndSteps = 1e-5;

/// Fits all coefficients of a model whose last state is hidden, but that of the hidden state in
/// the equation of the measured state `of`, which sets its scale.
Refinement fit_hidden(OdeModel model, Index of, const Dataset& data, bool may_be_cut,
                      const RunContext& context);

/// Schwarz' criterion of a fit of N samples of each measured state q with P coefficients, in W
/// windows that each have an initial state of their own:
///
///   sum_q 2 N ln(rms_q) + ln(N) (P + W m).
///
/// What is below kDigitsAndSteps counts as that.
double criterion(const Refinement& fit);

/// Where a model leaves more than noise, or follows the records in short windows only: the term
/// of the hidden state's equation that lowers the criterion most, taken on the trajectories,
/// and terms of any equation left out as long as it falls; the model as it was where that does
/// not explain the records. Rows of derivatives show little of such a term under noise: a
/// constant that seeds growth is nowhere large.
/// @param library in the variables of the model. @param period samples that a model has to
/// follow.
/// @throws Cancelled; past the deadline the fit is the best one by then.
Refinement with_a_term_of_trajectories(Refinement fit, Index of, const Dataset& data,
                                       const TermLibrary& library, Index period,
                                       const RunContext& context);

/// Whether a model follows the records over a period: in shorter windows, each with a hidden
/// state of its own, many models do.
bool spans(const Refinement& fit, Index period);

/// Whether nothing but noise is left in windows of a period.
bool is_explained(const Refinement& fit, Index period);

/// Whether the residual of a state is that of digits and steps.
bool is_clean(const Refinement& fit, const ResidualStatistics& residual);

/// Whether nothing but noise, or digits and steps, is left of a state.
bool is_explained(const Refinement& fit, const ResidualStatistics& residual);

}  // namespace lacuna
