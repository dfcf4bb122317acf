// SPDX-License-Identifier: MIT
#include "refit.hpp"

#include <algorithm>

#include "lacuna/bases/expressions.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/regression/filters/none.hpp"
#include "lacuna/regression/pruners/keep_all.hpp"
#include "lacuna/solvers/ols.hpp"
#include "lacuna/trajectories/refiners/no_refiner.hpp"
#include "lacuna/trajectories/refiners/trajectory_selection.hpp"

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

}  // namespace

std::optional<IdentificationResult> refitted_result_on(const Dataset& data,
                                                       const OdeModel& model,
                                                       const Pipeline& pipeline,
                                                       const RunContext& context) {
  for (Index k = 0; k < model.dimension(); ++k)
    if (!data.rate_state(k) && model.equations()[static_cast<std::size_t>(k)].empty())
      return std::nullopt;
  try {
    IdentificationResult fitted =
        identify(data, fitting_stages(pipeline, data, model), context);
    if (!have_same_terms(model, fitted.model)) return std::nullopt;
    return fitted;
  } catch (const DataError&) {
    return std::nullopt;  // stretches that are too short for the stages
  }
}

std::optional<OdeModel> refitted_on(const Dataset& data, const OdeModel& model,
                                    const Pipeline& pipeline, const RunContext& context) {
  auto fitted = refitted_result_on(data, model, pipeline, context);
  return fitted ? std::optional(std::move(fitted->model)) : std::nullopt;
}

}  // namespace lacuna
