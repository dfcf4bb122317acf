// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "diagnose/candidates/search_memory.hpp"
#include "lacuna/diagnose/hypotheses/problem.hpp"
#include "lacuna/trajectories/smoother/disturbance_test.hpp"

namespace lacuna {

/// An input whose own noise is what disturbs an equation.
struct NoisyInput {
  Index equation = 0;
  Index input = 0;
  double noise = 0.0;  ///< standard deviation that its samples show
  double fraction = 0.0;  ///< of the input's standard deviation
};

/// The noise of each input.
std::vector<InputNoise> noise_of_inputs(const Dataset& data);

/// Equations that are disturbed as much as noise in the measurement of an input makes: of an
/// input of gain b whose samples at steps of h show white noise of deviation s (differences of
/// rising order, analyse_noise()) that is a disturbance of density (b s)^2 h. None where it is
/// less than DecisionOptions::input_noise of that, or more than the inverse.
std::vector<NoisyInput> noisy_inputs(const Problem& problem, const Assimilation& fit);

/// The residual of the equations beside the noise of inputs: test_disturbances() without those
/// of noisy_inputs().
std::vector<EquationStructure> structure_left(const Problem& problem, const Assimilation& fit);

/// A sentence for each.
std::vector<std::string> notes_on(const Problem& problem,
                                  const std::vector<NoisyInput>& noisy);

}  // namespace lacuna
