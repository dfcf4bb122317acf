// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "channel_forms.hpp"
#include "core/base/parallel.hpp"
#include "core/base/text.hpp"
#include "core/statistics/significance.hpp"
#include "diagnose/candidates/screening.hpp"
#include "diagnose/hypotheses/rough_fits.hpp"
#include "diagnose/hypotheses/sensor_fault.hpp"
#include "diagnose/search/effect_names.hpp"

namespace lacuna {
namespace {

/// A channel's form, and effects that act beside it.
using Effects = std::vector<FittedEffect>;

/// A channel with a form, fitted with the nominal coefficients as given.
struct Fitted {
  Explanation explanation;
  std::vector<EquationStructure> left;
  double criterion = 0.0;
};

/// The baseline whose coefficients are those that are given.
Baseline as_given(const Baseline& base) {
  Baseline given = base;
  given.fitted = base.given;
  given.fit_options.free.clear();
  given.fit_options.priors.clear();
  return given;
}

/// Of channels that show a state; those that show a formula have no state of the scope.
std::vector<Candidate> candidates_of(const Problem& problem, const Baseline& base) {
  std::vector<Candidate> all;
  for (Index k = 0; k < base.scope.model.dimension(); ++k) {
    if (!base.given.noise.measurement[static_cast<std::size_t>(k)]) continue;
    for (Candidate& candidate : channel_forms(base.scope, k))
      all.push_back(std::move(candidate));
    for (const Stage<Effect>& effect : problem.options.effects)
      for (Candidate& candidate : effect->candidates(base.scope, k))
        if (candidate.place == Place::Channel) all.push_back(std::move(candidate));
  }
  return all;
}

/// What a channel's form is called: by the effect that proposes it, where one does.
std::optional<Name> name_of(const Problem& problem, const Baseline& base,
                            const FittedEffect& effect, const OdeModel& fitted) {
  if (effect.candidate.families.empty()) {
    ChannelName own = channel_name(effect, problem.nominal);
    Name name{std::move(own.name), std::move(own.sentence),
              "a calibration that is off, a filter in the measuring chain, crosstalk"};
    for (const ShapeParameter& shape : effect.candidate.shapes)
      name.parameters.push_back(shape.name);
    return name;
  }
  const NameTable table{problem.options.effects, base.scope, problem.options.decision.naming};
  std::vector<Name> names = table.names_of(effect, fitted);
  if (names.empty()) return std::nullopt;
  return std::move(names.front());
}

/// rms of what a channel adds, and of the state about its mean.
struct Size {
  double added = 0.0, state = 0.0;
};

Size size_of(const FittedEffect& effect, const Assimilation& fit) {
  double sum = 0.0, spread = 0.0;
  for (const LinearisedRecord& record : fit.records) {
    const Vector form =
        form_along(effect.candidate,
                   {effect.shapes.data(), static_cast<std::size_t>(effect.shapes.size())},
                   fit.model.variables(), record);
    const auto& path = record.path.col(effect.candidate.equation);
    sum += form.squaredNorm() / static_cast<double>(form.size());
    spread += (path.array() - path.mean()).square().mean();
  }
  const auto count = static_cast<double>(fit.records.size());
  return {std::abs(effect.coefficient) * std::sqrt(sum / count), std::sqrt(spread / count)};
}

/// Whether a channel adds as much as an effect does, and more than its samples are rounded:
/// where a state rests between two values that goes along with the others.
bool is_sizeable(const FittedEffect& effect, const Assimilation& fit, const Baseline& base,
                 const DecisionOptions& decision) {
  const Size size = size_of(effect, fit);
  const auto k = static_cast<std::size_t>(effect.candidate.equation);
  const double rounding =
      base.records->channels[k].noise.lattice.value_or(0.0) / std::sqrt(12.0);
  return size.added >= decision.effect_size * size.state && size.added > rounding;
}

/// Distinguished from 0, and the whole of the state where the form stands for it.
bool is_plausible(const FittedEffect& effect, const DecisionOptions& decision) {
  if (std::abs(effect.coefficient) < decision.significance * effect.deviation) return false;
  return !is_whole(effect.candidate) ||
         std::abs(effect.coefficient - 1.0) < decision.filter_gain;
}

/// The geometric mean of the ends of each range.
Vector middle(const std::vector<ShapeParameter>& shapes) {
  Vector values(static_cast<Index>(shapes.size()));
  for (std::size_t s = 0; s < shapes.size(); ++s)
    values[static_cast<Index>(s)] = std::sqrt(shapes[s].low * shapes[s].high);
  return values;
}

/// The channels that may be it, as they are to be fitted. A filter is one in any case, from the
/// middle of its range: what it makes of a path that follows the noise says nothing of it. Not
/// so beside hidden states, of which it would be one more.
/// @param explained deviance that the best composite model explains: a channel has to show more
/// than a minor part of it at first sight.
std::vector<Effects> worth_fitting(const std::vector<ScreenedCandidate>& screened,
                                   double explained, const Baseline& given,
                                   const DecisionOptions& decision) {
  const auto tried = static_cast<double>(screened.size());
  std::vector<Effects> channels;
  for (const ScreenedCandidate& one : screened) {
    const double freedom = 1.0 + static_cast<double>(one.shapes.size());
    if (static_cast<int>(channels.size()) < decision.rough_fits &&
        sigma_of_gain(one.gain, freedom, tried) >= decision.significance &&
        one.gain >= decision.worth_fitting * screened.front().gain &&
        one.gain >= decision.minor * explained)
      channels.push_back({{one.candidate, one.shapes, one.coefficient, 0.0}});
  }
  if (!given.fit_options.hidden.empty()) return channels;
  for (const ScreenedCandidate& one : screened)
    if (!one.candidate.memory.empty())
      channels.push_back({{one.candidate, middle(one.candidate.shapes), 1.0, 0.0}});
  return channels;
}

bool is_again(const Effects& effects, const std::vector<Explanation>& among) {
  return std::any_of(among.begin(), among.end(), [&](const Explanation& other) {
    return std::equal(effects.begin(), effects.end(), other.effects.begin(),
                      [](const FittedEffect& a, const FittedEffect& b) {
                        return are_one_form(a.candidate, b.candidate);
                      });
  });
}

/// Of the channels those that come farthest in rough fits, each once. Those with shapes, which
/// rough fits do not move, are compared with their like; beside effects shapes have been fitted
/// before.
std::vector<Explanation> best_roughly(const Problem& problem, const Baseline& given,
                                      const std::vector<Effects>& channels) {
  std::vector<FitStart> starts;
  for (const Effects& effects : channels) starts.push_back({effects, &given.fitted});
  std::vector<Explanation> best;
  const int most = problem.options.decision.exact_fits;
  std::array<int, 2> left{most, most};
  for (Explanation& rough : rough_fits(problem, given, starts)) {
    const bool moves = rough.effects.size() == 1 && rough.effects.front().shapes.size() > 0;
    int& room = left[moves ? 1 : 0];
    if (room == 0 || is_again(rough.effects, best)) continue;
    best.push_back(std::move(rough));
    --room;
  }
  return best;
}

/// The best of the channels fitted exactly: all, where these are no more than that many.
std::vector<Explanation> explain_best(const Problem& problem, const Baseline& given,
                                      const std::vector<Effects>& channels) {
  const auto most = static_cast<std::size_t>(problem.options.decision.exact_fits);
  const bool all = channels.size() <= most;
  std::vector<Explanation> best;
  if (!all) best = best_roughly(problem, given, channels);
  if (all)
    for (const Effects& effects : channels) best.push_back({effects, given.fitted});
  const RunContext quiet = problem.context.beside_others();
  const Problem each = alone(problem, quiet);
  parallel_for(best.size(), problem.context.threads, [&](std::size_t i) {
    best[i] = all ? explain_on(each, given, given.fitted, channels[i])
                  : explain_further_on(each, given, best[i]);
  });
  return best;
}

/// The channels that may be it, fitted; the best first.
std::vector<Fitted> fitted_channels(const Problem& problem, const Baseline& given,
                                    const std::vector<Effects>& channels) {
  const DecisionOptions& decision = problem.options.decision;
  std::vector<Fitted> fitted;
  for (Explanation& found : explain_best(problem, given, channels)) {
    const FittedEffect& effect = found.effects.front();
    if (!std::isfinite(found.fit.deviance) || !is_plausible(effect, decision) ||
        !is_sizeable(effect, found.fit, given, decision) ||
        !name_of(problem, given, effect, found.fit.model))
      continue;
    const double value = criterion_of(problem, given, found);
    fitted.push_back({std::move(found), {}, value});
  }
  std::stable_sort(fitted.begin(), fitted.end(),
                   [](const Fitted& a, const Fitted& b) { return a.criterion < b.criterion; });
  return fitted;
}

/// The best that leaves nothing over.
std::optional<std::size_t> sound_one(const Problem& problem, std::vector<Fitted>& fitted) {
  for (std::size_t i = 0; i < fitted.size(); ++i) {
    fitted[i].left = test_disturbances(fitted[i].explanation.fit, problem.context);
    if (std::none_of(fitted[i].left.begin(), fitted[i].left.end(), [&](const auto& left) {
          return is_substantial(left, problem.options.decision);
        }))
      return i;
  }
  return std::nullopt;
}

/// Each of the best channels together with each of the effects of a composite model, fitted:
/// one fault bends several equations and may stand behind all effects but one.
std::vector<Fitted> beside_effects(const Problem& problem, const Baseline& given,
                                   const CompositeModel& best,
                                   const std::vector<Fitted>& channels) {
  const auto most = static_cast<std::size_t>(problem.options.decision.exact_fits);
  std::vector<Effects> pairs;
  for (std::size_t i = 0; i < std::min(most, channels.size()); ++i)
    for (const FittedEffect& effect : best.explanation.effects)
      if (effect.candidate.place == Place::Rate && !effect.candidate.is_driven())
        pairs.push_back({channels[i].explanation.effects.front(), effect});
  return fitted_channels(problem, given, pairs);
}

/// A rival that leaves the other coefficients as given.
struct Peer {
  double criterion = std::numeric_limits<double>::infinity();
  Index parameters = 0;
};

/// One coefficient changed in the place of the channel: the best of all.
Peer best_coefficient(const Problem& problem, const Baseline& given, const Explanation& own) {
  const std::vector<FittedEffect> others(own.effects.begin() + 1, own.effects.end());
  Peer best{.parameters = own.parameters()};
  for (const CoefficientPlace& place : free_coefficients(problem.nominal)) {
    Baseline one = given;
    one.fit_options.free = {place};
    const Explanation changed = explain_on(problem, one, given.fitted, others);
    if (std::isfinite(changed.fit.deviance))
      best.criterion = std::min(best.criterion, criterion_of(problem, one, changed));
  }
  return best;
}

/// The effects of a composite model.
Peer same_effects(const Problem& problem, const Baseline& given,
                  const CompositeModel& composite) {
  if (composite.explanation.effects.empty()) return {};
  const Explanation same =
      explain_on(problem, given, given.fitted, composite.explanation.effects);
  if (!std::isfinite(same.fit.deviance)) return {};
  return {criterion_of(problem, given, same), same.parameters()};
}

/// The channel's fault with its numbers and the others that might be it.
NamedEffect named(const Problem& problem, const Baseline& given,
                  const std::vector<Fitted>& fitted, std::size_t chosen, double tried) {
  // For people.
  constexpr std::size_t kAlternatives = 4;
  const Fitted& own = fitted[chosen];
  const FittedEffect& effect = own.explanation.effects.front();
  NamedEffect result;
  result.equation = effect.candidate.equation;
  result.place = effect.candidate.place;
  take_name(effect, *name_of(problem, given, effect, own.explanation.fit.model), result);
  const double gain = given.fitted.deviance - own.explanation.fit.deviance;
  result.sigma = sigma_of_gain(gain, 1.0 + static_cast<double>(effect.shapes.size()), tried);
  const Size size = size_of(effect, own.explanation.fit);
  result.contribution = size.added / size.state;
  result.tried = static_cast<Index>(tried);
  // What comes before it leaves structure, and is no rival of it.
  const auto weight = [&](const Fitted& one) {
    return std::exp(-0.5 * (one.criterion - own.criterion));
  };
  double sum = 0.0;
  for (std::size_t i = chosen; i < fitted.size(); ++i) sum += weight(fitted[i]);
  const auto probability = [&](const Fitted& one) { return weight(one) / sum; };
  result.probability = probability(own);
  result.gap_closed = fraction_closed(given.fitted, own.explanation.fit);
  for (std::size_t i = chosen + 1;
       i < fitted.size() && result.alternatives.size() < kAlternatives; ++i) {
    const FittedEffect& other = fitted[i].explanation.effects.front();
    const std::string where =
        problem.nominal.states()[static_cast<std::size_t>(other.candidate.equation)].name;
    const auto name = name_of(problem, given, other, fitted[i].explanation.fit.model);
    result.alternatives.push_back(
        {name->name + " of " + where, term_of(other), probability(fitted[i])});
  }
  return result;
}

CompositeModel composite_of(const CompositeModel& best, const Baseline& given, Fitted own,
                            NamedEffect fault) {
  CompositeModel composite{.hypothesis = std::string(kSensorCalibration.name),
                           .base = std::make_shared<const Baseline>(given),
                           .explanation = std::move(own.explanation),
                           .named = {std::move(fault)},
                           .rounds = best.rounds,
                           .left = std::move(own.left)};
  for (std::size_t e = 1; e < composite.explanation.effects.size(); ++e)
    composite.named.push_back(name_in(best, composite.explanation.effects[e]));
  update_numbers(composite.explanation, composite.named);
  composite.notes = best.notes;
  return composite;
}

/// What effects that act together add: the term of one; "1 in dw/dt with 1 in di/dt" of several.
std::string joint_term(const std::vector<NamedEffect>& effects, const OdeModel& nominal) {
  if (effects.size() == 1) return effects.front().term;
  std::vector<std::string> terms;
  for (const NamedEffect& effect : effects)
    terms.push_back(effect.term + place_of(effect, nominal));
  return join(terms, " with ");
}

/// Whether a composite model has something in another place than the channel.
bool acts_elsewhere(const CompositeModel& composite, const NamedEffect& fault) {
  const std::vector<FittedEffect>& effects = composite.explanation.effects;
  return std::any_of(effects.begin(), effects.end(), [&](const FittedEffect& effect) {
    return effect.candidate.place != Place::Channel ||
           effect.candidate.equation != fault.equation;
  });
}

/// A twin in another place; in the same one a note.
void add_twin(Twin twin, bool elsewhere, CompositeModel& composite) {
  if (elsewhere)
    composite.twins.push_back(std::move(twin));
  else
    composite.notes.push_back(std::move(twin.sentence));
}

/// The best composite model with the channel beside it as an alternative.
Proposal beside(const CompositeModel& best, const OdeModel& nominal, const NamedEffect& fault,
                const std::string& term) {
  CompositeModel composite = best;
  add_twin(twin_of({fault}, nominal), acts_elsewhere(best, fault), composite);
  for (NamedEffect& effect : composite.named)
    effect.alternatives.insert(effect.alternatives.begin(),
                               {fault.name, term, 0.5 * effect.probability});
  return {.composite = std::move(composite),
          .judged = ByRule{"a channel explains the records as well"}};
}

/// The channel against its peers: alone where they do worse beyond doubt, first where it is the
/// plainer one, else an alternative.
Proposals against_peers(const Problem& problem, const CompositeModel& best,
                        const Baseline& given, Fitted own, NamedEffect fault) {
  const double undecided = problem.options.decision.undecided;
  const Peer coefficient = best_coefficient(problem, given, own.explanation);
  const Peer effects = same_effects(problem, given, best);
  const std::string term = term_of(own.explanation.effects.front());
  if (coefficient.criterion < own.criterion + undecided &&
      coefficient.criterion < effects.criterion + undecided)
    return {{beside(best, problem.nominal, fault, term)}, {}};
  const bool is_sure = own.criterion + undecided < effects.criterion;
  const bool is_plainer =
      own.criterion < effects.criterion && own.explanation.parameters() < effects.parameters;
  if (!is_sure && !is_plainer) {
    if (own.criterion > effects.criterion + undecided) return {};
    return {{beside(best, problem.nominal, fault, term)}, {}};
  }
  const bool elsewhere = acts_elsewhere(best, fault);
  CompositeModel composite = composite_of(best, given, std::move(own), std::move(fault));
  if (is_sure)
    return {{{.composite = std::move(composite), .judged = ByCriterion{undecided}}}, {}};
  // Only together do the others explain what the channel does.
  add_twin(twin_of(best.named, problem.nominal), elsewhere, composite);
  std::vector<Alternative>& alternatives = composite.named[0].alternatives;
  alternatives.insert(alternatives.begin(),
                      {best.named[0].name, joint_term(best.named, problem.nominal), 0.0});
  return {{{.composite = std::move(composite),
            .judged = ByRule{"the plainer one of two that explain the records as well"}}},
          {}};
}

}  // namespace

Proposals SensorCalibration::do_propose(const Problem& problem,
                                        const CompositeModel& best) const {
  const DecisionOptions& decision = problem.options.decision;
  const Baseline given = as_given(*best.base);
  const double explained = given.fitted.deviance - best.explanation.fit.deviance;
  problem.context.report("calibrating channels", 0.0);
  const Screening screening(given.fitted);
  const double shape_penalty = problem.options.criterion->penalty(
      {0.0, 1.0, static_cast<double>(screening.system().used()), 0.0});
  const std::vector<ScreenedCandidate> screened =
      screen(candidates_of(problem, given), screening, {shape_penalty, decision.worth_shaping},
             problem.context);
  std::vector<Fitted> fitted =
      fitted_channels(problem, given, worth_fitting(screened, explained, given, decision));
  auto chosen = sound_one(problem, fitted);
  if (!chosen && best.named.size() > 1) {
    fitted = beside_effects(problem, given, best, fitted);
    chosen = sound_one(problem, fitted);
  }
  if (!chosen) return {};
  NamedEffect fault =
      named(problem, given, fitted, *chosen, static_cast<double>(screened.size()));
  return against_peers(problem, best, given, std::move(fitted[*chosen]), std::move(fault));
}

}  // namespace lacuna
