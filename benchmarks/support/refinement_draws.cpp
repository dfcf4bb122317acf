// SPDX-License-Identifier: MIT
#include "support/refinement_draws.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>

#include "core/base/random.hpp"
#include "core/base/text.hpp"
#include "lacuna/dynamics/integration/integrators.hpp"
#include "lacuna/dynamics/test_systems/test_systems.hpp"
#include "trajectories/shooting/cramer_rao.hpp"
#include "trajectories/shooting/refine.hpp"

namespace lacuna::benchmarks {
namespace {

constexpr double kStartError = 0.1;

Dataset clean_record(const RefinementCondition& condition) {
  const TestSystem& system = test_system(condition.system);
  return record_of(system.model, dopri8({.substeps = 4}), system.start, system.step,
                   condition.samples);
}

Vector noise_sigma(const Dataset& clean, double share) {
  const Matrix& x = clean.trajectories[0].states;
  const Matrix centred = x.rowwise() - x.colwise().mean();
  return share * (centred.colwise().norm().transpose() / std::sqrt(double(x.rows())));
}

ParametrisedModel displaced(const ParametrisedModel& truth, std::uint64_t seed) {
  Random random(seed);
  Vector values = truth.values();
  for (Index i = 0; i < values.size(); ++i)
    values[i] *= 1.0 + random.uniform(-kStartError, kStartError);
  return truth.with_values(values);
}

RefinementDraw run_draw(const RefinementCondition& condition, const Dataset& clean,
                        std::uint64_t seed) {
  const ParametrisedModel truth = with_free_coefficients(test_system(condition.system).model);
  const Dataset record = add_relative_noise(clean, condition.noise, seed);
  const auto start = std::chrono::steady_clock::now();
  const Refinement fit = refine(displaced(truth, seed), record);
  const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
  const Vector sigma = noise_sigma(clean, condition.noise);
  RefinementDraw draw;
  draw.converged = fit.status == RefineStatus::Converged;
  draw.errors = fit.model.values() - truth.values();
  draw.standard_errors = fit.standard_errors;
  draw.half_widths = (fit.ci95.col(1) - fit.ci95.col(0)) / 2.0;
  draw.bound = cramer_rao_bound(truth, clean, sigma, fit.windows);
  draw.whole_bound = cramer_rao_bound(truth, clean, sigma,
                                      equal_windows({0, condition.samples}, condition.samples));
  draw.seconds = time.count();
  draw.fits_to_noise = fit.fits_to_noise;
  return draw;
}

}  // namespace

std::vector<RefinementCondition> refinement_conditions() {
  std::vector<RefinementCondition> conditions;
  for (const char* system : {"lorenz", "rossler", "van-der-pol", "pendulum", "memristor"})
    for (const double noise : {0.001, 0.01, 0.05}) conditions.push_back({system, 1000, noise});
  return conditions;
}

std::optional<Refinements> run_refinements(const CellStore& store, std::size_t draws) {
  const std::vector<RefinementCondition> conditions = refinement_conditions();
  Cells<RefinementDraw> cells;
  for (const RefinementCondition& condition : conditions) {
    const auto clean = std::make_shared<const Dataset>(clean_record(condition));
    cells.add_draws(condition.system + " " + format_number(condition.noise), draws,
                    [=](std::size_t seed) { return run_draw(condition, *clean, seed); });
  }
  const auto finished = run_cells(store, cells);
  if (!finished) return {};
  Refinements all{{}, finished->origin};
  for (std::size_t k = 0; k < conditions.size(); ++k) {
    const auto group = finished->group(k);
    all.conditions.push_back({conditions[k], {group.begin(), group.end()}});
  }
  return all;
}

}  // namespace lacuna::benchmarks
