// SPDX-License-Identifier: MIT
#include "lacuna/diagnose/hypotheses/composite_model.hpp"

#include <algorithm>
#include <utility>

#include "core/base/text.hpp"
#include "core/statistics/information.hpp"
#include "diagnose/hypotheses/input_noise.hpp"
#include "diagnose/search/effect_size.hpp"

namespace lacuna {
namespace {

/// What it took to choose the effects.
double log_choices(const std::vector<NamedEffect>& named) {
  double sum = 0.0;
  for (const NamedEffect& effect : named)
    sum += choice_penalty(static_cast<double>(effect.tried));
  return sum;
}

}  // namespace

std::string place_of(const NamedEffect& effect, const OdeModel& nominal) {
  const std::string& state = nominal.states()[static_cast<std::size_t>(effect.equation)].name;
  return effect.place == Place::Channel ? " of " + state : " in d" + state + "/dt";
}

std::string names_in_places(const std::vector<NamedEffect>& effects, const OdeModel& nominal) {
  std::vector<std::string> names;
  for (const NamedEffect& effect : effects)
    names.push_back(effect.name + place_of(effect, nominal));
  return join(names, " with ");
}

Twin twin_of(const std::vector<NamedEffect>& effects, const OdeModel& nominal,
             std::string sentence) {
  Twin twin{effects.empty() ? "nothing" : names_in_places(effects, nominal),
            std::move(sentence)};
  std::vector<std::string> said;
  for (const NamedEffect& effect : effects) {
    said.push_back(effect.description + " (" + effect.name + ")");
    twin.measurement = twin.measurement || effect.place == Place::Channel;
    if (std::find(twin.names.begin(), twin.names.end(), effect.name) == twin.names.end())
      twin.names.push_back(effect.name);
  }
  if (twin.sentence.empty())
    twin.sentence = "the records do not distinguish this from another explanation: " +
                    join(said, " together with ");
  return twin;
}

CompositeModel bare_composite(const Problem& problem, std::string hypothesis,
                              std::shared_ptr<const Baseline> base) {
  Explanation nothing{{}, base->fitted};
  std::vector<EquationStructure> left = structure_left(problem, nothing.fit);
  return {.hypothesis = std::move(hypothesis),
          .base = std::move(base),
          .explanation = std::move(nothing),
          .named = {},
          .left = std::move(left)};
}

Evidence evidence_of(const CompositeModel& composite) {
  const Explanation& explanation = composite.explanation;
  return {explanation.fit.deviance,
          static_cast<double>(composite.base->fit_options.free.size()) +
              composite.base->parameters + static_cast<double>(explanation.parameters()),
          static_cast<double>(explanation.fit.used), log_choices(composite.named)};
}

bool is_substantial(const EquationStructure& structure, const DecisionOptions& decision) {
  return structure.sigma >= decision.significance && structure.relative >= decision.effect_size;
}

bool is_left_in(const std::vector<EquationStructure>& left, const DecisionOptions& decision,
                std::optional<Index> equation) {
  return std::any_of(left.begin(), left.end(), [&](const EquationStructure& structure) {
    return (!equation || structure.equation == *equation) &&
           is_substantial(structure, decision);
  });
}

bool leaves_structure(const CompositeModel& composite, const DecisionOptions& decision) {
  return is_left_in(composite.left, decision);
}

bool has_residual_structure(const std::vector<EquationStructure>& left,
                            const DecisionOptions& decision, std::optional<Index> equation) {
  DecisionOptions smaller = decision;
  smaller.effect_size *= decision.minor;
  return is_left_in(left, smaller, equation);
}

bool closes_most(const CompositeModel& composite, const Problem& problem) {
  if (composite.named.empty()) return false;
  const Assimilation& base = composite.base->fitted;
  const Vector rates = rate_rms(base);
  const double before = total_disturbance(base, rates);
  const double after = total_disturbance(composite.explanation.fit, rates);
  return after < (1.0 - problem.options.decision.major) * before ||
         shows_the_motion(composite, problem);
}

bool shows_the_motion(const CompositeModel& composite, const Problem& problem) {
  if (composite.named.empty()) return false;
  const Explanation& explanation =
      composite.refitted ? *composite.refitted : composite.explanation;
  return EffectSize(problem, *composite.base).gap(explanation.fit) <
         problem.options.decision.minor;
}

}  // namespace lacuna
