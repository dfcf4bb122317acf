// SPDX-License-Identifier: MIT
// From sample to sample along the records.
#pragma once

#include <vector>

#include "fit_engine.hpp"

namespace lacuna {

/// Working memory of one pass along a record.
struct RunScratch {
  explicit RunScratch(const FitEngine& engine)
      : slots(static_cast<std::size_t>(engine.rates.slots())),
        slopes(engine.states(), engine.signals.scheme.tableau->stages()),
        model(engine.count()) {}
  std::vector<double> slots;
  Matrix slopes;
  Vector model;
};

/// A path without values yet.
FitPath empty_path(const FitEngine& engine);

/// Writes a point of Rates at the begin of a step.
void fill_slots(const FitEngine& engine, Index step, const double* x,
                std::vector<double>& slots);

/// Writes the residuals at a sample; 0 where there is no value.
void compare(FitEngine& engine, Index sample, const Vector& x, RunScratch& scratch,
             Matrix& residuals);

/// Adds to a state what gains make of the residuals of a sample.
void correct(const Gains& gains, Index sample, const Matrix& residuals, Vector& x);

/// Ends a free run that has left the domain of the model: x is not a number then, and the path
/// says why.
void end_outside(FitEngine& engine, Index sample, Vector& x, RunScratch& scratch,
                 FitPath& path);

/// A path begins: what implicit steps know of another one must not decide on its steps.
void begin_path(FitEngine& engine);

/// Goes to the next sample by implicit steps; x is not a number where there are none.
/// @param sensitivity as of RadauFlow::advance().
void advance_implicitly(FitEngine& engine, Index sample, Vector& x,
                        Matrix* sensitivity = nullptr);

/// Goes to the next sample, keeping the states of all stages.
void advance(FitEngine& engine, Index sample, Vector& x, RunScratch& scratch,
             std::vector<Matrix>& stages);

/// The timed events of a sample, for a state that arrives there; s as of EventMaps::apply().
void jump(FitEngine& engine, Index sample, Vector& x, Matrix* s);

/// The same, the state that arrives noted in the path.
void arrive(FitEngine& engine, Index sample, Vector& x, FitPath& path);

}  // namespace lacuna
