// SPDX-License-Identifier: MIT
// An input that was measured with noise.
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "core/base/text.hpp"
#include "corrected_inputs.hpp"
#include "data/derivatives/l1_trend.hpp"
#include "data/derivatives/trend_choice.hpp"
#include "diagnose/hypotheses/input_noise.hpp"
#include "diagnose/hypotheses/sensor_fault.hpp"

namespace lacuna {
namespace {

/// The order of differences of which few are not 0, and the weight of the others.
struct TrendOfInput {
  int order = 1;
  TrendChoice choice;
};

/// Levels with jumps or lines with bends, whichever predict better.
TrendOfInput choose_order(const Vector& time, const Vector& values, double noise) {
  TrendOfInput best;
  for (const int order : {1, 2}) {
    const TrendChoice choice =
        choose_trend(scaled_differences(time, order).rows, values, Vector::Constant(1, noise));
    if (order == 1 || choice.score < best.choice.score) best = {order, choice};
  }
  return best;
}

/// The means of the samples between the jumps of a trend, of which the penalty takes a part.
Vector levels_of(const Vector& trend, const Vector& values, double noise) {
  constexpr double kOneLevel = 1e-3;  // a decision: far below the noise, far above rounding
  Vector levels(values.size());
  for (Index first = 0; first < values.size();) {
    Index last = first + 1;
    while (last < values.size() && std::abs(trend[last] - trend[last - 1]) < kOneLevel * noise)
      ++last;
    levels.segment(first, last - first).setConstant(values.segment(first, last - first).mean());
    first = last;
  }
  return levels;
}

/// An input of a record without its noise.
Vector without_noise(const Trajectory& record, Index input, double noise) {
  constexpr Index kMost = 1024;  // a decision: see TrendFilter
  const Vector values = record.inputs.col(input);
  const Index count = std::min(record.samples(), kMost);
  const Index first = (record.samples() - count) / 2;
  const TrendOfInput chosen = choose_order(record.time.segment(first, count),
                                           values.segment(first, count), noise);
  const Vector trend = l1_trend(scaled_differences(record.time, chosen.order).rows, values,
                                chosen.choice.weight * noise)
                           .values;
  return chosen.order == 1 ? levels_of(trend, values, noise) : trend;
}

/// An input and its noise, in its units.
struct MeasuredInput {
  Index input = 0;
  double noise = 0.0, deviation = 0.0;
};

std::vector<MeasuredInput> measured_with_noise(const Problem& problem, const Dataset& data) {
  const auto& known = problem.memory->input_noise;
  const std::vector<InputNoise> all = known ? *known : noise_of_inputs(data);
  std::vector<MeasuredInput> noisy;
  for (Index j = 0; j < data.input_count(); ++j) {
    const auto [noise, deviation] = all[static_cast<std::size_t>(j)];
    if (noise > 0.0 && noise < deviation) noisy.push_back({j, noise, deviation});
  }
  return noisy;
}

/// Whether an effect of a noisy input is named, or structure is left that its noise does not make
/// (structure_left()): where neither is, the input serves as it is, and a trend of it has errors of
/// its own.
bool is_in_doubt(const Problem& problem, const CompositeModel& best,
                 const std::vector<MeasuredInput>& inputs) {
  if (leaves_structure(best, problem.options.decision)) return true;
  const std::vector<FittedEffect>& effects = best.explanation.effects;
  return std::any_of(inputs.begin(), inputs.end(), [&](const MeasuredInput& one) {
    const std::string& name =
        problem.nominal.inputs()[static_cast<std::size_t>(one.input)].name;
    return std::any_of(effects.begin(), effects.end(), [&](const FittedEffect& effect) {
      return effect.candidate.depends_on(name);
    });
  });
}

InputCorrection smoothing_of(std::vector<MeasuredInput> inputs) {
  return [inputs = std::move(inputs)](const Dataset& data) {
    Dataset smooth = data;
    for (Trajectory& record : smooth.trajectories)
      for (const MeasuredInput& one : inputs)
        if (record.samples() > 2)
          record.inputs.col(one.input) = without_noise(record, one.input, one.noise);
    return smooth;
  };
}

std::string note_on(const Problem& problem, const std::vector<MeasuredInput>& inputs) {
  std::vector<std::string> all;
  for (const MeasuredInput& one : inputs) {
    const Quantity& input = problem.nominal.inputs()[static_cast<std::size_t>(one.input)];
    all.push_back(input.name + " is measured with noise of " + format_number(one.noise, 2) +
                  (input.unit.empty() ? "" : " " + input.unit) + " (" +
                  format_number(100.0 * one.noise / one.deviation, 2) +
                  " % of its deviation)");
  }
  return join(all, ", ") + ", which does not act: without it the records are explained better";
}

}  // namespace

Proposals InputSmoothing::do_propose(const Problem& problem, const CompositeModel& best) const {
  std::vector<MeasuredInput> inputs =
      measured_with_noise(problem, best.base->records->data);
  if (inputs.empty() || !is_in_doubt(problem, best, inputs)) return {};
  problem.context.report("inputs that were measured with noise", 0.0);
  const std::string note = note_on(problem, inputs);
  return proposed_correction(problem, best, info().name, smoothing_of(std::move(inputs)), note);
}

}  // namespace lacuna
