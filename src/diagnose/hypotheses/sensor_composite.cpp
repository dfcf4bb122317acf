// SPDX-License-Identifier: MIT
#include "channel_forms.hpp"

#include <algorithm>
#include <utility>

#include "core/statistics/significance.hpp"
#include "diagnose/hypotheses/input_noise.hpp"
#include "diagnose/search/effect_names.hpp"

namespace lacuna {
namespace {

NamedEffect named_sensor(const Problem& problem, const Baseline& base,
                         const SensorFinding& finding, const FittedEffect& effect) {
  ChannelName own = channel_name(effect, problem.nominal);
  NamedEffect result{.equation = effect.candidate.equation, .place = Place::Channel};
  Name name{std::move(own.name), std::move(own.sentence), finding.cause};
  for (const ShapeParameter& shape : effect.candidate.shapes)
    name.parameters.push_back(shape.name);
  take_name(effect, name, result);
  const double gain = base.fitted.deviance - finding.explanation.fit.deviance;
  result.sigma = sigma_of_gain(gain, 1.0 + static_cast<double>(effect.shapes.size()),
                               static_cast<double>(finding.tried));
  result.gap_closed = fraction_closed(base.fitted, finding.explanation.fit);
  result.probability = 1.0;
  result.tried = finding.tried;
  return result;
}

}  // namespace

const NamedEffect& name_in(const CompositeModel& composite, const FittedEffect& effect) {
  const std::vector<FittedEffect>& effects = composite.explanation.effects;
  const auto found = std::find_if(effects.begin(), effects.end(), [&](const FittedEffect& one) {
    return are_one_form(one.candidate, effect.candidate);
  });
  return composite.named[static_cast<std::size_t>(found - effects.begin())];
}

CompositeModel composite_with(const Problem& problem, const CompositeModel& before,
                              const SensorFinding& finding) {
  CompositeModel composite{.hypothesis = std::string(finding.hypothesis),
                           .base = before.base,
                           .explanation = finding.explanation,
                           .named = {},
                           .rounds = before.rounds,
                           .left = structure_left(problem, finding.explanation.fit)};
  const std::vector<FittedEffect>& effects = finding.explanation.effects;
  for (std::size_t e = 0; e < effects.size(); ++e)
    composite.named.push_back(e < finding.sensors
                                  ? named_sensor(problem, *before.base, finding, effects[e])
                                  : name_in(before, effects[e]));
  update_numbers(composite.explanation, composite.named);
  composite.notes = before.notes;
  return composite;
}

}  // namespace lacuna
