// SPDX-License-Identifier: MIT
#include "effect_names.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "effects/families.hpp"
#include "lacuna/effects/effects.hpp"

namespace lacuna {
namespace {

std::vector<NamedParameter> parameters_of(const FittedEffect& fitted, const Name& name) {
  std::vector<NamedParameter> parameters;
  for (std::size_t s = 0; s < name.parameters.size(); ++s)
    parameters.push_back({name.parameters[s], fitted.candidate.shapes[s].unit, 0.0, {}});
  return parameters;
}

/// First the other names of the same form, then the other forms.
std::vector<Alternative> alternatives_of(const RankedEffect& ranked, const Ranking& ranking) {
  // For people.
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
    const bool has_own_name =
        in_one_place(candidate, own) && other.names.front().name == ranked.names.front().name;
    if (has_own_name) continue;
    for (const Name& name : other.names) add(other, name);
  }
  return result;
}

/// What makes a name less plain: shape parameters and memory, then the depth of its formula.
std::pair<Index, int> intricacy(const FittedEffect& effect) {
  const std::span<const double> shapes(effect.shapes.data(),
                                       static_cast<std::size_t>(effect.shapes.size()));
  return {effect.candidate.intricacy(), bind_form(effect.candidate, shapes).depth()};
}

/// Numbers by which people know an effect and that are no shapes of its form.
constexpr const char* kForce = "force";
constexpr const char* kBefore = "before";
constexpr const char* kAfter = "after";

bool is_derived(const NamedParameter& parameter) {
  return parameter.name == kForce || parameter.name == kBefore || parameter.name == kAfter;
}

/// The force of dry friction that is written as a slope with an end, c clip(v,-a,a): c a. What
/// a coefficient is before and after it changes.
std::vector<NamedParameter> derived_parameters(const FittedEffect& effect,
                                               const std::string& name,
                                               const OdeModel& fitted) {
  const Candidate& candidate = effect.candidate;
  if (name == kCoulombFriction.info.name && has_form(candidate, "clip(x,-a,a)"))
    return {{kForce, "", std::abs(effect.coefficient) * effect.shapes[0], {}}};
  if (name != kChange.info.name) return {};
  const double before = slope(fitted, candidate.equation, candidate.argument);
  return {{kBefore, "", before, {}}, {kAfter, "", before + effect.coefficient, {}}};
}

}  // namespace

std::string term_of(const FittedEffect& effect) {
  return bind_form(effect.candidate,
                   {effect.shapes.data(), static_cast<std::size_t>(effect.shapes.size())})
      .to_string();
}

void take_name(const FittedEffect& fitted, const Name& name, NamedEffect& named) {
  named.name = name.name;
  named.description = name.sentence;
  named.cause = name.cause;
  named.parameters = parameters_of(fitted, name);
}

NamedEffect name_effect(const RankedEffect& ranked, const Ranking& ranking) {
  const FittedEffect& fitted = ranked.effect();
  NamedEffect named;
  named.equation = fitted.candidate.equation;
  named.place = fitted.candidate.place;
  take_name(fitted, ranked.names.front(), named);
  named.sigma = ranked.sigma;
  named.contribution = ranked.contribution;
  named.probability = ranked.probability;
  named.tried = ranking.tried;
  named.alternatives = alternatives_of(ranked, ranking);
  return named;
}

std::vector<OtherForm> plainer_forms(const RankedEffect& ranked, const Ranking& ranking,
                                     const DecisionOptions& decision) {
  std::vector<OtherForm> result;
  const Candidate& candidate = ranked.effect().candidate;
  for (const RankedEffect& other : ranking.effects)
    if (other.effect().candidate.equation == candidate.equation &&
        other.effect().candidate.place == candidate.place &&
        other.sigma >= decision.significance && other.contribution >= decision.effect_size &&
        intricacy(other.effect()) < intricacy(ranked.effect()))
      result.push_back({name_effect(other, ranking), other.effect()});
  std::stable_sort(result.begin(), result.end(), [](const OtherForm& a, const OtherForm& b) {
    return intricacy(a.effect) < intricacy(b.effect);
  });
  return result;
}

std::vector<OtherForm> forms_elsewhere(const RankedEffect& ranked, const Ranking& ranking,
                                       const DecisionOptions& decision) {
  std::vector<OtherForm> result;
  const Candidate& candidate = ranked.effect().candidate;
  for (const RankedEffect& other : ranking.effects) {
    const Candidate& rival = other.effect().candidate;
    const bool same_place =
        rival.equation == candidate.equation && rival.place == candidate.place;
    if (!same_place && other.criterion < ranked.criterion + decision.undecided &&
        other.sigma >= decision.significance && other.contribution >= decision.effect_size)
      result.push_back({name_effect(other, ranking), other.effect()});
  }
  return result;
}

void update_numbers(const Explanation& explanation, std::vector<NamedEffect>& named) {
  for (std::size_t e = 0; e < named.size(); ++e) {
    const FittedEffect& fitted = explanation.effects[e];
    std::erase_if(named[e].parameters, is_derived);
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
    for (NamedParameter& derived :
         derived_parameters(fitted, named[e].name, explanation.fit.model))
      named[e].parameters.push_back(std::move(derived));
  }
}

}  // namespace lacuna
