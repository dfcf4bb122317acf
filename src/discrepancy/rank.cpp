// SPDX-License-Identifier: MIT
#include "lacuna/discrepancy/rank.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "lacuna/discrepancy/significance.hpp"
#include "lacuna/discrepancy/structure.hpp"

namespace lacuna {
namespace {

std::vector<Candidate> all_candidates(const std::vector<Stage<Effect>>& effects,
                                      const Scope& scope, const Explanation& current) {
  std::vector<Candidate> result;
  const std::vector<std::string> taken = current.fit.model.variables().names();
  for (const Stage<Effect>& effect : effects)
    for (Index k = 0; k < scope.model.dimension(); ++k)
      for (Candidate& candidate : effect->candidates(scope, k))
        result.push_back(without_clash(std::move(candidate), taken));
  return result;
}

/// The best of each effect and equation, in the order of the screening: those that may be
/// significant and that are not far behind the best, whose lead only grows by an exact fit.
std::vector<ScreenedCandidate> short_list(const std::vector<ScreenedCandidate>& screened,
                                          Index count) {
  constexpr double kPossible = 2.0;  // standard deviations
  constexpr double kFarBehind = 0.05;
  std::vector<ScreenedCandidate> result;
  const auto tried = static_cast<double>(screened.size());
  const double best = screened.empty() ? 0.0 : screened.front().gain;
  std::set<std::pair<std::string, Index>> seen;
  for (const ScreenedCandidate& candidate : screened) {
    if (static_cast<Index>(result.size()) == count) break;
    const double freedom = 1.0 + static_cast<double>(candidate.shapes.size());
    if (candidate.gain < kFarBehind * best ||
        sigma_of_gain(candidate.gain, freedom, tried) < kPossible)
      continue;
    if (seen.insert({candidate.candidate.effect, candidate.candidate.equation}).second)
      result.push_back(candidate);
  }
  return result;
}

/// rms of coefficient x form over that of the rate of the state it acts on.
double contribution_of(const FittedEffect& effect, const Assimilation& fit) {
  const Candidate candidate = without_clash(effect.candidate, fit.model.variables().names());
  double sum = 0.0;
  Index count = 0;
  for (const LinearisedRecord& record : fit.records) {
    const Vector values = form_along(
        candidate, {effect.shapes.data(), static_cast<std::size_t>(effect.shapes.size())},
        fit.model.variables(), record);
    const double mean = candidate.form == "1" ? 0.0 : values.mean();
    sum += (values.array() - mean).square().sum();
    count += values.size();
  }
  const double rms = std::abs(effect.coefficient) * std::sqrt(sum / static_cast<double>(count));
  if (candidate.place == Place::Channel) {
    const auto& path = fit.records.front().path.col(candidate.equation);
    return rms / std::sqrt((path.array() - path.mean()).square().mean());
  }
  return rms / rate_rms(fit)[candidate.equation];
}

class Ranker {
 public:
  Ranker(const Dataset& data, const Assimilation& base, const Explanation& current,
         const AssimilationOptions& options, const RunContext& context)
      : data_(data), base_(base), current_(current), options_(options), context_(context) {}

  RankedEffect refit(const ScreenedCandidate& screened, double tried) const {
    std::vector<FittedEffect> effects = current_.effects;
    effects.push_back({screened.candidate, screened.shapes, screened.coefficient, 0.0});
    RankedEffect ranked{explain(data_, nominal_start(), effects, options_, context_)};
    const double log_samples = std::log(static_cast<double>(ranked.explanation.fit.used));
    const double deviance = ranked.explanation.fit.deviance;
    ranked.criterion =
        deviance + static_cast<double>(ranked.explanation.parameters()) * log_samples;
    ranked.gain = current_.fit.deviance - deviance;
    ranked.sigma =
        sigma_of_gain(ranked.gain, 1.0 + static_cast<double>(screened.shapes.size()), tried);
    ranked.contribution = contribution_of(ranked.effect(), ranked.explanation.fit);
    return ranked;
  }

 private:
  const Assimilation& nominal_start() const { return base_; }

  const Dataset& data_;
  const Assimilation& base_;
  const Explanation& current_;
  const AssimilationOptions& options_;
  const RunContext& context_;
};

bool is_plausible(const RankedEffect& ranked, const std::vector<Stage<Effect>>& effects,
                  const Scope& scope) {
  const FittedEffect& fitted = ranked.effect();
  for (const Stage<Effect>& effect : effects)
    if (effect->info().name == fitted.candidate.effect)
      return effect->plausible(
          scope, fitted.candidate,
          {ranked.explanation.fit.model, fitted.coefficient, fitted.deviation, fitted.shapes});
  return true;
}

void set_probabilities(Ranking& ranking, double none_criterion) {
  double least = none_criterion;
  for (const RankedEffect& effect : ranking.effects) least = std::min(least, effect.criterion);
  double sum = std::exp(-0.5 * (none_criterion - least));
  ranking.none = sum;
  for (RankedEffect& effect : ranking.effects) {
    effect.probability = std::exp(-0.5 * (effect.criterion - least));
    sum += effect.probability;
  }
  ranking.none /= sum;
  for (RankedEffect& effect : ranking.effects) effect.probability /= sum;
}

/// The plainer of two names goes first where the data cannot tell them apart.
void put_plainer_first(std::vector<RankedEffect>& effects) {
  constexpr double kUndecided = 6.0;  // 2 log 20
  if (effects.empty()) return;
  for (int guard = 0; guard < 4; ++guard) {
    const auto& plainer = effects.front().effect().candidate.plainer;
    if (!plainer) return;
    const double limit = effects.front().criterion + kUndecided;
    const auto place =
        std::find_if(effects.begin() + 1, effects.end(), [&](const RankedEffect& other) {
          return other.effect().candidate.effect == *plainer && other.criterion <= limit &&
                 other.effect().candidate.equation ==
                     effects.front().effect().candidate.equation;
        });
    if (place == effects.end()) return;
    std::rotate(effects.begin(), place, place + 1);
  }
}

}  // namespace

Ranking rank(const Dataset& data, const Assimilation& base, const Explanation& current,
             const std::vector<Stage<Effect>>& effects, const Scope& scope,
             const AssimilationOptions& options, const RankOptions& rank_options,
             const RunContext& context) {
  const Screening screening(current.fit);
  const std::vector<ScreenedCandidate> screened =
      screen(all_candidates(effects, scope, current), screening, context);
  Ranking ranking;
  for (const ScreenedCandidate& candidate : screened) ranking.tried += candidate.tried;
  const Ranker ranker(data, base, current, options, context);
  const std::vector<ScreenedCandidate> chosen = short_list(screened, rank_options.refits);
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    context.report("fitting candidates",
                   static_cast<double>(i) / static_cast<double>(chosen.size()));
    RankedEffect ranked = ranker.refit(chosen[i], static_cast<double>(screened.size()));
    if (std::isfinite(ranked.criterion) && is_plausible(ranked, effects, scope))
      ranking.effects.push_back(std::move(ranked));
  }
  std::stable_sort(ranking.effects.begin(), ranking.effects.end(),
                   [](const auto& a, const auto& b) { return a.criterion < b.criterion; });
  const double log_samples = std::log(static_cast<double>(current.fit.used));
  set_probabilities(
      ranking, current.fit.deviance + static_cast<double>(current.parameters()) * log_samples);
  put_plainer_first(ranking.effects);
  return ranking;
}

}  // namespace lacuna
