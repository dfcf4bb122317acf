// SPDX-License-Identifier: MIT
// What solvers leave in a record is no structure: a smaller version of study_solver_noise.
#include <gtest/gtest.h>

#include <algorithm>

#include "benchmarks/studies/solver_noise/records.hpp"
#include "lacuna/identify/pipeline/presets.hpp"

namespace lacuna::benchmarks {
namespace {

std::vector<std::vector<std::string>> terms_of_model(const OdeModel& model) {
  std::vector<std::vector<std::string>> structure;
  for (const Equation& equation : model.equations()) {
    std::vector<std::string>& names = structure.emplace_back();
    for (const WeightedTerm& summand : equation) names.push_back(summand.term.name());
    std::sort(names.begin(), names.end());
  }
  return structure;
}

const Flow& flow_of(const std::vector<Flow>& all, const std::string& name) {
  return *std::find_if(all.begin(), all.end(),
                       [&](const Flow& flow) { return flow.name == name; });
}

TEST(SolverNoise, IsNoStructure) {
  const std::vector<Flow> all = flows();
  using Solver = Making::Solver;
  const Making makings[] = {
      {"", Solver::Quartic, 1e-6}, {"", Solver::Fixed, 0.0, 1}, {"", Solver::Exact, 0.0, 1, 6}};
  for (const char* name : {"Lorenz", "van der Pol", "linear chain"})
    for (const Making& making : makings)
      for (const char* method : {"algorithm1", "robust"}) {
        const Flow& flow = flow_of(all, name);
        const OdeModel found = identify(solver_record(flow, making), preset(method)).model;
        EXPECT_EQ(terms_of_model(found), terms_of_model(flow.model))
            << name << ' ' << making.tolerance << ' ' << making.digits << ' ' << method;
      }
}

TEST(SolverNoise, TermsThatWereTooSmallAreInTheTrail) {
  const std::vector<Flow> all = flows();
  const Flow& lorenz = flow_of(all, "Lorenz");
  const IdentificationResult result =
      identify(solver_record(lorenz, {"", Making::Solver::Quartic, 1e-6}), preset("robust"));
  const auto count =
      std::count_if(result.trail.begin(), result.trail.end(), [](const TrailEntry& entry) {
        return entry.quantity == "fraction of the rate that the term is worth" && !entry.kept &&
               entry.value < entry.threshold;
      });
  EXPECT_GT(count, 0);
  for (const EquationFit& fit : result.fit) EXPECT_TRUE(fit.fits_to_noise.value_or(false));
}

}  // namespace
}  // namespace lacuna::benchmarks
