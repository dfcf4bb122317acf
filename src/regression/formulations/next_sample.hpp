// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/regression/formulations.hpp"

namespace lacuna {

/// What next_sample() makes.
class NextSample final : public Configured<Formulation, NextSampleOptions> {
 public:
  using Configured::Configured;

 private:
  LeastSquaresSystem do_assemble(const Dataset& data, const TermLibrary& library,
                                 const RunContext& context) const override;
  std::optional<Vector> do_target_noise(const Dataset& data,
                                        const Vector& state_noise) const override;
  Evolution do_evolution() const override { return Evolution::Map; }
};

}  // namespace lacuna
