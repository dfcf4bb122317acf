// SPDX-License-Identifier: MIT
#include "lacuna/identify/pipeline/presets.hpp"

#include "bases/monomials.hpp"
#include "core/base/text.hpp"
#include "data/derivatives/finite_differences.hpp"
#include "regression/filters/abm.hpp"
#include "regression/filters/none.hpp"
#include "regression/formulations/strong_form.hpp"
#include "regression/pruners/keep_all.hpp"
#include "regression/pruners/minor_terms.hpp"
#include "solvers/irls.hpp"
#include "solvers/ols.hpp"
#include "solvers/stlsq.hpp"
#include "trajectories/refiners/no_refiner.hpp"
#include "trajectories/refiners/trajectory_selection.hpp"

namespace lacuna {
namespace {

/// Algorithm 1 with its tolerances as published.
Pipeline published_algorithm1(Stage<Regressor> regressor) {
  return {.basis = Monomials{},
          .formulation = StrongForm{{.differentiator = FiniteDifferences{{.order = 4}}}},
          .filter = Abm{{.tolerances = AbmOptions::Tolerances::Paper, .eps = 1e-5}},
          .regressor = std::move(regressor),
          .pruner = MinorTerms{{.tolerances = MinorTermsOptions::Tolerances::Paper,
                                .criterion = MinorTermsOptions::Criterion::Contribution,
                                .eta = 1e-5}},
          .refiner = NoRefiner{}};
}

/// Differences of the order that the record itself requires.
Stage<Formulation> fitted_differences() {
  return StrongForm{{.differentiator = FiniteDifferences{}}};
}

}  // namespace

Pipeline algorithm1(Tolerances tolerances) {
  if (tolerances == Tolerances::Paper) return published_algorithm1(Ols{});
  return {.basis = Monomials{},
          .formulation = fitted_differences(),
          .filter = Abm{},
          .regressor = Ols{},
          .pruner = MinorTerms{},
          .refiner = TrajectorySelection{
              {.start = TrajectorySelectionOptions::Start::Model, .second_opinion = true}}};
}

Pipeline sindy() {
  return {.basis = Monomials{},
          .formulation = fitted_differences(),
          .filter = NoFilter{},
          .regressor = Stlsq{},
          .pruner = KeepAll{},
          .refiner = NoRefiner{}};
}

Pipeline robust() {
  return {.basis = Monomials{},
          .formulation = fitted_differences(),
          .filter = Abm{},
          .regressor = Ols{},
          .pruner = MinorTerms{},
          .refiner = TrajectorySelection{}};
}

const std::vector<Preset>& presets() {
  static const std::vector<Preset> all = {
      {"algorithm1",
       "ABM, then minor terms deleted from each equation while the fit stays good; refined on "
       "the "
       "trajectories where they are noisy.",
       "Karimov et al., Nonlinear Dynamics 111 (2023) 871, Algorithm 1", algorithm1, true},
      {"paper", "Algorithm 1 as published: minor terms deleted with IRLS, all tolerances raw.",
       "Karimov et al., Nonlinear Dynamics 111 (2023) 871, Algorithm 1, eq. (8)",
       [](Tolerances) {
         return published_algorithm1(Irls{{.tolerances = IrlsOptions::Tolerances::Paper}});
       },
       true},
      {"robust",
       "Terms chosen and coefficients fitted on the trajectories themselves, for noisy "
       "records.",
       "Bellman & Kalaba, Quasilinearization (1965)", [](Tolerances) { return robust(); }},
      {"sindy", "Sequentially thresholded least squares over all monomials.",
       "Brunton, Proctor & Kutz, PNAS 113 (2016) 3932", [](Tolerances) { return sindy(); }},
  };
  return all;
}

Pipeline preset(const std::string& name, Tolerances tolerances) {
  std::vector<std::string> known;
  for (const Preset& entry : presets()) {
    known.push_back(entry.name);
    if (entry.name != name) continue;
    if (tolerances == Tolerances::Paper && !entry.has_paper_tolerances)
      throw ConfigError("preset " + name, "it has no paper tolerances",
                        "leave out \"tolerances\" or take the preset algorithm1");
    return entry.make(tolerances);
  }
  throw ConfigError("preset", "there is no preset called '" + name + "'",
                    suggestion(name, known));
}

}  // namespace lacuna
