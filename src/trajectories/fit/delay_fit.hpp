// SPDX-License-Identifier: MIT
// Fits of models in which delays are estimated.
#pragma once

#include <functional>

#include "lacuna/trajectories/fit/fit.hpp"

namespace lacuna {

/// A fit of a model all of whose delays are known.
using FitOfKnownDelays = std::function<Fit(const SystemModel&, const FitOptions&)>;

/// The system with the delays that are to be estimated held where they are.
SystemModel with_delays_held(const SystemModel& system);

/// The largest likelihood over the parameters on which delays depend
/// (SystemModel::delay_parameters()), all other numbers fitted to each of their values: a grid
/// over the range of each, then Brent's method between its neighbours, one parameter after the
/// other until none moves by more than a tenth of its standard error. The standard error is
/// that of the parabola of the deviance, with the degrees of freedom of the fit and, where
/// residuals are not white, by the gradients of blocks (as of errors_of()); other numbers
/// follow a delay along their estimates, so that their variances grow by (d number/d delay)^2
/// times that of the delay, which is the inverse of the joint information. NumberSpread has the
/// other numbers alone.
/// @throws ModelError for a delay that differs from record to record.
Fit fit_with_delays(const SystemModel& system, const FitOptions& options,
                    const RunContext& context, const FitOfKnownDelays& fit_known);

}  // namespace lacuna
