// SPDX-License-Identifier: MIT
// A diagnosis of the oscillator that is asked for, with all that its Problem refers to.
#pragma once

#include <memory>

#include "lacuna/diagnose/hypotheses/composite_model.hpp"
#include "support/driven_oscillator.hpp"

namespace lacuna::support {

struct Asked {
  BoundRecords records;
  DiagnosisOptions options = {.effects = {}};  ///< none but those that a test gives
  OdeModel nominal = oscillator();
  RunContext context = {};

  Problem problem() const { return {nominal, records, options, context}; }
  std::shared_ptr<const Baseline> baseline() const {
    return std::make_shared<const Baseline>(plain_baseline(problem()));
  }
  CompositeModel bare() const { return bare_composite(problem(), "bare", baseline()); }
};

inline Asked asked(const Hidden& hidden, double noise = 0.01,
                   const std::vector<Stage<Effect>>& effects = {}) {
  return {.records = observed(hidden_record(hidden, noise)), .options = {.effects = effects}};
}

/// A composite model in which nobody measured a state, and its equation is a hundredth of itself.
inline CompositeModel turned_off(CompositeModel composite, Index state) {
  const auto k = static_cast<std::size_t>(state);
  Baseline base = *composite.base;
  base.fit_options.hidden.assign(base.fitted.model.states().size(), false);
  base.fit_options.hidden[k] = true;
  composite.base = std::make_shared<const Baseline>(std::move(base));
  OdeModel& fitted = composite.explanation.fit.model;
  std::vector<Equation> equations = fitted.equations();
  for (WeightedTerm& summand : equations[k]) summand.coefficient *= 0.01;
  fitted = fitted.with_equations(std::move(equations));
  return composite;
}

/// Forces of 1.5 sin(6 q): a function of q that no effect has a name for.
inline double ripple(double, double q, double) { return 1.5 * std::sin(6.0 * q); }

}  // namespace lacuna::support
