// SPDX-License-Identifier: MIT
#pragma once

#include "equation_terms.hpp"
#include "lacuna/core/base/run_context.hpp"
#include "lacuna/regression/linear/least_squares_system.hpp"
#include "lacuna/regression/stages/solvers.hpp"

namespace lacuna {

/// What equations are chosen in: rows of candidates, and which of these come into question.
struct EquationProblem {
  EquationLibraries libraries;
  LeastSquaresSystem system;
  FilterResult filtered;
  Index left_out = 0;       ///< candidates that there was no time for
  bool is_filtered = true;  ///< or there was no time for the filter
};

/// Reads the rows and filters the candidates. Past the deadline: rows of the cheap_terms() of a
/// library that all equations share, and without the filter. A team takes its time, for all of
/// its members have to do the same.
/// @throws DataError, ConfigError as the stages do; Cancelled on a stop request.
EquationProblem equation_problem(const RecordStream& records, const Pipeline& pipeline,
                                 EquationLibraries libraries, const RunContext& context);

}  // namespace lacuna
