// SPDX-License-Identifier: MIT
#include "refit.hpp"

#include <algorithm>

#include "bases/expressions.hpp"
#include "lacuna/core/base/error.hpp"
#include "regression/filters/none.hpp"
#include "regression/pruners/keep_all.hpp"
#include "solvers/ols.hpp"
#include "trajectories/refiners/no_refiner.hpp"
#include "trajectories/refiners/trajectory_selection.hpp"

namespace lacuna {
namespace {

/// The stages that fit, without those that choose.
Pipeline fitting_stages(const Pipeline& pipeline, const Dataset& data, const OdeModel& model) {
  Pipeline fitting = pipeline;
  fitting.equations.clear();
  ExpressionsOptions library;
  for (Index k = 0; k < model.dimension(); ++k) {
    if (data.rate_state(k)) continue;
    const auto place = static_cast<std::size_t>(k);
    EquationTerms equation{model.states()[place].name, {}};
    for (const WeightedTerm& summand : model.equations()[place]) {
      equation.terms.push_back(summand.term.name());
      if (std::find(library.terms.begin(), library.terms.end(), summand.term.name()) ==
          library.terms.end())
        library.terms.push_back(summand.term.name());
    }
    fitting.equations.push_back(std::move(equation));
  }
  fitting.basis = Expressions{std::move(library)};
  fitting.filter = NoFilter{};
  fitting.pruner = KeepAll{};
  fitting.regressor = Ols{};
  if (pipeline.refiner->info().name == TrajectorySelectionOptions::kInfo.name)
    fitting.refiner =
        TrajectorySelection{{.start = TrajectorySelectionOptions::Start::Model,
                             .penalty = 0.0,
                             .refit = false,
                             .negligible = {.effect_size = 0.0, .decisive = 1.0}}};
  else
    fitting.refiner = NoRefiner{};
  return fitting;
}

bool have_same_terms(const OdeModel& a, const OdeModel& b) {
  for (Index k = 0; k < a.dimension(); ++k) {
    const auto place = static_cast<std::size_t>(k);
    if (a.equations()[place].size() != b.equations()[place].size()) return false;
    for (const WeightedTerm& summand : a.equations()[place])
      if (b.coefficient(k, summand.term.name()) == 0.0) return false;
  }
  return true;
}

/// The terms of a model with the coefficients that these stages fit; none where one is lost.
std::optional<IdentificationResult> fitted_by(const Pipeline& fitting, const Dataset& data,
                                              const OdeModel& model,
                                              const RunContext& context) {
  for (Index k = 0; k < model.dimension(); ++k)
    if (!data.rate_state(k) && model.equations()[static_cast<std::size_t>(k)].empty())
      return std::nullopt;
  try {
    IdentificationResult fitted = identify(data, fitting, context);
    if (!have_same_terms(model, fitted.model)) return std::nullopt;
    return fitted;
  } catch (const DataError&) {
    return std::nullopt;  // stretches that are too short for the stages
  }
}

}  // namespace

std::optional<IdentificationResult> refitted_result_on(const Dataset& data,
                                                       const OdeModel& model,
                                                       const Pipeline& pipeline,
                                                       const RunContext& context) {
  return fitted_by(fitting_stages(pipeline, data, model), data, model, context);
}

std::optional<OdeModel> refitted_on(const Dataset& data, const OdeModel& model,
                                    const Pipeline& pipeline, const RunContext& context) {
  Pipeline fitting = fitting_stages(pipeline, data, model);
  fitting.start = model;
  auto fitted = fitted_by(fitting, data, model, context);
  return fitted ? std::optional(std::move(fitted->model)) : std::nullopt;
}

}  // namespace lacuna
