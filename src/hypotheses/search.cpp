// SPDX-License-Identifier: MIT
#include "search.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "effect_size.hpp"
#include "lacuna/core/text.hpp"
#include "lacuna/hypotheses/rank.hpp"

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
  named.tried = ranking.tried;
  for (const RankedEffect& other : ranking.effects) {
    const bool same_name = other.effect().candidate.effect == named.name;
    if (same_name && mean_the_same(ranked.effect(), other.effect())) continue;
    if (named.alternatives.size() == kAlternatives) break;
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

/// What makes a name less plain: shape parameters and memory, then the depth of its formula.
std::pair<std::size_t, int> intricacy(const FittedEffect& effect) {
  const Candidate& candidate = effect.candidate;
  const std::span<const double> shapes(effect.shapes.data(),
                                       static_cast<std::size_t>(effect.shapes.size()));
  return {candidate.shapes.size() + 2 * candidate.memory.size(),
          bind_form(candidate, shapes).depth()};
}

/// Another name for an effect.
struct Plainer {
  NamedEffect named;
  FittedEffect effect;
};

/// The names in a ranking that are plainer than one of them, plainest first.
std::vector<Plainer> plainer_than(const RankedEffect& ranked, const Ranking& ranking,
                                  const DiagnosisOptions& options) {
  std::vector<Plainer> result;
  const Candidate& candidate = ranked.effect().candidate;
  for (const RankedEffect& other : ranking.effects)
    if (other.effect().candidate.equation == candidate.equation &&
        other.effect().candidate.place == candidate.place &&
        other.sigma >= options.decision.significance &&
        other.contribution >= options.decision.effect_size &&
        intricacy(other.effect()) < intricacy(ranked.effect()))
      result.push_back({name_effect(other, ranking, options), other.effect()});
  std::stable_sort(result.begin(), result.end(), [](const Plainer& a, const Plainer& b) {
    return intricacy(a.effect) < intricacy(b.effect);
  });
  return result;
}

class Search {
 public:
  Search(const Problem& problem, const Baseline& base,
         const std::vector<Stage<Effect>>& effects)
      : data_(base.records->data),
        base_(base.fitted),
        scope_(base.scope),
        fit_options_(base.fit_options),
        options_(problem.options),
        effects_(effects),
        context_(problem.context),
        substance_(problem, base),
        result_{{{}, base.fitted}, {}, {}, {}} {}

  SearchResult run() {
    do {
      result_.left = test_disturbances(result_.explanation.fit, context_);
    } while (may_go_on() && add_one());
    prefer_plain();
    settle_names();
    update_numbers(result_.explanation, result_.named);
    return std::move(result_);
  }

 private:
  /// Later effects are sought only where something is left; the first one may be of a kind that
  /// a white disturbance hardly shows (a small constant, a line).
  bool may_go_on() const {
    if (static_cast<int>(result_.named.size()) >= options_.decision.max_effects) return false;
    return result_.named.empty() ||
           std::any_of(result_.left.begin(), result_.left.end(), [&](const auto& left) {
             return is_substantial(left, options_.decision);
           });
  }

  bool acceptable(const RankedEffect& ranked) const {
    return ranked.sigma >= options_.decision.significance &&
           ranked.contribution >= options_.decision.effect_size &&
           has_a_part(ranked.effect()) &&
           (result_.named.empty() ||
            substance_.counts(result_.explanation, ranked.explanation));
  }

  /// Whether the gain is the effect's own: with a coefficient that is not told from 0 it is
  /// that of effects before it, whose shapes have moved.
  bool has_a_part(const FittedEffect& effect) const {
    return std::abs(effect.coefficient) >= options_.decision.significance * effect.deviation;
  }

  /// The best effect that may come in, or take the place of another form of itself.
  bool add_one() {
    const Ranking ranking =
        rank(data_, result_.explanation, effects_, scope_, fit_options_,
             {options_.decision.rough_fits, options_.decision.exact_fits}, context_);
    Round round{ranking.tried, "", 0.0, false};
    if (!ranking.effects.empty()) show(ranking.effects.front(), round);
    for (const RankedEffect& ranked : ranking.effects) {
      if (!acceptable(ranked)) continue;
      const auto other = other_form_of(ranked.effect().candidate);
      round.accepted = other ? replace(*other, ranked, ranking) : add(ranked, ranking);
      if (!round.accepted) continue;
      show(ranked, round);
      break;
    }
    result_.rounds.push_back(round);
    return round.accepted;
  }

  static void show(const RankedEffect& ranked, Round& round) {
    round.best = ranked.effect().candidate.effect + ": " + term_of(ranked.effect());
    round.sigma = ranked.sigma;
  }

  bool add(const RankedEffect& ranked, const Ranking& ranking) {
    result_.named.push_back(name_effect(ranked, ranking, options_));
    result_.named.back().gap_closed = closed_by(ranked.explanation);
    plainer_.push_back(plainer_than(ranked, ranking, options_));
    result_.explanation = ranked.explanation;
    look_back();
    return true;
  }

  /// An effect that is there already, of the same name and of the same variable, in another
  /// form: dry friction as sign(v) when tanh(v/w) comes; or the plainer effect of which the
  /// candidate is a special case.
  std::optional<std::size_t> other_form_of(const Candidate& candidate) const {
    const std::vector<FittedEffect>& effects = result_.explanation.effects;
    for (std::size_t e = 0; e < effects.size(); ++e) {
      const Candidate& old = effects[e].candidate;
      const bool same_kind = old.effect == candidate.effect && old.form != candidate.form;
      if (old.equation == candidate.equation && old.argument == candidate.argument &&
          (same_kind || candidate.plainer == old.effect))
        return e;
    }
    return std::nullopt;
  }

  /// Puts another form of an effect in its place, when that is better.
  bool replace(std::size_t old, const RankedEffect& ranked, const Ranking& ranking) {
    std::vector<FittedEffect> effects = result_.explanation.effects;
    effects[old] = ranked.effect();
    Explanation next = explain(data_, scope_.model, result_.explanation.fit, std::move(effects),
                               fit_options_, context_);
    if (!(criterion_of(next) <
          criterion_of(result_.explanation) - options_.decision.undecided) ||
        !all_plausible(next))
      return false;
    const double closed = result_.named[old].gap_closed;
    result_.named[old] = name_effect(ranked, ranking, options_);
    const Index k = ranked.effect().candidate.equation;
    result_.named[old].gap_closed = std::clamp(closed + drop_of(next, k), 0.0, 1.0);
    plainer_[old] = plainer_than(ranked, ranking, options_);
    result_.explanation = std::move(next);
    return true;
  }

  /// Share of the nominal model's disturbance variance that goes with the newest effect.
  double closed_by(const Explanation& next) const {
    return std::clamp(drop_of(next, next.effects.back().candidate.equation), 0.0, 1.0);
  }

  double drop_of(const Explanation& next, Index k) const {
    const double first = std::pow(base_.noise.disturbance[k], 2);
    const double before = std::pow(result_.explanation.fit.noise.disturbance[k], 2);
    const double after = std::pow(next.fit.noise.disturbance[k], 2);
    return first > 0.0 ? (before - after) / first : 0.0;
  }

  /// Whether all effects have numbers such as they can have, by whatever name.
  bool all_plausible(const Explanation& next) const {
    return std::all_of(next.effects.begin(), next.effects.end(), [&](const FittedEffect& one) {
      return is_plausible(one, next.fit.model, effects_, scope_) ||
             other_name_of(one, next.fit.model, effects_, scope_);
    });
  }

  /// Numbers may have moved since an effect was named: what is then not plausible by its name
  /// gets that of the same term by which it is.
  void settle_names() {
    const OdeModel& model = result_.explanation.fit.model;
    for (std::size_t e = 0; e < result_.named.size(); ++e) {
      FittedEffect& effect = result_.explanation.effects[e];
      if (is_plausible(effect, model, effects_, scope_)) continue;
      const auto other = other_name_of(effect, model, effects_, scope_);
      if (!other) continue;
      NamedEffect& named = result_.named[e];
      std::erase_if(named.alternatives, [&](const Alternative& alternative) {
        return alternative.name == other->effect;
      });
      named.name = other->effect;
      named.description = other->description;
      named.cause = cause_of(named.name, effects_);
      effect.candidate = *other;
    }
  }

  /// Takes out effects that the newest one makes superfluous.
  void look_back() {
    while (take_out_one()) {
    }
  }

  /// Takes out the first effect that is not told from 0 any more, if the records are explained
  /// no worse without it by BIC.
  bool take_out_one() {
    for (std::size_t e = 0; e + 1 < result_.explanation.effects.size(); ++e) {
      if (has_a_part(result_.explanation.effects[e])) continue;
      std::vector<FittedEffect> rest = result_.explanation.effects;
      rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(e));
      Explanation smaller =
          explain(data_, scope_.model, result_.explanation.fit, rest, fit_options_, context_);
      if (criterion_of(smaller) > criterion_of(result_.explanation)) continue;
      result_.explanation = std::move(smaller);
      result_.named.erase(result_.named.begin() + static_cast<std::ptrdiff_t>(e));
      plainer_.erase(plainer_.begin() + static_cast<std::ptrdiff_t>(e));
      return true;
    }
    return false;
  }

  /// Where structure is left in the end, special names for it that the likelihood prefers give
  /// way to plain ones that leave hardly more.
  void prefer_plain() {
    for (std::size_t e = result_.named.size(); e-- > 0;) {
      const Index equation = result_.named[e].equation;
      const bool is_left =
          std::any_of(result_.left.begin(), result_.left.end(), [&](const auto& left) {
            return left.equation == equation && is_substantial(left, options_.decision);
          });
      if (!is_left) continue;
      for (Plainer& plainer : plainer_[e])
        if (put_in_place(e, plainer)) break;
    }
  }

  bool put_in_place(std::size_t e, Plainer& plainer) {
    std::vector<FittedEffect> effects = result_.explanation.effects;
    effects[e] = plainer.effect;
    Explanation next = explain(data_, scope_.model, result_.explanation.fit, std::move(effects),
                               fit_options_, context_);
    const Candidate& candidate = plainer.effect.candidate;
    if (!std::isfinite(next.fit.deviance) || !all_plausible(next) ||
        !substance_.is_near(next.fit, result_.explanation.fit, candidate))
      return false;
    const double closed = result_.named[e].gap_closed;
    result_.named[e] = plainer.named;
    result_.named[e].gap_closed =
        std::clamp(closed + drop_of(next, candidate.equation), 0.0, 1.0);
    result_.rounds.push_back(
        {1, plainer.named.name + ": " + term_of(plainer.effect), plainer.named.sigma, true});
    result_.explanation = std::move(next);
    result_.left = test_disturbances(result_.explanation.fit, context_);
    return true;
  }

  const Dataset& data_;
  const Assimilation& base_;
  const Scope& scope_;
  const AssimilationOptions& fit_options_;
  const DiagnosisOptions& options_;
  const std::vector<Stage<Effect>>& effects_;
  const RunContext& context_;
  const EffectSize substance_;
  SearchResult result_;
  std::vector<std::vector<Plainer>> plainer_;  ///< of each named effect, plainest first
};

}  // namespace

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

double criterion_of(const Explanation& explanation) {
  return explanation.fit.deviance + static_cast<double>(explanation.parameters()) *
                                        std::log(static_cast<double>(explanation.fit.used));
}

SearchResult search_effects(const Problem& problem, const Baseline& base,
                            const std::vector<Stage<Effect>>& effects) {
  return Search(problem, base, effects).run();
}

}  // namespace lacuna
