// SPDX-License-Identifier: MIT
#include "lacuna/hypotheses/input_holds.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "lacuna/core/parallel.hpp"
#include "lacuna/records/shown_holds.hpp"

namespace lacuna {
namespace {

constexpr std::array kHolds{Hold::Zero, Hold::Linear, Hold::Smooth, Hold::Switching};

using Holds = std::vector<std::optional<Hold>>;

/// Deviance of the nominal model under each of kHolds of one input.
std::array<double, kHolds.size()> deviances(const Problem& problem, const Holds& holds,
                                            Index input, const Assimilation& start) {
  AssimilationOptions options;
  options.free = free_coefficients(problem.nominal);
  options.priors = problem.options.tolerances;
  std::array<double, kHolds.size()> result{};
  parallel_for(kHolds.size(), problem.context.threads, [&](std::size_t h) {
    Holds tried = holds;
    tried[static_cast<std::size_t>(input)] = kHolds[h];
    result[h] = assimilate_from(problem.nominal.with_holds(tried), problem.records.data, start,
                                options, problem.context)
                    .deviance;
  });
  return result;
}

std::string meaning(Hold hold) {
  switch (hold) {
    case Hold::Zero:
      return "is held from sample to sample";
    case Hold::Linear:
      return "goes on in straight lines between samples";
    case Hold::Smooth:
      return "is smooth between samples";
    case Hold::Switching:
      return "switches between samples: where it does is not known to less than a step";
  }
  return "";
}

/// The most likely hold, or the shown one where no other is decidedly more likely.
Hold judged(const std::array<double, kHolds.size()>& deviance, Hold shown, double undecided) {
  const auto value = [&](std::size_t h) {
    return std::isfinite(deviance[h]) ? deviance[h] : INFINITY;
  };
  std::size_t best =
      static_cast<std::size_t>(std::find(kHolds.begin(), kHolds.end(), shown) - kHolds.begin());
  double least = value(best) - undecided;
  for (std::size_t h = 0; h < kHolds.size(); ++h)
    if (value(h) < least) {
      best = h;
      least = value(h);
    }
  return kHolds[best];
}

}  // namespace

ChosenHolds choose_holds(const Problem& problem) {
  const auto& [nominal, records, options, context] = problem;
  ChosenHolds chosen{nominal};
  Holds holds;
  for (const Quantity& input : nominal.inputs()) {
    const auto j = static_cast<Index>(holds.size());
    holds.push_back(input.hold ? input.hold : shown_hold(records.data, j));
    if (!input.hold && holds.back()) chosen.open.push_back(j);
  }
  if (chosen.open.empty()) return chosen;
  context.report("how inputs go on between samples", 0.0);
  const Assimilation start =
      assimilate(nominal.with_holds(holds), records.data, records.outliers, {}, context);
  for (const Index j : chosen.open) {
    auto& hold = holds[static_cast<std::size_t>(j)];
    const std::string& name = nominal.inputs()[static_cast<std::size_t>(j)].name;
    if (std::isfinite(start.deviance)) {
      const auto deviance = deviances(problem, holds, j, start);
      hold = judged(deviance, *hold, options.decision.undecided);
      for (std::size_t h = 0; h < kHolds.size(); ++h)
        chosen.trail.push_back({"input-hold",
                                name + " " + meaning(kHolds[h]),
                                {},
                                kHolds[h] == *hold,
                                "deviance",
                                deviance[h],
                                *std::min_element(deviance.begin(), deviance.end())});
    }
  }
  chosen.model = nominal.with_holds(holds);
  return chosen;
}

namespace {

OdeModel with_hold(const OdeModel& model, Index input, Hold hold) {
  Holds holds;
  for (const Quantity& quantity : model.inputs()) holds.push_back(quantity.hold);
  holds[static_cast<std::size_t>(input)] = hold;
  return model.with_holds(holds);
}

bool is_of(const FittedEffect& effect, const std::string& input) {
  const auto& memory = effect.candidate.memory;
  return effect.candidate.form.variables().contains(input) ||
         std::any_of(memory.begin(), memory.end(), [&](const MemoryState& state) {
           return state.rate.variables().contains(input);
         });
}

/// Deviance of the effects that were found, fitted in few passes under another model.
double deviance_under(const Problem& problem, const Account& best, const OdeModel& model) {
  const JointFitTask task{problem.records.data, model, best.base->fit_options, problem.context};
  return explain_roughly(task, best.base->fitted, best.explanation.effects).fit.deviance;
}

/// The other holds of an input that is in no effect, if one is decidedly better.
std::vector<OdeModel> better_holds(const Problem& problem, const Account& best, Index input) {
  double least =
      deviance_under(problem, best, problem.nominal) - problem.options.decision.undecided;
  std::vector<OdeModel> better;
  for (const Hold hold : kHolds) {
    OdeModel model = with_hold(problem.nominal, input, hold);
    const double deviance = deviance_under(problem, best, model);
    if (!(deviance < least)) continue;
    least = deviance;
    better = {std::move(model)};
  }
  return better;
}

}  // namespace

std::vector<OdeModel> rival_holds(const Problem& problem, const std::vector<Index>& open,
                                  const Account& best) {
  std::vector<OdeModel> rivals;
  const std::vector<FittedEffect>& effects = best.explanation.effects;
  if (effects.empty()) return rivals;
  for (const Index j : open) {
    const Quantity& input = problem.nominal.inputs()[static_cast<std::size_t>(j)];
    const bool concerned =
        std::any_of(effects.begin(), effects.end(),
                    [&](const FittedEffect& effect) { return is_of(effect, input.name); });
    if (!concerned) {
      for (OdeModel& model : better_holds(problem, best, j)) rivals.push_back(std::move(model));
      continue;
    }
    for (const Hold hold : {Hold::Zero, Hold::Linear, Hold::Smooth})
      if (hold != input.hold) rivals.push_back(with_hold(problem.nominal, j, hold));
  }
  return rivals;
}

std::vector<std::string> notes_on_holds(const OdeModel& model, const std::vector<Index>& open) {
  std::vector<std::string> notes;
  for (const Index j : open) {
    const Quantity& input = model.inputs()[static_cast<std::size_t>(j)];
    if (input.hold && *input.hold != Hold::Smooth)
      notes.push_back(input.name + " " + meaning(*input.hold));
  }
  return notes;
}

}  // namespace lacuna
