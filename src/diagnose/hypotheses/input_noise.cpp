// SPDX-License-Identifier: MIT
#include "diagnose/hypotheses/input_noise.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/text.hpp"
#include "diagnose/candidates/search_memory.hpp"
#include "lacuna/data/records/noise.hpp"

namespace lacuna {
namespace {

/// One input of all records as a state of its own.
Dataset input_alone(const Dataset& data, Index input) {
  Dataset alone;
  alone.states = {data.inputs[static_cast<std::size_t>(input)]};
  for (const Trajectory& record : data.trajectories) {
    Trajectory part;
    part.source = record.source;
    part.time = record.time;
    part.states = record.inputs.col(input);
    alone.trajectories.push_back(std::move(part));
  }
  return alone;
}

double deviation_of(const Dataset& alone) {
  double sum = 0.0, squares = 0.0, count = 0.0;
  for (const Trajectory& record : alone.trajectories) {
    sum += record.states.sum();
    squares += record.states.squaredNorm();
    count += static_cast<double>(record.states.size());
  }
  return std::sqrt(std::max(0.0, squares / count - sum * sum / (count * count)));
}

/// White noise that samples show; 0 where they show none.
double white_noise_in(const Dataset& alone) {
  const StateNoise noise = analyse_noise_of(alone, 0);
  return noise.kind == NoiseKind::White ? noise.sigma : 0.0;
}

}  // namespace

std::vector<InputNoise> noise_of_inputs(const Dataset& data) {
  // A fact of numbers in double precision: what is below it is no noise of a sensor.
  constexpr double kRounding = 1e-12;
  std::vector<InputNoise> all;
  for (Index j = 0; j < data.input_count(); ++j) {
    const Dataset alone = input_alone(data, j);
    const double noise = white_noise_in(alone), deviation = deviation_of(alone);
    all.push_back({noise > kRounding * deviation ? noise : 0.0, deviation});
  }
  return all;
}

std::vector<NoisyInput> noisy_inputs(const Problem& problem, const Assimilation& fit) {
  const Dataset& data = problem.records.data;
  const double least = problem.options.decision.input_noise;
  const auto& known = problem.memory->input_noise;
  const std::vector<InputNoise> inputs = known ? *known : noise_of_inputs(data);
  std::vector<NoisyInput> found;
  for (Index j = 0; j < data.input_count(); ++j) {
    const auto [noise, moves] = inputs[static_cast<std::size_t>(j)];
    if (!(noise > 0.0) || !(noise < moves)) continue;
    const std::string& name = problem.nominal.inputs()[static_cast<std::size_t>(j)].name;
    for (Index k = 0; k < problem.nominal.dimension(); ++k) {
      const double gain = std::abs(fit.model.coefficient(k, name));
      const double made = gain * noise * std::sqrt(median_step(data));
      const double disturbed = fit.noise.disturbance[k];
      if (made > 0.0 && disturbed >= least * made && disturbed <= made / least)
        found.push_back({k, j, noise, noise / moves});
    }
  }
  return found;
}

std::vector<EquationStructure> structure_left(const Problem& problem, const Assimilation& fit) {
  std::vector<EquationStructure> left = test_disturbances(fit, problem.context);
  const std::vector<NoisyInput> noisy = noisy_inputs(problem, fit);
  std::erase_if(left, [&](const EquationStructure& one) {
    return std::any_of(noisy.begin(), noisy.end(), [&](const NoisyInput& input) {
      return input.equation == one.equation;
    });
  });
  return left;
}

std::vector<std::string> notes_on(const Problem& problem,
                                  const std::vector<NoisyInput>& noisy) {
  std::vector<std::string> notes;
  for (const NoisyInput& one : noisy) {
    const Quantity& input = problem.nominal.inputs()[static_cast<std::size_t>(one.input)];
    notes.push_back(input.name + " is measured with noise of " + format_number(one.noise, 2) +
                    (input.unit.empty() ? "" : " " + input.unit) + " (" +
                    format_number(100.0 * one.fraction, 2) +
                    " % of its deviation), as much as disturbs d" +
                    problem.nominal.states()[static_cast<std::size_t>(one.equation)].name +
                    "/dt: its coefficient comes out smaller than it is");
  }
  return notes;
}

}  // namespace lacuna
