// SPDX-License-Identifier: MIT
#include "refined_result.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/text.hpp"

namespace lacuna {
namespace {

/// The step of the path that is about a term, if there is one.
const PathStep* step_of(const RefinedModel& refined, Index equation, const std::string& term) {
  const auto found = std::find_if(
      refined.path.begin(), refined.path.end(),
      [&](const PathStep& step) { return step.equation == equation && step.term == term; });
  return found == refined.path.end() ? nullptr : &*found;
}

/// A term that the stages before had kept.
void enter_removal(const RefinedModel& refined, Index equation, const std::string& stage,
                   TrailEntry& entry) {
  const PathStep* step = step_of(refined, equation, entry.term);
  entry.kept = false;
  entry.stage = stage;
  entry.quantity = "decrease of chi squared by the term";
  entry.value = step ? step->gain : 0.0;
  entry.threshold = refined.path.empty() ? 0.0 : refined.path.front().penalty;
  entry.step = 1;
}

/// A term that was too small to be kept.
void enter_negligible(const NegligibleTerm& left, const std::string& stage, TrailEntry& entry) {
  entry = {.equation = entry.equation,
           .term = entry.term,
           .stage = stage,
           .quantity = "fraction of the rate that the term is worth",
           .value = left.effect,
           .threshold = left.threshold,
           .step = 1};
}

void enter_kept(double coefficient, TrailEntry& entry) {
  entry = {.equation = entry.equation,
           .term = entry.term,
           .kept = true,
           .quantity = "coefficient",
           .value = coefficient};
}

void rewrite_trail(const RefinedModel& refined, const std::string& stage,
                   IdentificationResult& result) {
  for (TrailEntry& entry : result.trail) {
    const Index equation = refined.model.state_index(entry.equation);
    const auto& summands = refined.model.equations()[static_cast<std::size_t>(equation)];
    const auto left = std::find_if(
        refined.negligible.begin(), refined.negligible.end(), [&](const NegligibleTerm& term) {
          return term.equation == equation && term.term == entry.term;
        });
    const auto found = std::find_if(
        summands.begin(), summands.end(),
        [&](const WeightedTerm& summand) { return summand.term.name() == entry.term; });
    if (result.fit[static_cast<std::size_t>(equation)].identity) continue;
    if (found != summands.end())
      enter_kept(found->coefficient, entry);
    else if (left != refined.negligible.end())
      enter_negligible(*left, stage, entry);
    else if (entry.kept)
      enter_removal(refined, equation, stage, entry);
  }
}

}  // namespace

std::optional<Index> tested_by(const Dataset& data, Index state) {
  std::optional<Index> tested = state;
  for (Index step = 0; step < data.state_count(); ++step) {
    if (data.is_measured(*tested)) return tested;
    std::optional<Index> origin;
    for (Index k = 0; k < data.state_count(); ++k)
      if (data.rate_state(k) == *tested) origin = k;
    if (!origin) break;
    tested = origin;
  }
  return std::nullopt;
}

Adequacy adequacy_of_equations(const std::vector<EquationFit>& fits) {
  std::vector<AdequacyPart> parts;
  for (const EquationFit& fit : fits) {
    if (fit.identity) continue;
    const Adequate adequate = !fit.fits_to_noise   ? Adequate::Undetermined
                              : *fit.fits_to_noise ? Adequate::Yes
                                                   : Adequate::No;
    parts.push_back({fit.equation, adequate, fit.rows, fit.noise_floor || fit.misfit});
  }
  return adequacy_of(std::move(parts));
}

namespace {

void judge(const Dataset& data, const RefinedModel& refined, IdentificationResult& result) {
  for (std::size_t k = 0; k < result.fit.size(); ++k) {
    EquationFit& fit = result.fit[k];
    const std::optional<Index> tested = tested_by(data, static_cast<Index>(k));
    if (fit.identity || !tested) continue;
    fit.misfit = refined.misfit[static_cast<std::size_t>(*tested)];
    fit.fits_to_noise = refined.fits_to_noise[static_cast<std::size_t>(*tested)];
    if (!fit.fits_to_noise || *fit.fits_to_noise) continue;
    const std::string off = format_number(*fit.misfit, 2) + " times the measurement noise";
    fit.doubt = "d" + fit.equation + "/dt: trajectories of the model " +
                (std::isfinite(*fit.misfit) ? "are off by " + off : "leave the range of numbers");
    result.warnings.push_back(fit.doubt);
  }
}

/// The largest residual of an equation relative to its target.
double unexplained(const IdentificationResult& result) {
  double worst = 0.0;
  for (const EquationFit& fit : result.fit)
    if (!fit.identity && fit.target_rms > 0.0)
      worst = std::max(worst, fit.residual_rms / fit.target_rms);
  return worst;
}

}  // namespace

bool apply_refiner(const Refiner& refiner, const KnownRecords& records,
                   const EquationLibraries& libraries, IdentificationResult& result,
                   const RunContext& context) {
  RefinedModel refined =
      refiner.refine({records.data, libraries.library, result.model, unexplained(result),
                      libraries.allowed, libraries.constraints, records.noise},
                     context);
  if (!refined.usable) {
    if (!refined.message.empty())
      result.warnings.push_back("not refined on the trajectories: " + refined.message);
    return false;
  }
  rewrite_trail(refined, "refiner " + std::string(refiner.info().name), result);
  judge(records.data, refined, result);
  for (Index k = 0; k < result.noise.size(); ++k)
    if (refined.noise[k] > 0.0) result.noise[k] = refined.noise[k];
  result.warnings.insert(result.warnings.end(), refined.notes.begin(), refined.notes.end());
  result.path = std::move(refined.path);
  result.model = std::move(refined.model);
  return true;
}

}  // namespace lacuna
