// SPDX-License-Identifier: MIT
#include "lacuna/diagnose/hypotheses/hypothesis.hpp"

#include <algorithm>
#include <tuple>

#include "diagnose/hypotheses/broken_identity.hpp"
#include "diagnose/hypotheses/coloured_noise.hpp"
#include "diagnose/hypotheses/named_effects.hpp"
#include "diagnose/hypotheses/residual_function.hpp"
#include "diagnose/hypotheses/sensor_fault.hpp"
#include "diagnose/hypotheses/shared_process.hpp"
#include "diagnose/hypotheses/unmeasured_input.hpp"

namespace lacuna {

std::vector<Stage<Hypothesis>> standard_hypotheses() {
  return in_order({NamedEffects{}, OtherChoices{}, SensorPickup{}, SensorTiming{}, SensorFault{},
                   UnmeasuredInput{}, ColouredNoiseHypothesis{}, BrokenIdentity{},
                   HeldCoefficients{}, SensorCalibration{}, InputSkew{}, InputInterpolation{},
                   InputSmoothing{}, ResidualFunction{}, SharedProcess{}});
}

std::vector<Stage<Hypothesis>> in_order(std::vector<Stage<Hypothesis>> hypotheses) {
  const auto place = [](const Stage<Hypothesis>& h) {
    return std::tuple(h->phase(), h->order(), h->info().name);
  };
  std::stable_sort(hypotheses.begin(), hypotheses.end(),
                   [&](const auto& a, const auto& b) { return place(a) < place(b); });
  return hypotheses;
}

}  // namespace lacuna
