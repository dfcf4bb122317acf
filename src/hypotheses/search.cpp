// SPDX-License-Identifier: MIT
#include "hypotheses/search.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "decision/substance.hpp"
#include "lacuna/core/text.hpp"

namespace lacuna {
namespace {

std::string term_of(const FittedEffect& effect) {
  return bind_form(effect.candidate,
                   {effect.shapes.data(), static_cast<std::size_t>(effect.shapes.size())})
      .to_string();
}

std::vector<NamedParameter> parameters_of(const FittedEffect& fitted, const Name& name) {
  std::vector<NamedParameter> parameters;
  for (std::size_t s = 0; s < name.parameters.size(); ++s)
    parameters.push_back({name.parameters[s], fitted.candidate.shapes[s].unit, 0.0, {}});
  return parameters;
}

/// The effect under another of its names.
void take_name(const FittedEffect& fitted, const Name& name, NamedEffect& named) {
  named.name = name.name;
  named.description = name.sentence;
  named.cause = name.cause;
  named.parameters = parameters_of(fitted, name);
}

/// First the other names of the same form, then the other forms.
std::vector<Alternative> alternatives_of(const RankedEffect& ranked, const Ranking& ranking) {
  constexpr std::size_t kAlternatives = 4;
  std::vector<Alternative> result;
  const auto add = [&](const RankedEffect& other, const Name& name) {
    if (result.size() < kAlternatives)
      result.push_back({name.name, term_of(other.effect()), other.probability});
  };
  for (std::size_t i = 1; i < ranked.names.size(); ++i) add(ranked, ranked.names[i]);
  const Candidate& own = ranked.effect().candidate;
  for (const RankedEffect& other : ranking.effects) {
    const Candidate& candidate = other.effect().candidate;
    if (are_one_form(candidate, own) && other.effect().shapes == ranked.effect().shapes)
      continue;
    for (const Name& name : other.names)
      if (name.name != ranked.names.front().name || !in_one_place(candidate, own))
        add(other, name);
  }
  return result;
}

NamedEffect name_effect(const RankedEffect& ranked, const Ranking& ranking) {
  const FittedEffect& fitted = ranked.effect();
  NamedEffect named;
  named.equation = fitted.candidate.equation;
  take_name(fitted, ranked.names.front(), named);
  named.sigma = ranked.sigma;
  named.contribution = ranked.contribution;
  named.probability = ranked.probability;
  named.alternatives = alternatives_of(ranked, ranking);
  return named;
}

/// What makes a name less plain: shape parameters and memory, then the depth of its formula.
std::pair<Index, int> intricacy(const FittedEffect& effect) {
  const std::span<const double> shapes(effect.shapes.data(),
                                       static_cast<std::size_t>(effect.shapes.size()));
  return {effect.candidate.intricacy(), bind_form(effect.candidate, shapes).depth()};
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
        other.sigma >= options.significance && other.contribution >= options.substance &&
        intricacy(other.effect()) < intricacy(ranked.effect()))
      result.push_back({name_effect(other, ranking), other.effect()});
  std::stable_sort(result.begin(), result.end(), [](const Plainer& a, const Plainer& b) {
    return intricacy(a.effect) < intricacy(b.effect);
  });
  return result;
}

/// How large a free input is and how long it remembers: ", 0.3 m/s^2 rms over 2 s".
std::string size_of_input(const RankedEffect& input, const OdeModel& model) {
  const auto k = static_cast<std::size_t>(input.effect().candidate.equation);
  const double rms =
      input.contribution * rate_rms(input.explanation.fit)[static_cast<Index>(k)];
  const std::string& unit = model.states()[k].unit;
  return ", " + format_number(rms, 2) + " " + (unit.empty() ? "1" : unit) + "/" +
         model.time_unit() + " rms over " + format_number(input.effect().shapes[0], 2) + " " +
         model.time_unit();
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
        table_{options.effects, scope, options.rank.naming},
        substance_(base, data, fit_options, context),
        result_{{{}, base}, {}, {}, {}} {}

  SearchResult run() {
    do {
      result_.left = test_structure(result_.explanation.fit, context_);
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
    if (static_cast<int>(result_.named.size()) >= options_.max_effects) return false;
    return result_.named.empty() ||
           std::any_of(result_.left.begin(), result_.left.end(),
                       [&](const auto& left) { return is_substantial(left, options_); });
  }

  bool acceptable(const RankedEffect& ranked) const {
    return ranked.sigma >= options_.significance && ranked.contribution >= options_.substance &&
           has_a_part(ranked.effect()) &&
           (result_.named.empty() ||
            substance_.counts(result_.explanation, ranked.explanation));
  }

  /// Whether the gain is the effect's own: with a coefficient that is not told from 0 it is
  /// that of effects before it, whose shapes have moved.
  bool has_a_part(const FittedEffect& effect) const {
    return std::abs(effect.coefficient) >= options_.significance * effect.deviation;
  }

  /// The best effect that may come in, or take the place of another form of itself.
  bool add_one() {
    const Ranking ranking = rank(data_, result_.explanation, options_.effects, scope_,
                                 fit_options_, options_.rank, context_);
    Round round{ranking.tried, "", 0.0, false};
    if (!ranking.effects.empty()) show(ranking.effects.front(), round);
    for (const RankedEffect& ranked : ranking.effects) {
      if (!acceptable(ranked)) continue;
      const auto other = other_form_of(ranked);
      round.accepted = other ? replace(*other, ranked, ranking) : add(ranked, ranking);
      if (!round.accepted) continue;
      show(ranked, round);
      break;
    }
    result_.rounds.push_back(round);
    return round.accepted;
  }

  static void show(const RankedEffect& ranked, Round& round) {
    round.best = ranked.names.front().name + ": " + term_of(ranked.effect());
    round.sigma = ranked.sigma;
  }

  bool add(const RankedEffect& ranked, const Ranking& ranking) {
    result_.named.push_back(name_effect(ranked, ranking));
    result_.named.back().gap_closed = closed_by(ranked.explanation);
    plainer_.push_back(plainer_than(ranked, ranking, options_));
    result_.explanation = ranked.explanation;
    look_back();
    return true;
  }

  /// An effect that is there already in another form: dry friction as sign(v) when tanh(v/w)
  /// comes, or a special case of the candidate.
  std::optional<std::size_t> other_form_of(const RankedEffect& ranked) const {
    const std::vector<FittedEffect>& effects = result_.explanation.effects;
    for (std::size_t e = 0; e < effects.size(); ++e)
      if (!are_one_form(effects[e].candidate, ranked.effect().candidate) &&
          are_forms_of_one(effects[e], result_.named[e].name, ranked.effect(),
                           ranked.names.front().name, scope_))
        return e;
    return std::nullopt;
  }

  /// Puts another form of an effect in its place, when that is better.
  bool replace(std::size_t old, const RankedEffect& ranked, const Ranking& ranking) {
    std::vector<FittedEffect> effects = result_.explanation.effects;
    effects[old] = ranked.effect();
    Explanation next = explain(data_, scope_.model, result_.explanation.fit, std::move(effects),
                               fit_options_, context_);
    if (!(criterion_of(next) < criterion_of(result_.explanation) - kUndecided) ||
        !all_plausible(next))
      return false;
    const double closed = result_.named[old].gap_closed;
    result_.named[old] = name_effect(ranked, ranking);
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
    return std::none_of(next.effects.begin(), next.effects.end(), [&](const FittedEffect& one) {
      return table_.names_of(one, next.fit.model).empty();
    });
  }

  /// Numbers may have moved since an effect was named: it gets the name that they have now.
  void settle_names() {
    for (std::size_t e = 0; e < result_.named.size(); ++e) {
      const FittedEffect& effect = result_.explanation.effects[e];
      const std::vector<Name> names = table_.names_of(effect, result_.explanation.fit.model);
      NamedEffect& named = result_.named[e];
      if (names.empty() || names.front().name == named.name) continue;
      take_name(effect, names.front(), named);
      std::erase_if(named.alternatives, [&](const Alternative& alternative) {
        return alternative.name == named.name;
      });
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
            return left.equation == equation && is_substantial(left, options_);
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
    result_.left = test_structure(result_.explanation.fit, context_);
    return true;
  }

  const Dataset& data_;
  const Assimilation& base_;
  const Scope& scope_;
  const AssimilationOptions& fit_options_;
  const DiagnosisOptions& options_;
  const RunContext& context_;
  const NameTable table_;
  const Substance substance_;
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
    for (std::size_t s = 0; s < named[e].parameters.size(); ++s) {
      const auto i = static_cast<Index>(s);
      const bool known = i < fitted.shape_deviations.size() && fitted.shape_deviations[i] > 0.0;
      NamedParameter& parameter = named[e].parameters[s];
      parameter.value = fitted.shapes[i];
      parameter.deviation = known ? std::optional(fitted.shape_deviations[i]) : std::nullopt;
    }
  }
}

bool is_substantial(const EquationStructure& structure, const DiagnosisOptions& options) {
  return structure.sigma >= options.significance && structure.relative >= options.substance;
}

double criterion_of(const Explanation& explanation) {
  return explanation.fit.deviance + static_cast<double>(explanation.parameters()) *
                                        std::log(static_cast<double>(explanation.fit.used));
}

SearchResult name_free_input(const RankedEffect& input, const Assimilation& base,
                             const DiagnosisOptions& /*options*/, std::vector<Round> rounds,
                             const RunContext& context) {
  SearchResult result{input.explanation, {name_effect(input, {})}, std::move(rounds), {}};
  update_numbers(result.explanation, result.named);
  const Index k = result.named.front().equation;
  result.named.front().description += size_of_input(input, base.model);
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
