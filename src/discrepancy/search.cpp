// SPDX-License-Identifier: MIT
#include "search.hpp"

#include <algorithm>
#include <cmath>

namespace lacuna {
namespace {

std::string term_of(const FittedEffect& effect) {
  return bind_form(effect.candidate,
                   {effect.shapes.data(), static_cast<std::size_t>(effect.shapes.size())})
      .to_string();
}

std::string cause_of(const std::string& name, const std::vector<Stage<Effect>>& effects) {
  for (const Stage<Effect>& effect : effects)
    if (effect->info().name == name) return std::string(effect->typical_cause());
  return "";
}

NamedEffect name_effect(const RankedEffect& ranked, const Ranking& ranking,
                        const DiagnosisOptions& options) {
  constexpr std::size_t kAlternatives = 4;
  const FittedEffect& fitted = ranked.effect();
  NamedEffect named;
  named.equation = fitted.candidate.equation;
  named.name = fitted.candidate.effect;
  named.description = fitted.candidate.description;
  named.cause = cause_of(named.name, options.effects);
  named.sigma = ranked.sigma;
  named.contribution = ranked.contribution;
  named.probability = ranked.probability;
  for (const RankedEffect& other : ranking.effects) {
    if (&other == &ranked || named.alternatives.size() == kAlternatives) continue;
    named.alternatives.push_back(
        {other.effect().candidate.effect, term_of(other.effect()), other.probability});
  }
  return named;
}

NamedParameter parameter_of(const FittedEffect& fitted, std::size_t s) {
  const ShapeParameter& shape = fitted.candidate.shapes[s];
  const auto i = static_cast<Index>(s);
  NamedParameter parameter{shape.name, shape.unit, fitted.shapes[i], {}};
  if (i < fitted.shape_deviations.size() && fitted.shape_deviations[i] > 0.0)
    parameter.deviation = fitted.shape_deviations[i];
  return parameter;
}

/// Numbers of the joint fit into the names.
void update_numbers(const Explanation& explanation, std::vector<NamedEffect>& named) {
  for (std::size_t e = 0; e < named.size(); ++e) {
    const FittedEffect& fitted = explanation.effects[e];
    named[e].term = term_of(fitted);
    named[e].coefficient = fitted.coefficient;
    named[e].deviation = fitted.deviation;
    named[e].parameters.clear();
    for (std::size_t s = 0; s < fitted.candidate.shapes.size(); ++s)
      named[e].parameters.push_back(parameter_of(fitted, s));
  }
}

class Search {
 public:
  Search(const Dataset& data, const Assimilation& base, const Scope& scope,
         const AssimilationOptions& fit_options, const DiagnosisOptions& options,
         const RunContext& context)
      : data_(data),
        base_(base),
        scope_(scope),
        fit_options_(fit_options),
        options_(options),
        context_(context),
        result_{{{}, base}, {}, {}, {}} {}

  SearchResult run() {
    // An effect may take the place of another one, so that there may be more rounds than
    // effects.
    for (int round = 0; round < 2 * options_.max_effects; ++round) {
      if (static_cast<int>(result_.named.size()) >= options_.max_effects || !add_one()) break;
      look_back();
    }
    update_numbers(result_.explanation, result_.named);
    result_.left = test_structure(result_.explanation.fit, context_);
    return std::move(result_);
  }

 private:
  bool acceptable(const RankedEffect& ranked) const {
    return ranked.sigma >= options_.significance && ranked.contribution >= options_.substance;
  }

  bool add_one() {
    const Ranking ranking = rank(data_, base_, result_.explanation, options_.effects, scope_,
                                 fit_options_, options_.rank, context_);
    const auto best = std::find_if(ranking.effects.begin(), ranking.effects.end(),
                                   [&](const RankedEffect& r) { return acceptable(r); });
    Round round{ranking.tried, "", 0.0, best != ranking.effects.end()};
    if (!ranking.effects.empty()) {
      const RankedEffect& shown = round.accepted ? *best : ranking.effects.front();
      round.best = shown.effect().candidate.effect + ": " + term_of(shown.effect());
      round.sigma = shown.sigma;
    }
    result_.rounds.push_back(round);
    if (!round.accepted) return false;
    adopt(*best, name_effect(*best, ranking, options_));
    return true;
  }

  /// Takes an effect in, and those out whose place it takes.
  void adopt(const RankedEffect& best, NamedEffect named) {
    named.gap_closed = closed_by(best.explanation);
    for (auto place = best.replaced.rbegin(); place != best.replaced.rend(); ++place) {
      const auto old = result_.named.begin() + static_cast<std::ptrdiff_t>(*place);
      named.gap_closed = std::min(1.0, named.gap_closed + old->gap_closed);
      result_.named.erase(old);
    }
    result_.named.push_back(std::move(named));
    result_.explanation = best.explanation;
  }

  /// Share of the nominal model's disturbance variance that goes with the newest effect.
  double closed_by(const Explanation& next) const {
    const Index k = next.effects.back().candidate.equation;
    const double first = std::pow(base_.noise.disturbance[k], 2);
    const double before = std::pow(result_.explanation.fit.noise.disturbance[k], 2);
    const double after = std::pow(next.fit.noise.disturbance[k], 2);
    return first > 0.0 ? std::clamp((before - after) / first, 0.0, 1.0) : 0.0;
  }

  /// Takes out an effect whose coefficient is no longer told from 0.
  void look_back() {
    for (std::size_t e = 0; e + 1 < result_.explanation.effects.size(); ++e) {
      const FittedEffect& effect = result_.explanation.effects[e];
      if (std::abs(effect.coefficient) >= options_.significance * effect.deviation) continue;
      std::vector<FittedEffect> rest = result_.explanation.effects;
      rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(e));
      Explanation smaller = explain(data_, base_, rest, fit_options_, context_);
      if (criterion_of(smaller) > criterion_of(result_.explanation)) continue;
      result_.explanation = std::move(smaller);
      result_.named.erase(result_.named.begin() + static_cast<std::ptrdiff_t>(e));
      return;
    }
  }

  const Dataset& data_;
  const Assimilation& base_;
  const Scope& scope_;
  const AssimilationOptions& fit_options_;
  const DiagnosisOptions& options_;
  const RunContext& context_;
  SearchResult result_;
};

}  // namespace

bool is_substantial(const EquationStructure& structure, const DiagnosisOptions& options) {
  return structure.sigma >= options.significance && structure.relative >= options.substance;
}

double criterion_of(const Explanation& explanation) {
  return explanation.fit.deviance + static_cast<double>(explanation.parameters()) *
                                        std::log(static_cast<double>(explanation.fit.used));
}

SearchResult name_free_input(const RankedEffect& input, const Assimilation& base,
                             const DiagnosisOptions& options, std::vector<Round> rounds,
                             const RunContext& context) {
  SearchResult result{
      input.explanation, {name_effect(input, {}, options)}, std::move(rounds), {}};
  update_numbers(result.explanation, result.named);
  const Index k = result.named.front().equation;
  const double share = input.explanation.fit.noise.disturbance[k] / base.noise.disturbance[k];
  result.named.front().gap_closed = std::clamp(1.0 - share * share, 0.0, 1.0);
  result.rounds.push_back({1, "unmeasured-input", input.sigma, true});
  result.left = test_structure(input.explanation.fit, context);
  std::erase_if(result.left, [&](const EquationStructure& structure) {
    return structure.equation >= base.model.dimension();
  });
  return result;
}

SearchResult search_effects(const Dataset& data, const Assimilation& base, const Scope& scope,
                            const AssimilationOptions& fit_options,
                            const DiagnosisOptions& options, const RunContext& context) {
  return Search(data, base, scope, fit_options, options, context).run();
}

}  // namespace lacuna
